#include "boxes/BoxReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "../../obs/TemporaryFolder.h"

using namespace quadmap;

namespace
{
/** Files of boxes for images of 640 x 480 pixels. */
class BoxFiles : public ::testing::Test
{
 protected:
  BoxFiles() { camera_.ncols = 640, camera_.nrows = 480; }

  std::optional<std::vector<DetectedObject>> read(
      const std::string& image, const std::string& place = "", const std::string& labels = "") const
  {
    FolderFrame frame;
    frame.color = "/recording/rgb/" + image;
    return openBoxes(files_.path(place), labels)->boxes(frame, camera_);
  }
  /** Whether none of the boxes of a file is of an image. */
  bool isOfOtherImages(const std::string& place, const std::string& image) const
  {
    FolderFrame frame;
    frame.color = "/recording/rgb/" + image;
    return openBoxes(files_.path(place), "")->isOfOtherImages({frame});
  }
  /** Writes r.json, results with a box of class k for the k-th image. */
  void writeResults(const std::vector<std::string>& images)
  {
    std::string text;
    for (std::size_t k = 0; k < images.size(); ++k)
      text += (k == 0 ? "[" : ",") + (R"({"image_id": ")" + images[k]) + R"(", "category_id": )" +
              std::to_string(k + 1) + R"(, "bbox": [1, 2, 3, 4]})";
    files_.write("r.json", text + "]");
  }
  /** Which image of r.json has the boxes of an image of a recording, from 1; 0: none. */
  int imageOf(const std::string& image) const
  {
    FolderFrame frame;
    frame.color = image;
    const auto boxes = openBoxes(files_.path("r.json"), "")->boxes(frame, camera_);
    const std::vector<std::string> labels{"person", "bicycle", "car", "motorcycle"};
    if (boxes->empty()) return 0;
    const auto label = std::find(labels.begin(), labels.end(), boxes->at(0).label);
    return static_cast<int>(label - labels.begin()) + 1;
  }
  std::string errorOfReading(
      const std::string& image, const std::string& place = "", const std::string& labels = "") const
  {
    return errorOf([&] { read(image, place, labels); });
  }

  TemporaryFolder files_;
  mrpt::img::TCamera camera_;
};

void expectBox(const DetectedObject& o, const std::string& label, double score, const ImageBox& b)
{
  EXPECT_EQ(o.label, label);
  EXPECT_DOUBLE_EQ(o.score, score);
  EXPECT_NEAR(o.box.x1, b.x1, 1e-9);
  EXPECT_NEAR(o.box.y1, b.y1, 1e-9);
  EXPECT_NEAR(o.box.x2, b.x2, 1e-9);
  EXPECT_NEAR(o.box.y2, b.y2, 1e-9);
}

void expectIn(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}
}  // namespace

TEST_F(BoxFiles, OwnFormHasNamesWithBlanks)
{
  files_.write("a.txt", "40 wine glass 0.5 1 2 3 4\n41 cup 0.25 5 6 7 8\n");
  const auto boxes = read("a.jpg");
  ASSERT_TRUE(boxes);
  ASSERT_EQ(boxes->size(), 2u);
  expectBox(boxes->at(0), "wine glass", 0.5, {1, 2, 3, 4});
  expectBox(boxes->at(1), "cup", 0.25, {5, 6, 7, 8});
  EXPECT_FALSE(read("b.jpg")) << "no file: the detector did not look";
}

TEST_F(BoxFiles, MayBeNamedWithoutTheWordColor)
{
  files_.write("frame-000016.txt", "41 cup 0.25 5 6 7 8\n");
  EXPECT_TRUE(read("frame-000016.color.png")) << "the images of 7-Scenes";
}

TEST_F(BoxFiles, YoloFormHasSharesOfTheImage)
{
  files_.write("a.txt", "56 0.5 0.25 0.1 0.2\n39 0.25 0.5 0.5 1 0.75\n");
  files_.write("none.txt", "");
  const auto boxes = read("a.png");
  ASSERT_TRUE(boxes);
  ASSERT_EQ(boxes->size(), 2u);
  expectBox(boxes->at(0), "chair", 1.0, {288, 72, 352, 168});
  expectBox(boxes->at(1), "bottle", 0.75, {0, 0, 320, 480});
  EXPECT_TRUE(read("none.png")->empty());
}

TEST_F(BoxFiles, YoloOutlinesGiveTheBoxesAroundThem)
{
  // As -seg models write them: the last one with its score, which is no coordinate.
  files_.write(
      "a.txt",
      "56 0.5 0.25 0.6 0.75 0.4 0.5\n39 0.1 0.2 0.3 0.2 0.3 0.4 0.1 0.4\n"
      "41 0.5 0 1 0 1 1 0.5 1 0.125\n");
  const auto boxes = read("a.png");
  ASSERT_TRUE(boxes);
  ASSERT_EQ(boxes->size(), 3u);
  expectBox(boxes->at(0), "chair", 1.0, {256, 120, 384, 360});
  expectBox(boxes->at(1), "bottle", 1.0, {64, 96, 192, 192});
  expectBox(boxes->at(2), "cup", 0.125, {320, 0, 640, 480});
}

TEST_F(BoxFiles, YoloNamesAreTakenFromAFile)
{
  files_.write("a.txt", "1 0.5 0.5 0.5 0.5\n");
  const auto names = files_.write("my.names", "shelf\noffice chair\n");
  EXPECT_EQ(read("a.png", "", names)->at(0).label, "office chair");
  EXPECT_EQ(read("a.png")->at(0).label, "bicycle") << "of COCO";
  files_.write("classes.txt", "a b\nsofa bed\n");
  EXPECT_EQ(read("a.png")->at(0).label, "sofa bed") << "the file beside the boxes";
  std::filesystem::create_directory(files_.path("labels"));
  files_.write("labels/a.txt", "0 0.5 0.5 0.5 0.5\n");
  EXPECT_EQ(read("a.png", "labels")->at(0).label, "a b") << "the file in the folder above";
}

TEST_F(BoxFiles, SaysWhenNumbersAreTakenForClassesOfCoco)
{
  files_.write("a.txt", "1 0.5 0.5 0.5 0.5\n");
  const auto results = files_.write("r.json", "[]");
  const auto dataset =
      files_.write("d.json", R"({"images": [], "categories": [], "annotations": []})");
  const auto own = files_.write("my.names", "shelf\noffice chair\n");
  const std::string folder = files_.folder().string();
  for (const auto& place : {folder, results})
  {
    expectIn(openBoxes(place, "")->note(), place + ": no file names the classes");
    EXPECT_EQ(openBoxes(place, own)->note(), "") << place;
  }
  EXPECT_EQ(openBoxes(dataset, "")->note(), "");
  files_.write("classes.txt", "shelf\noffice chair\n");
  EXPECT_EQ(openBoxes(folder, "")->note(), "");
}

TEST_F(BoxFiles, SaysThatNamesAreNotUsedWhereBoxesHaveTheirOwn)
{
  files_.write("a.txt", "41 cup 0.25 5 6 7 8\n");
  const auto dataset =
      files_.write("d.json", R"({"images": [], "categories": [], "annotations": []})");
  for (const auto& place : {files_.folder().string(), dataset})
  {
    EXPECT_EQ(
        openBoxes(place, "my.names")->note(),
        place + ": names its classes itself; --labels my.names is not used");
    EXPECT_EQ(openBoxes(place, "")->note(), "") << place;
  }
}

TEST_F(BoxFiles, TellsLineAndFileOfWrongLines)
{
  files_.write("a.txt", "0 0.5 0.5 0.5 0.5\n");
  const auto expect = [&](const std::string& text, const std::string& what)
  {
    files_.write("b.txt", text);
    expectIn(errorOfReading("b.png"), "b.txt:" + what);
  };
  expect("0 0.5 0.5 0.5\n", "1: expected 5 columns, got 4");
  expect("0 0.5 0.5 0.5 0.5\n80 0.5 0.5 0.5 0.5\n", "2: class '80' is none of the 80 of ");
  expect("1.5 0.5 0.5 0.5 0.5\n", "1: class '1.5' is none");
  expect("0 0.5 0.5 0.5 0.5x\n", "1: '0.5x' is not a number");
  expect("0 0.1 0.1 0.2 0.1 0.2 0.2 0.1 1.2\n", "1: expected 5 columns, got 9");
  std::string many;
  for (int i = 0; i <= 100'000; ++i) many += "0 0.5 0.5 0.5 0.5\n";
  expect(many, " more than 100000 boxes in one image");
  expectIn(errorOfReading("a.png", "", files_.path("no.names")), "no.names: cannot be read");
  files_.write("my.names", "cup\n" + std::string(201, 'x') + "\n");
  expectIn(
      errorOfReading("a.png", "", files_.path("my.names")),
      "my.names:2: the name of a class has 201 bytes, at most 200");
}

TEST_F(BoxFiles, CocoDataSetsHaveTheirOwnNames)
{
  files_.write(
      "x.json",
      R"({"images": [{"id": 7, "file_name": "rgb/a.jpg"}, {"id": 8, "file_name": "b.jpg"}],
    "categories": [{"id": 3, "name": "wine glass"}],
    "annotations": [{"id": 1, "image_id": 7, "category_id": 3, "bbox": [10, 20, 30, 40], "area": 1},
                    {"id": 2, "image_id": 7, "category_id": 3, "bbox": [1, 2, 3, 4], "score": 0.5}]})");
  const auto boxes = read("a.png", "x.json");
  ASSERT_TRUE(boxes);
  ASSERT_EQ(boxes->size(), 2u);
  expectBox(boxes->at(0), "wine glass", 1.0, {10, 20, 40, 60});
  expectBox(boxes->at(1), "wine glass", 0.5, {1, 2, 4, 6});
  EXPECT_TRUE(read("b.png", "x.json")->empty()) << "listed, without a box";
  EXPECT_FALSE(read("c.png", "x.json")) << "not listed";
  FolderFrame frame;
  frame.color = "/recording/rgb/c.png";
  EXPECT_EQ(
      openBoxes(files_.path("x.json"), "")->fileOf(frame), files_.path("x.json") + ": image c");
}

TEST_F(BoxFiles, CocoDataSetsOfImagesOfAnotherSizeAreRefused)
{
  const auto write = [&](const std::string& size)
  {
    files_.write(
        "x.json", R"({"images": [{"id": 7, "file_name": "a.jpg", )" + size +
                      R"(}], "categories": [{"id": 3, "name": "vase"}],
    "annotations": [{"id": 1, "image_id": 7, "category_id": 3, "bbox": [10, 20, 30, 40]}]})");
  };
  write(R"("width": 640, "height": 480)");
  EXPECT_EQ(read("a.png", "x.json")->size(), 1u);
  write(R"("width": 1280, "height": 960)");
  EXPECT_EQ(
      errorOfReading("a.png", "x.json"),
      files_.path("x.json") +
          ": image a.jpg has 1280x960 pixels there, and 640x480 in the recording: its boxes do not "
          "fit");
  EXPECT_FALSE(read("b.png", "x.json"));
}

TEST_F(BoxFiles, CocoResultsHaveNumbersOfImagesAndClasses)
{
  files_.write(
      "r.json", R"([{"image_id": 16, "category_id": 62, "bbox": [1, 2, 3, 4], "score": 0.5},
    {"image_id": "b", "category_id": 90, "bbox": [1, 2, 3, 4], "score": 0.25}])");
  ASSERT_EQ(read("frame-000016.jpg", "r.json")->size(), 1u);
  expectBox(read("frame-000016.jpg", "r.json")->at(0), "chair", 0.5, {1, 2, 4, 6});
  expectBox(read("frame-000016.color.jpg", "r.json")->at(0), "chair", 0.5, {1, 2, 4, 6});
  expectBox(read("b.jpg", "r.json")->at(0), "toothbrush", 0.25, {1, 2, 4, 6});
  EXPECT_TRUE(read("c.jpg", "r.json")->empty());
  files_.write("own.json", R"([{"image_id": 0, "category_id": 1, "bbox": [1, 2, 3, 4]}])");
  const auto names = files_.write("names", "desk\nlamp\n");
  EXPECT_EQ(read("0.png", "own.json", names)->at(0).label, "lamp") << "counted from 0";
}

TEST_F(BoxFiles, CocoResultsMayHaveTimesAsNames)
{
  files_.write(
      "r.json", R"([{"image_id": "1305031102.175304", "category_id": 62, "bbox": [1, 2, 3, 4]},
    {"image_id": "rgb/1305031103.5.JPG", "category_id": 62, "bbox": [1, 2, 3, 4]}])");
  EXPECT_EQ(read("1305031102.175304.png", "r.json")->size(), 1u);
  EXPECT_EQ(read("1305031103.5.png", "r.json")->size(), 1u);
  EXPECT_TRUE(read("1305031102.png", "r.json")->empty()) << "another time";
}

TEST_F(BoxFiles, CocoResultsMayBeOfOtherImages)
{
  files_.write("r.json", R"([{"image_id": "a", "category_id": 62, "bbox": [1, 2, 3, 4]}])");
  files_.write("none.json", "[]");
  EXPECT_TRUE(isOfOtherImages("r.json", "b.png"));
  EXPECT_FALSE(isOfOtherImages("r.json", "a.png"));
  EXPECT_FALSE(isOfOtherImages("none.json", "b.png")) << "a detector that found nothing";
}

TEST_F(BoxFiles, CocoImagesOfEqualNamesAreToldApartByTheirFolders)
{
  writeResults({"left/a.jpg", "right/a.jpg", "right/b.jpg", "./hall/right/c.jpg"});
  EXPECT_EQ(imageOf("/room/left/a.png"), 1);
  EXPECT_EQ(imageOf("/room/right/a.png"), 2);
  EXPECT_EQ(imageOf("/room/left/b.png"), 0) << "right/ has another image a: it is another camera";
  EXPECT_EQ(imageOf("/room/right/b.png"), 3);
  EXPECT_EQ(imageOf("/hall/right/c.png"), 4) << "two folders of the path agree";
  EXPECT_EQ(imageOf("/room/left/c.png"), 4) << "nothing says that hall/right is another camera";
  EXPECT_EQ(imageOf("/room/rgb/b.png"), 3) << "the only image of this name";
  EXPECT_EQ(
      errorOf([&] { imageOf("/room/rgb/a.png"); }),
      files_.path("r.json") +
          ": image left/a.jpg and image right/a.jpg may both be /room/rgb/a.png; name them with "
          "folders that end as those of the recording");
  EXPECT_FALSE(isOfOtherImages("r.json", "a.png")) << "one of them is, and reading them tells";
}

TEST_F(BoxFiles, CocoImagesOfUniqueNamesMayBeInAnyFolder)
{
  writeResults({"train/100.000000.png", "val/rgb/100.033333.png", "train/100.066667.png"});
  EXPECT_EQ(imageOf("/data/room1/rgb/100.000000.png"), 1);
  EXPECT_EQ(imageOf("/data/room1/rgb/100.033333.png"), 2) << "although it alone is in rgb/";
  EXPECT_EQ(imageOf("/data/room1/rgb/100.066667.png"), 3);
}

TEST_F(BoxFiles, OfCocoImagesOfEqualNamesTheLongerCommonPathCounts)
{
  writeResults({"a.png", "rgb/a.png", "b.png"});
  EXPECT_EQ(imageOf("/room1/rgb/a.png"), 2);
  EXPECT_EQ(imageOf("/room1/rgb/b.png"), 3) << "no folders, none that differs";
  EXPECT_EQ(imageOf("/room1/color/a.png"), 1) << "rgb/ differs";
  writeResults({"left/a.jpg", "/data/left/a.jpg"});
  EXPECT_EQ(imageOf("/data/left/a.png"), 2);
  EXPECT_EQ(imageOf("/room/left/a.png"), 1) << "/data differs";
}

TEST_F(BoxFiles, CocoDataSetsHaveImagesOfEqualNames)
{
  files_.write(
      "x.json",
      R"({"images": [{"id": 7, "file_name": "rgb/a.jpg"}, {"id": 8, "file_name": "other/a.jpg"}],
    "categories": [{"id": 3, "name": "vase"}],
    "annotations": [{"id": 1, "image_id": 8, "category_id": 3, "bbox": [10, 20, 30, 40]}]})");
  EXPECT_TRUE(read("a.jpg", "x.json")->empty()) << "the box is of the image in other/";
}

TEST_F(BoxFiles, TracksOfYoloAreNotTakenForNamedBoxes)
{
  files_.write("a.txt", "56 0.5 0.25 0.1 0.2 0.9 3\n");
  expectIn(errorOfReading("a.png"), "a.txt:1: the name of a class is '0.5', a number");
}

TEST_F(BoxFiles, TellsWhatIsWrongInCocoFiles)
{
  const auto expect = [&](const std::string& text, const std::string& what)
  {
    files_.write("x.json", text);
    const auto error = errorOfReading("a.png", "x.json");
    EXPECT_EQ(error.find(files_.path("x.json")), 0u) << error;
    expectIn(error, what);
  };
  expect("7", "is neither a list of results nor a data set of COCO");
  expect("{", "x.json");
  expect("{}", "'images' is missing or of another type");
  expect(
      R"([{"image_id": 1, "category_id": 12, "bbox": [1, 2, 3, 4]}])",
      "result 0: class 12 is none");
  expect(
      R"([{"image_id": 1, "category_id": 91, "bbox": [1, 2, 3, 4]}])",
      "result 0: class 91 is none");
  expect(R"([{"image_id": 1, "category_id": 1, "bbox": [1, 2, 3]}])", "'bbox' must have 4 numbers");
  expect(
      R"([{"image_id": 1, "category_id": "x", "bbox": [1, 2, 3, 4]}])", "result 0: 'category_id'");
  expect(
      R"([{"image_id": 1.5, "category_id": 1, "bbox": [1, 2, 3, 4]}])",
      "must be a name or a whole");
  expect(
      R"({"images": [], "categories": [], "annotations": [{"image_id": 1, "category_id": 1, "bbox": []}]})",
      "annotation 0: is of an image or a category that is not there");
  expectIn(errorOfReading("a.png", "no"), "no: no such folder (of detections)");
  for (const std::string number : {"1e300", "1.5", "-9223372036854775808", "18446744073709551615"})
  {
    expect(
        R"([{"image_id": 1, "category_id": )" + number + R"(, "bbox": [1, 2, 3, 4]}])", "result 0");
    expect(
        R"({"images": [{"id": 1, "file_name": "a.png"}], "categories": [], "annotations":
            [{"image_id": 1, "category_id": )" +
            number + R"(, "bbox": [1, 2, 3, 4]}]})",
        "annotation 0");
  }
}
