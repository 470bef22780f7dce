#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "RawlogProblems.h"
#include "quadmap/sensors/RawlogWriter.h"

using namespace quadmap;

TEST(RawlogErrors, MissingExternalImages)
{
  const TemporaryFolder folder;
  const auto file = folder.path("x.rawlog");
  RawlogWriterOptions external;
  external.external = true;
  RawlogWriter writer(file, external);
  for (int i = 0; i < 3; ++i) writer.write(*sampleScan(kStart + i));
  writer.finish();
  ASSERT_EQ(readAll(file).size(), 3u);

  ASSERT_TRUE(std::filesystem::remove(folder.path("x_Images/camera_000001.jpg")));
  expectProblem(file, {"x.rawlog: record 1 (camera): ", "camera_000001.jpg", "missing"}, 2);
  ASSERT_TRUE(std::filesystem::remove(folder.path("x_Images/camera_000002_depth.bin")));
  RawlogSource source(file, keepGoing());
  EXPECT_EQ(readAll(source).size(), 1u);
  ASSERT_EQ(source.problems().size(), 2u);
  EXPECT_NE(source.problems()[1].text().find("camera_000002_depth.bin"), std::string::npos);
}

TEST(RawlogErrors, UnreadableExternalImages)
{
  const TemporaryFolder folder;
  const auto file = folder.path("x.rawlog");
  RawlogWriterOptions external;
  external.external = true;
  RawlogWriter writer(file, external);
  for (int i = 0; i < 2; ++i) writer.write(*sampleScan(kStart + i));
  writer.finish();
  const std::string depth = "x_Images/camera_000001_depth.bin",
                    color = "x_Images/camera_000001.jpg";
  const auto goodDepth = readFile(folder.path(depth)), goodColor = readFile(folder.path(color));

  const std::string where = "x.rawlog: record 1 (camera): ";
  folder.write(depth, "no depth here");
  expectProblem(file, {where, depth + " cannot be read: ", "not plausible"}, 1);
  folder.write(depth, goodDepth.substr(0, goodDepth.size() / 2));
  expectProblem(file, {where, depth + " cannot be read: ", "truncated"}, 1);
  folder.write(depth, "");
  expectProblem(file, {where, depth + " cannot be read: ", "empty"}, 1);
  folder.write(depth, goodDepth);
  folder.write(color, "no image here");
  expectProblem(file, {where, color + " cannot be read"}, 1);
  folder.write(color, goodColor.substr(0, goodColor.size() / 2));
  ::testing::internal::CaptureStderr();
  expectProblem(file, {where, color + " cannot be read", "cannot be read as an image"}, 1);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "libjpeg prints nothing itself";
  folder.write(color, goodColor);
  EXPECT_EQ(readAll(file).size(), 2u);
}

TEST(RawlogErrors, ExternalDepthsAsText)
{
  const TemporaryFolder folder;
  auto scan = sampleScan(kStart);
  const auto depth = scan->rangeImage;
  mrpt::obs::CObservation3DRangeScan::EXTERNALS_AS_TEXT(true);
  scan->rangeImage_convertToExternalStorage("depth.txt", folder.path(""));
  mrpt::obs::CObservation3DRangeScan::EXTERNALS_AS_TEXT(false);
  const auto file = writeObjects(folder.path("x.rawlog"), {scan});
  std::filesystem::create_directory(folder.path("x_Images"));
  const auto isRefused = [&](const std::string& text, const std::string& why)
  {
    folder.write("x_Images/depth.txt", text);
    expectProblem(file, {"x.rawlog: record 0 (camera): ", "depth.txt cannot be read: ", why}, 0);
  };
  depth.saveToTextFile(folder.path("x_Images/depth.txt"));
  const auto frames = readAll(file);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_TRUE(frames[0].scan->rangeImage == depth);
  isRefused("1 2\n3\n", "its rows differ in length");
  isRefused(std::string("1 2\n\0 3 4\n5 6\n", 14), "it has a zero byte");
  isRefused("1 -2\n", "no depth of 0 to 65535");
  isRefused("1 65536\n", "no depth of 0 to 65535");
  isRefused("1 x\n", "no depth of 0 to 65535");
  std::string pair = "0 0\n", row, column;
  for (int i = 0; i < 32767; ++i)
  {
    row += "0 ";
    column += pair;
  }
  isRefused(row + "\n", "a row is too long");
  isRefused(column, "32767 or more rows of 2");
  isRefused(std::string((8u << 24) + 1, ' '), "it is too large");
}

TEST(RawlogErrors, ExternalImagesOutsideTheFolder)
{
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  fs::create_directory(folder.path("x_Images"));
  fs::create_directory(folder.path("other"));
  const auto picture = sampleScan(kStart)->intensityImage;
  ASSERT_TRUE(picture.saveToFile(folder.path("other/secret.jpg")));
  ASSERT_TRUE(picture.saveToFile(folder.path("x_Images/own.jpg")));
  fs::create_symlink("../other/secret.jpg", folder.path("x_Images/link.jpg"));
  fs::create_directory_symlink(folder.path("other"), folder.path("x_Images/linked"));
  const auto named = [&](const std::string& name)
  {
    auto scan = sampleScan(kStart);
    scan->intensityImage.setExternalStorage(name);
    return writeObjects(folder.path("x.rawlog"), {scan});
  };
  EXPECT_EQ(readAll(named("own.jpg")).size(), 1u);
  RawlogSourceOptions anywhere;
  anywhere.imagesAnywhere = true;
  for (const std::string& name :
       {std::string("../other/secret.jpg"), folder.path("other/secret.jpg"),
        std::string("link.jpg"), std::string("linked/secret.jpg")})
  {
    SCOPED_TRACE(name);
    const auto file = named(name);
    expectProblem(file, {"x.rawlog: record 0 (camera): ", name, "lies outside"}, 0);
    EXPECT_EQ(readAll(file, anywhere).size(), 1u);
  }
  const auto withZero = named(std::string("own.jpg\0x", 9));
  expectProblem(withZero, {"external image own.jpg?x has a zero byte in its name"}, 0);
}

TEST(RawlogErrors, ExternalConfidencesAreNotRead)
{
  const TemporaryFolder folder;
  ASSERT_TRUE(sampleScan(kStart)->intensityImage.saveToFile(folder.path("secret.jpg")));
  auto scan = sampleScan(kStart);
  scan->hasConfidenceImage = true;
  scan->confidenceImage.setExternalStorage(folder.path("secret.jpg"));
  scan->cameraParams.fy(-scan->cameraParams.fy());  // the images are turned
  const auto frames = readAll(writeObjects(folder.path("x.rawlog"), {scan}));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_FALSE(frames.at(0).scan->hasConfidenceImage);
}

TEST(RawlogErrors, AnImageFolderThatIsALinkOutOfTheRawlogsFolderIsRefused)
{
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  fs::create_directories(folder.path("given"));
  fs::create_directory(folder.path("other"));
  ASSERT_TRUE(sampleScan(kStart)->intensityImage.saveToFile(folder.path("other/secret.jpg")));
  fs::create_directory_symlink("../other", folder.path("given/x_Images"));
  auto scan = sampleScan(kStart);
  scan->intensityImage.setExternalStorage("secret.jpg");
  const auto file = writeObjects(folder.path("given/x.rawlog"), {scan});
  expectProblem(
      file, {"x.rawlog: record 0 (camera): ", "secret.jpg lies outside " + folder.path("given")},
      0);

  RawlogSourceOptions anywhere;
  anywhere.imagesAnywhere = true;
  EXPECT_EQ(readAll(file, anywhere).size(), 1u);

  fs::create_directory_symlink("given", folder.path("link"));
  fs::remove(folder.path("given/x_Images"));
  fs::rename(folder.path("other"), folder.path("given/pictures"));
  fs::create_directory_symlink("pictures", folder.path("given/x_Images"));
  EXPECT_EQ(readAll(folder.path("link/x.rawlog")).size(), 1u) << "both links stay inside";
}

TEST(RawlogErrors, OnlyWhereAUserCanAllowImagesAnywhereTheMessageSaysHow)
{
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  folder.write("secret.jpg", "");
  fs::create_directory(folder.path("x_Images"));
  auto scan = sampleScan(kStart);
  scan->intensityImage.setExternalStorage("../secret.jpg");
  const auto file = writeObjects(folder.path("x.rawlog"), {scan});
  RawlogSourceOptions options;
  EXPECT_EQ(errorOf([&] { readAll(file, options); }).find("would allow"), std::string::npos);
  options.imagesHint = "--images-anywhere";
  const auto error = errorOf([&] { readAll(file, options); });
  EXPECT_NE(error.find("(--images-anywhere would allow that)"), std::string::npos) << error;
}
