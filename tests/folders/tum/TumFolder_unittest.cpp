#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <sstream>

#include "../../obs/TestData.h"
#include "../SampleRecording.h"
#include "quadmap/folders/FolderKinds.h"

using namespace quadmap;

namespace
{
std::string withoutKey(const std::string& key)
{
  std::string text = SampleRecording::kCalibration;
  const auto begin = text.find(key + ":");
  return text.erase(begin, text.find('\n', begin) + 1 - begin);
}

std::string withValue(const std::string& key, const std::string& value)
{
  return key + ": " + value + "\n" + withoutKey(key);
}

std::string errorOfOpening(const SampleRecording& recording)
{
  return errorOf([&] { openFrameFolder("tum", recording.folder()); });
}

void expectInOneLine(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}
}  // namespace

TEST(TumFolder, ReadsImagesCalibrationAndBoxes)
{
  const SampleRecording recording;
  const FrameFolder dataset = openFrameFolder("tum", recording.folder());
  ASSERT_EQ(dataset.frames().size(), 6u);
  EXPECT_DOUBLE_EQ(dataset.frames()[2].time, 100.2);
  const auto scan = dataset.scan(2);
  EXPECT_EQ(scan->timestamp, mrpt::Clock::fromDouble(100.2));
  EXPECT_EQ(scan->sensorLabel, "camera");
  EXPECT_EQ(scan->rangeImage.rows(), 48);
  EXPECT_EQ(scan->rangeImage.cols(), 64);
  EXPECT_FLOAT_EQ(static_cast<float>(scan->rangeImage(7, 9)) * scan->rangeUnits, 2.0f);
  EXPECT_DOUBLE_EQ(scan->cameraParams.fx(), 60.0);
  EXPECT_DOUBLE_EQ(scan->cameraParams.cy(), 23.5);
  const auto& image = scan->intensityImage;
  EXPECT_EQ(image.at<std::uint8_t>(5, 5, 0), 40) << "blue first, as OpenCV and MRPT have it";
  EXPECT_EQ(image.at<std::uint8_t>(5, 5, 2), 120);
  EXPECT_TRUE(scan->doDepthAndIntensityCamerasCoincide());
  const auto boxes = dataset.boxes(2);
  ASSERT_TRUE(boxes);
  EXPECT_EQ(boxes->timestamp, scan->timestamp);
  ASSERT_EQ(boxes->objects.size(), 1u);
  EXPECT_EQ(boxes->objects[0].label, "chair");
  EXPECT_DOUBLE_EQ(boxes->objects[0].score, 0.8);
  EXPECT_DOUBLE_EQ(boxes->objects[0].box.y2, 40.0);
  EXPECT_TRUE(dataset.notes().empty());
}

TEST(TumFolder, TurnsTheWorldUpright)
{
  // The recording's camera looks along the world's z and has the world's -y as up; in ours it has
  // to look horizontally, with z up, and to move along its right (-y of the robot).
  const SampleRecording recording;
  const FrameFolder dataset = openFrameFolder("tum", recording.folder());
  const auto first = dataset.T_world_robot(0), last = dataset.T_world_robot(5);
  ASSERT_TRUE(first && last);
  const auto axis = [&](int column)
  { return Eigen::Vector3d(first->getRotationMatrix().asEigen().col(column)); };
  EXPECT_LT((axis(2) - Eigen::Vector3d::UnitZ()).norm(), 1e-9) << "robot z is up";
  EXPECT_NEAR(axis(0).z(), 0, 1e-9) << "it looks horizontally";
  const Eigen::Vector3d motion(
      last->x() - first->x(), last->y() - first->y(), last->z() - first->z());
  EXPECT_LT((motion + 0.25 * axis(1)).norm(), 1e-9) << "0.25 m to the right";
}

TEST(TumFolder, LeavesAnUprightWorldAlone)
{
  const SampleRecording recording;
  auto calibration = std::string(SampleRecording::kCalibration);
  calibration.replace(calibration.find("0., -1., 0."), 11, "0., 0., 1.");
  recording.writeCalibration(calibration);
  const auto T = openFrameFolder("tum", recording.folder()).T_world_robot(2);
  ASSERT_TRUE(T);
  EXPECT_DOUBLE_EQ(T->x(), 0.1);
  // The camera looks up: robot x along z, robot z along -y.
  const auto R = T->getRotationMatrix();
  EXPECT_NEAR(R(2, 0), 1, 1e-9);
  EXPECT_NEAR(R(1, 2), -1, 1e-9);
}

TEST(TumFolder, KnowsWhenUpIsUnknown)
{
  const SampleRecording recording;
  auto calibration = std::string(SampleRecording::kCalibration);
  recording.writeCalibration(calibration.substr(0, calibration.find("world_up")));
  FrameFolder dataset = openFrameFolder("tum", recording.folder());
  EXPECT_FALSE(dataset.camera().worldUp);
  EXPECT_DOUBLE_EQ(dataset.T_world_robot(0)->getRotationMatrix()(1, 2), -1) << "+z is up";
  dataset.turnUp(-Eigen::Vector3d::UnitY());
  EXPECT_NEAR(dataset.T_world_robot(0)->getRotationMatrix()(2, 2), 1, 1e-9);
}

TEST(TumFolder, SaysWhatIsMissing)
{
  const SampleRecording recording;
  std::filesystem::remove(recording.files.path("groundtruth.txt"));
  std::filesystem::remove_all(recording.files.path("detections"));
  const FrameFolder blind = openFrameFolder("tum", recording.folder());
  ASSERT_EQ(blind.notes().size(), 2u);
  expectInOneLine(blind.notes()[0], "no groundtruth.txt");
  expectInOneLine(blind.notes()[1], "no detections");
  EXPECT_EQ(blind.posesCount(), 0u);
  EXPECT_FALSE(blind.T_world_robot(0));
  EXPECT_FALSE(blind.boxes(0));
}

TEST(TumFolder, PairsByTimeWithoutAssociations)
{
  const SampleRecording recording;
  std::filesystem::remove(recording.files.path("associations.txt"));
  recording.files.write(
      "rgb.txt",
      "# time file\n1.00 rgb/f0.png\n1.03 rgb/f1.png\n1.06 rgb/f2.png\n2.0 rgb/f3.png\n");
  // f1 is 5 ms from the second depth image, f2 25 ms: too far; f0's depth comes before it.
  recording.files.write("depth.txt", "0.99 depth/f0.png\n1.035 depth/f1.png\n3.0 depth/f2.png\n");
  const FrameFolder dataset = openFrameFolder("tum", recording.folder());
  const auto& frames = dataset.frames();
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(dataset.unpaired(), 3u) << "f2 and f3 of colour, f2 of depth";
  EXPECT_EQ(dataset.firstUnpaired(), recording.files.path("rgb/f2.png"));
  EXPECT_DOUBLE_EQ(frames[0].time, 0.99) << "the time of the depth image";
  EXPECT_EQ(frames[1].color, recording.files.path("rgb/f1.png"));
  EXPECT_EQ(frames[1].depth, recording.files.path("depth/f1.png"));
}

TEST(TumFolder, InterpolatesPosesAtTheFramesTimes)
{
  const SampleRecording recording;
  std::string poses;
  for (int i = -1; i < SampleRecording::kFrames - 1; ++i)
    poses += mrpt::format("%.4f %.4f 0 0 0 0 0 1\n", 100.05 + 0.1 * i, 0.1 * i);
  recording.files.write("groundtruth.txt", poses);
  const FrameFolder dataset = openFrameFolder("tum", recording.folder());
  const auto T2 = dataset.T_world_robot(2);
  ASSERT_TRUE(T2);
  // x of the recording's world stays x: the minimal rotation turns about it.
  EXPECT_NEAR(T2->x(), 0.15, 1e-9);
  EXPECT_FALSE(dataset.T_world_robot(5)) << "after the last pose";
  FrameFolderOptions impatient;
  impatient.maxPoseGap = 0.05;
  EXPECT_FALSE(openFrameFolder("tum", recording.folder(), impatient).T_world_robot(2))
      << "0.1 s apart";
}

TEST(TumFolder, MakesAWorldOfNegativeFyRightHanded)
{
  const SampleRecording recording;
  recording.writeCalibration(withValue("fy", "-62.0"));
  const FrameFolder dataset = openFrameFolder("tum", recording.folder());
  EXPECT_DOUBLE_EQ(dataset.scan(0)->cameraParams.fy(), 62.0);
  ASSERT_EQ(dataset.notes().size(), 1u);
  expectInOneLine(
      dataset.notes()[0], "fy of calibration.yaml is negative: the world of the recording is");
}

TEST(TumFolder, TakesTheDistortionOutOfImagesAndBoxes)
{
  const SampleRecording recording;
  recording.writeCalibration("k1: 0.1\n" + std::string(SampleRecording::kCalibration));
  const FrameFolder dataset = openFrameFolder("tum", recording.folder());
  ASSERT_EQ(dataset.notes().size(), 1u);
  expectInOneLine(dataset.notes()[0], "rectified, as the lens of calibration.yaml distorts");
  const auto scan = dataset.scan(0);
  EXPECT_EQ(scan->cameraParams.distortion, mrpt::img::DistortionModel::none);
  EXPECT_DOUBLE_EQ(scan->cameraParams.dist[0], 0);
  EXPECT_EQ(scan->rangeImage(0, 0), 0) << "the lens bends outwards, so it did not see the corner";
  EXPECT_EQ(scan->rangeImage(24, 32), 10000);
  // 21.5 px from the centre are 0.358 at depth 1, which the lens bends by a factor of 1.013.
  EXPECT_NEAR(dataset.boxes(0)->objects.at(0).box.x1, 10.0, 0.5);
  EXPECT_GT(dataset.boxes(0)->objects.at(0).box.x1, 10.2);
  EXPECT_TRUE(dataset.recorded(0).jpeg.empty());
}

TEST(TumFolder, TakesRegisteredDepthOfAnotherSize)
{
  const SampleRecording recording;
  for (int i = 0; i < SampleRecording::kFrames; ++i) recording.writeColor(i, 128, 96);
  FrameFolderOptions options;
  const auto readWith = [&](const std::string& keys)
  {
    options.camera = recording.files.write(
        "my.ini",
        "[camera]\nwidth = 128\nheight = 96\nfx = 120\nfy = 120\n"
        "depthWidth = 64\ndepthHeight = 48\n" +
            keys);
    return openFrameFolder("tum", recording.folder(), options);
  };
  for (const char* keys : {"", "depthFx = 70\ndepthFy = 70\n"})
  {
    const auto scan = readWith(keys).scan(1);
    EXPECT_EQ(scan->cameraParams.ncols, 64u) << keys;
    EXPECT_DOUBLE_EQ(scan->cameraParams.fx(), 60) << "depth is registered, whatever the file says";
    EXPECT_EQ(scan->intensityImage.getWidth(), 64u) << keys;
    EXPECT_EQ(scan->rangeImage(7, 9), 10000) << keys;
    EXPECT_EQ(scan->rangeImage.rows(), 48) << keys;
  }
  const auto error = errorOf([&] { readWith("depthFx = 70\ndepthFy = 70\nk1 = 0.1\n"); });
  expectInOneLine(error, "registered depth images of another size cannot be rectified");
}

TEST(TumFolder, NamesTheCamerasWhenNothingTellsWhichItIs)
{
  const SampleRecording recording;
  std::filesystem::remove(recording.files.path("calibration.yaml"));
  expectInOneLine(
      errorOfOpening(recording), "--camera gives one: 7scenes, fr1, fr2, fr3, icl, kinect");
  FrameFolderOptions options;
  options.camera = "fr9";
  expectInOneLine(
      errorOf([&] { openFrameFolder("tum", recording.folder(), options); }),
      "fr9: no such camera; known are 7scenes, fr1");
  options.camera = "kinect";
  const FrameFolder dataset = openFrameFolder("tum", recording.folder(), options);
  EXPECT_DOUBLE_EQ(dataset.camera().depthFactor, 5000) << "as usual in this layout";
  expectInOneLine(
      errorOf([&] { dataset.scan(0); }), "rgb/f0.png: is 64x48, camera kinect is for 640x480");
}

TEST(TumFolder, PairsDepthFirstAssociations)
{
  const SampleRecording recording;
  recording.files.write("associations.txt", "7 depth/f1.png 7.01 rgb/f2.png\n");
  const auto content = openFrameFolder("tum", recording.folder());
  EXPECT_EQ(content.frames()[0].color, recording.files.path("rgb/f2.png"));
  EXPECT_EQ(content.frames()[0].depth, recording.files.path("depth/f1.png"));
  EXPECT_DOUBLE_EQ(content.frames()[0].time, 7);
}

TEST(TumFolder, RejectsBadCalibrations)
{
  const auto expect = [](const std::string& calibration, const std::string& what)
  {
    const SampleRecording recording;
    recording.writeCalibration(calibration);
    expectInOneLine(
        errorOfOpening(recording), recording.files.path("calibration.yaml") + ": " + what);
  };
  for (const std::string key : {"fx", "fy", "cx", "cy", "width", "height", "depth_factor"})
  {
    expect(withoutKey(key), "the key '" + key + "' is missing");
    expect(withValue(key, "four"), "'" + key + "' is not a number");
    expect(withValue(key, ".Nan"), "'" + key + "' is not finite");
  }
  expect(withValue("fx", "0."), "fx=0: must be > 0");
  expect(withValue("fx", "-60."), "fx=-60: must be > 0");
  expect(withValue("fy", "0."), "fy=0: must not be 0");
  expect(withValue("width", "64.5"), "'width' is 64.5: must be a whole number in 1..20000");
  expect(withValue("height", "0"), "'height' is 0: must be a whole number");
  expect(withValue("depth_factor", "-1"), "depth_factor=-1: must be > 0");
  expect(withValue("depth_factor", "1e-300"), "depth_factor=1e-300: must be in [1, 1e+07]");
  expect(withValue("depth_factor", "1e300"), "depth_factor=1e+300: must be in [1, 1e+07]");
  const std::string absurd = "has an absurd calibration",
                    calibration = SampleRecording::kCalibration;
  for (const std::string key : {"fx", "fy", "cx", "cy"}) expect(withValue(key, "1e300"), absurd);
  expect(withValue("fx", "1e-5"), absurd + " (focal length 1e-05, centre 31.5 in images 64 px");
  expect("k1: 1e300\n" + calibration, absurd + " (a coefficient of distortion is 1e+300)");
  expect(std::string("# a\0\n", 5) + calibration, "has a zero byte (line 3)");
  expect("k1: -5\n" + calibration, "the lens (k1=-5 k2=0 p1=0 p2=0 k3=0) folds the image ");
  auto up = std::string(SampleRecording::kCalibration);
  up.replace(up.find("0., -1., 0."), 11, "0., 0., 0.");
  expect(up, "'world_up' must be a finite direction");
  for (const char* rows : {"rows: 2", "rows: 1000000000", "rows: -3", "rows: x"})
  {
    up = SampleRecording::kCalibration;
    up.replace(up.find("rows: 3"), 7, rows);
    expect(up, "'world_up' must be a matrix of three numbers");
  }
  expect("world_up: 3\n" + up.substr(0, up.find("world_up")), "'world_up' must be a matrix");
  expect("fx: [ 1, 2\n\tfoo: }", "is not YAML");
  expect("fx: 1\nfy\n", "is not YAML as OpenCV writes it (line 4)");
  expect(" fx: 1\nfy: 1\n", "is not YAML as OpenCV writes it (line 3)");
  expect("fx: 1\nfx: 1\n", "the key 'fx' stands there twice");
  const std::string longKey(300, 'k');
  expect(
      longKey + ": 1\n" + longKey + ": 1\n", "the key '" + longKey.substr(0, 60) + "...' stands");
  expect("K1: 0.3\n" + calibration, "the key 'K1' is not known; did you mean 'k1'?");
  expect(
      "world-up: 0\n" + calibration, "the key 'world-up' is not known; did you mean 'world_up'?");
  expect("WORLD_UP: 0\n" + calibration, "the key 'WORLD_UP' is not known; did you mean");
  expect("k4: 0.3\n" + calibration, "k4=0.3: a lens with this term is not known");
}

TEST(TumFolder, PassesOverKeysOfOtherProgramsInCalibrations)
{
  const SampleRecording recording;
  recording.writeCalibration(
      "fps: 30\nk4: 0\ncamera_name: left\n" + std::string(SampleRecording::kCalibration));
  EXPECT_NO_THROW(openFrameFolder("tum", recording.folder()));
}

TEST(TumFolder, RejectsMissingAndMalformedLists)
{
  const auto expect = [](const std::string& file, const char* content, const std::string& what)
  {
    const SampleRecording recording;
    if (content)
      recording.files.write(file, content);
    else
      std::filesystem::remove(recording.files.path(file));
    expectInOneLine(errorOfOpening(recording), what);
  };
  expect("calibration.yaml", nullptr, "calibration.yaml: no such file");
  expect("associations.txt", nullptr, "neither associations.txt nor rgb.txt and depth.txt");
  expect("associations.txt", "", "lists no colour image");
  expect(
      "associations.txt", "# c\n1.0 rgb/f0.png 1.0\n",
      "associations.txt:2: expected 4 columns, got 3");
  expect("associations.txt", "one rgb/f0.png 1.0 d\n", "associations.txt:1: 'one' is not a number");
  expect("associations.txt", "1 rgb/f0.png nan d\n", "associations.txt:1: the time 'nan' must be");
  std::string nonsense;
  for (int i = 0; i < 1001; ++i) nonsense += "nonsense\n";
  expect(
      "associations.txt", nonsense.c_str(),
      "associations.txt: more than 1000 entries cannot be used, such as ");
  expect(
      "associations.txt", "100 rgb/f0.png 0.1 depth/f0.png\n",
      "associations.txt:1: the times of the two images are 99.9 s apart");
  EXPECT_EQ(errorOf([] { openFrameFolder("tum", "/no/such"); }), "/no/such: no such folder");
  const SampleRecording recording;
  FrameFolderOptions options;
  options.detections = "/no/such";
  expectInOneLine(
      errorOf([&] { openFrameFolder("tum", recording.folder(), options); }),
      "/no/such: no such folder");
}

TEST(TumFolder, TakesAnImageThatIsListedTwiceOnce)
{
  const SampleRecording recording;
  const auto write = [&](const char* name, const std::string& text)
  { recording.files.write(name, text); };
  const auto expect = [&](const std::string& what)
  {
    const FrameFolder dataset = openFrameFolder("tum", recording.folder());
    ASSERT_EQ(dataset.listProblems().size(), 1u) << what;
    EXPECT_EQ(dataset.listProblems()[0], recording.files.path(what));
    EXPECT_EQ(dataset.frames().size(), 2u) << what;
  };
  write(
      "associations.txt", SampleRecording::line(0, 1) + SampleRecording::line(1, 2) +
                              "3 ./rgb/f0.png 3 depth/f2.png\n");
  expect("associations.txt:3: ./rgb/f0.png stands in line 1 as well");
  write(
      "associations.txt", SampleRecording::line(0, 1) + "2 rgb/f1.png 2 ./depth/f0.png\n" +
                              SampleRecording::line(1, 2));
  expect("associations.txt:2: ./depth/f0.png stands in line 1 as well");
  std::filesystem::remove(recording.files.path("associations.txt"));
  const std::string colors = "1 rgb/f0.png\n2 rgb/f1.png\n",
                    depths = "1 depth/f0.png\n2 depth/f1.png\n";
  write("rgb.txt", colors + "3 rgb/f1.png\n");
  write("depth.txt", depths);
  expect("rgb.txt:3: rgb/f1.png stands in line 2 as well");
  write("rgb.txt", colors);
  write("depth.txt", depths + "# again\n2 depth/f1.png\n");
  expect("depth.txt:4: depth/f1.png stands in line 2 as well");
}

TEST(TumFolder, ReadsTextsOfOtherSystems)
{
  const SampleRecording recording;
  const auto& files = recording.files;
  std::istringstream unixLines(readFile(files.path("calibration.yaml")));
  std::string lines;
  for (std::string line; std::getline(unixLines, line);) lines += line + "\r\n";
  files.write("calibration.yaml", lines);
  files.write("associations.txt", "\xef\xbb\xbf" + SampleRecording::line(0, 100.0));
  const auto dataset = openFrameFolder("tum", recording.folder());
  EXPECT_TRUE(dataset.scan(0));
  std::string wide = SampleRecording::line(0, 100.0);
  for (std::size_t i = wide.size(); i > 0; --i) wide.insert(i, 1, '\0');
  files.write("associations.txt", wide);
  expectInOneLine(errorOfOpening(recording), "associations.txt:1: is no text (UTF-16?)");
}

TEST(TumFolder, TellsWhyPosesCannotBeUsed)
{
  const SampleRecording recording;
  const std::string good = readFile(recording.files.path("groundtruth.txt"));
  const auto expect = [&](const std::string& poses, const std::string& what, std::size_t left)
  {
    recording.files.write("groundtruth.txt", poses);
    const FrameFolder dataset = openFrameFolder("tum", recording.folder());
    ASSERT_EQ(dataset.posesProblems().size(), 1u) << what;
    expectInOneLine(dataset.posesProblems()[0], what);
    EXPECT_EQ(dataset.posesCount(), left) << what;
    EXPECT_EQ(dataset.frames().size(), std::size_t{SampleRecording::kFrames});
  };
  expect("1 0 0 0 0 0 0\n", "groundtruth.txt:1: expected 8 columns, got 7", 0);
  expect("1 nan 0 0 0 0 0 1\n", "groundtruth.txt:1: 'nan'", 0);
  expect("nonsense\n" + good, "groundtruth.txt:1: expected 8 columns, got 1", 6);
  expect(good + "1 0 0 0 0 0 0 1\n", "groundtruth.txt:7: time 1.000000 s is not after", 6);
  std::filesystem::remove(recording.files.path("groundtruth.txt"));
  std::filesystem::create_directory(recording.files.path("groundtruth.txt"));
  const FrameFolder dataset = openFrameFolder("tum", recording.folder());
  ASSERT_EQ(dataset.posesProblems().size(), 1u);
  expectInOneLine(dataset.posesProblems()[0], "groundtruth.txt");
}

TEST(TumFolder, ReadsTheOtherLinesOfItsLists)
{
  const SampleRecording recording;
  const auto expect = [&](const std::string& file, const std::string& what)
  {
    const FrameFolder dataset = openFrameFolder("tum", recording.folder());
    ASSERT_EQ(dataset.listProblems().size(), 1u) << file;
    expectInOneLine(dataset.listProblems()[0], recording.files.path(file) + what);
    EXPECT_EQ(dataset.frames().size(), 2u) << file;
  };
  recording.files.write(
      "associations.txt", SampleRecording::line(0, 1) + "nonsense\n" + SampleRecording::line(1, 2));
  expect("associations.txt", ":2: expected 4 columns, got 1");
  recording.files.write(
      "associations.txt",
      SampleRecording::line(0, 1) + SampleRecording::line(1, 2) + std::string(100, '\0'));
  expect("associations.txt", ":3: is no text (UTF-16?)");
  std::filesystem::remove(recording.files.path("associations.txt"));
  const std::string colors = "1 rgb/f0.png\n2 rgb/f1.png\n",
                    depths = "1 depth/f0.png\n2 depth/f1.png\n";
  recording.files.write("rgb.txt", colors + "three rgb/f2.png\n");
  recording.files.write("depth.txt", depths);
  expect("rgb.txt", ":3: 'three' is not a number");
  recording.files.write("rgb.txt", colors);
  recording.files.write("depth.txt", "3 ../f2.png\n" + depths);
  expect("depth.txt", ":1: '../f2.png' must be a path inside the folder");
}

TEST(TumFolder, RejectsBadImages)
{
  const auto expect = [](const auto& spoil, const std::string& what)
  {
    const SampleRecording recording;
    spoil(recording);
    const FrameFolder dataset = openFrameFolder("tum", recording.folder());
    expectInOneLine(errorOf([&] { dataset.scan(1); }), what);
    EXPECT_TRUE(dataset.scan(2)) << "the others can be read";
  };
  using R = SampleRecording;
  expect(
      [](const R& r) { std::filesystem::remove(r.files.path("rgb/f1.png")); },
      "rgb/f1.png: no such file");
  expect(
      [](const R& r) { std::filesystem::remove(r.files.path("depth/f1.png")); },
      "depth/f1.png: no such file");
  expect(
      [](const R& r) { r.files.write("depth/f1.png", "none"); },
      "depth/f1.png: cannot be read as an image");
  expect(
      [](const R& r) { r.writeColor(1, 32, 24); },
      "rgb/f1.png: is 32x24, calibration.yaml is for 64x48");
  expect(
      [](const R& r)
      { cv::imwrite(r.files.path("depth/f1.png"), cv::Mat(48, 64, CV_8UC1, cv::Scalar(9))); },
      "depth/f1.png: is no depth image (one channel of 16 bits)");
  expect(
      [](const R& r)
      {
        std::filesystem::copy_file(
            r.files.path("depth/f1.png"), r.files.path("rgb/f1.png"),
            std::filesystem::copy_options::overwrite_existing);
      },
      "rgb/f1.png: is no colour image (8 bits a channel)");
  expect(
      [](const R& r)
      {
        std::filesystem::remove(r.files.path("rgb/f1.png"));
        std::filesystem::create_directory(r.files.path("rgb/f1.png"));
      },
      "rgb/f1.png: is no file");
}

TEST(TumFolder, RefusesTooManyImagesThatCannotBeFollowed)
{
  const SampleRecording recording;
  std::filesystem::create_symlink("circle", recording.files.path("circle"));
  std::string lines = SampleRecording::line(0, 1);
  for (int i = 0; i < 1001; ++i) lines += mrpt::format("2 circle/%d.png 2 depth/%d.png\n", i, i);
  recording.files.write("associations.txt", lines);
  expectInOneLine(
      errorOfOpening(recording),
      recording.folder() + ": more than 1000 entries cannot be used, such as ");
}

TEST(TumFolder, LeavesOutImagesThatCannotBeFollowed)
{
  namespace fs = std::filesystem;
  const TemporaryFolder other;
  const std::string secret = "../../../../../../../.." + other.write("secret.png", "");
  std::string roundabout;  // whose absolute path is too long, but which the system can open
  while (roundabout.size() + secret.size() < 4090) roundabout += "./";
  const std::pair<std::string, const char*> cases[] = {
      {           "f1.png", "Too many levels of symbolic links"},
      {roundabout + secret,                "File name too long"},
  };
  for (const auto& [target, why] : cases)
  {
    const SampleRecording recording;
    const std::string file = recording.files.path("rgb/f1.png");
    fs::remove(file);
    fs::create_symlink(target, file);
    const FrameFolder dataset = openFrameFolder("tum", recording.folder());
    ASSERT_EQ(dataset.listProblems().size(), 1u);
    EXPECT_EQ(
        dataset.listProblems()[0],
        file + ": " + why + " (" + recording.files.path("associations.txt:2)"));
    EXPECT_EQ(dataset.frames().size(), 5u);
    recording.files.write("associations.txt", SampleRecording::line(1, 100.1));
    expectInOneLine(errorOfOpening(recording), file + ": " + why);
  }
  const SampleRecording recording;
  const std::string name = "rgb/" + std::string(300, 'a');
  recording.files.write("associations.txt", "1 " + name + " 1 depth/f0.png\n");
  expectInOneLine(errorOfOpening(recording), name + ": File name too long");
  FrameFolderOptions anywhere;
  anywhere.imagesAnywhere = true;
  const FrameFolder dataset = openFrameFolder("tum", recording.folder(), anywhere);
  expectInOneLine(errorOf([&] { dataset.scan(0); }), name + ": File name too long");
}

TEST(TumFolder, RejectsMalformedDetections)
{
  const auto expect = [](const std::string& text, const std::string& what)
  {
    const SampleRecording recording;
    recording.files.write(SampleRecording::boxesFile(1), text);
    const FrameFolder dataset = openFrameFolder("tum", recording.folder());
    expectInOneLine(errorOf([&] { dataset.boxes(1); }), what);
  };
  expect("56 chair 0.8 1 2 3\n", "detections/f1.txt:1: expected 7 columns, got 6");
  expect("56 chair 0.8 1 2 3 x4\n", "detections/f1.txt:1: 'x4' is not a number");
  expect("\n56 chair 0,8 1 2 3 4\n", "detections/f1.txt:2: '0,8' is not a number");
  expect("5.5 chair 0.8 1 2 3 4\n", "detections/f1.txt:1: the number of a class is '5.5'");
  expect(
      "56 " + std::string(70000, 'z') + " 0.8 1 2 3 4\n",
      "detections/f1.txt:1: the name of a class has 70000 bytes, at most 200");
  expect("56 ch\x1b[31mair 0.8 1 2 3 4\n", "detections/f1.txt:1: the name of a class has control");
}

TEST(TumFolder, ReadsTheRealRecordings)
{
  const auto kitchen = testData("kitchen_a"), cabinet = testData("tum_fr3_cabinet");
  if (kitchen.empty() || cabinet.empty()) GTEST_SKIP() << "the recordings are not here";
  const FrameFolder k = openFrameFolder("tum", kitchen), c = openFrameFolder("tum", cabinet);
  EXPECT_EQ(k.frames().size(), 250u);
  EXPECT_EQ(c.frames().size(), 58u);
  std::size_t boxes = 0;
  for (std::size_t i = 0; i < c.frames().size(); ++i)
  {
    EXPECT_TRUE(c.T_world_robot(i));
    boxes += c.boxes(i)->objects.size();
  }
  EXPECT_EQ(boxes, 51u);
  // The kitchen's camera is held upright: its left axis stays level in the turned world.
  for (std::size_t i = 0; i < k.frames().size(); i += 10)
    EXPECT_LT(std::abs(k.T_world_robot(i)->getRotationMatrix()(2, 1)), 0.5) << "tilt below 30 deg";
}
