#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "../obs/TemporaryFolder.h"
#include "KitchenModels.h"
#include "quadmap/detection/Detector.h"
#include "quadmap/geometry/ImageBox.h"
#include "quadmap/obs/LabelTable.h"

using namespace quadmap;

// Real networks on real images, whose boxes another program found. The tests look at a part of the
// images; all of them give the same shares.
namespace
{
namespace fs = std::filesystem;

/** The boxes of an image in the text files of a recording. */
std::vector<DetectedObject> referenceIn(const fs::path& file)
{
  std::ifstream in(file);
  std::vector<DetectedObject> objects;
  int id = 0;
  DetectedObject o;
  while (in >> id >> o.label >> o.score >> o.box.x1 >> o.box.y1 >> o.box.x2 >> o.box.y2)
    objects.push_back(o);
  return objects;
}

/** How many boxes of `wanted` are among `found`. */
std::size_t agreeing(
    const std::vector<DetectedObject>& wanted,
    const std::vector<DetectedObject>& found,
    double minOverlap)
{
  static const LabelTable labels = LabelTable::installed();
  std::vector<bool> used(found.size(), false);
  std::size_t count = 0;
  for (const auto& w : wanted)
    for (std::size_t i = 0; i < found.size(); ++i)
      if (!used[i] && labels.canonical(w.label) == labels.canonical(found[i].label) &&
          imageBoxIoU(w.box, found[i].box) >= minOverlap)
      {
        used[i] = true;
        ++count;
        break;
      }
  return count;
}

class RealNetworks : public KitchenModels
{
 protected:
  /** Every n-th image of the recording that has a file of boxes. */
  std::vector<std::string> imagesWithBoxes(const std::string& folder, std::size_t every) const
  {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(fs::path(kitchen_) / folder))
      all.insert(entry.path().stem().string());
    std::vector<std::string> names;
    std::size_t i = 0;
    for (const auto& name : all)
      if (i++ % every == 0) names.push_back(name);
    return names;
  }
  mrpt::img::CImage image(const std::string& name) const
  {
    const auto file = (fs::path(kitchen_) / "rgb" / (name + ".jpg")).string();
    return {cv::imread(file), mrpt::img::DEEP_COPY};
  }
  std::vector<DetectedObject> reference(const std::string& folder, const std::string& name) const
  {
    return referenceIn(fs::path(kitchen_) / folder / (name + ".txt"));
  }

  /** Boxes of a reference run, and how many of them the detector finds with an overlap >= 0.9. */
  std::pair<std::size_t, std::size_t> comparison(
      const std::string& model, const std::string& folder, std::size_t every) const
  {
    const auto detector = loadDetector(model);
    std::size_t wanted = 0, found = 0;
    for (const auto& name : imagesWithBoxes(folder, every))
    {
      const auto boxes = reference(folder, name);
      const auto own = detector->detect(image(name));
      EXPECT_NEAR(static_cast<double>(own.size()), static_cast<double>(boxes.size()), 1) << name;
      wanted += boxes.size();
      found += agreeing(boxes, own, 0.9);
    }
    return {wanted, found};
  }

  /** Share of a detector's sure boxes that YOLOv8n has, too, at half an overlap. */
  double agreementWithYolov8n(Detector& detector, std::size_t every, double minScore) const
  {
    std::size_t count = 0, confirmed = 0;
    for (const auto& name : imagesWithBoxes("detections_yolov8n", every))
    {
      auto own = detector.detect(image(name));
      own.erase(
          std::remove_if(own.begin(), own.end(), [&](const auto& o) { return o.score < minScore; }),
          own.end());
      count += own.size();
      confirmed += agreeing(own, reference("detections_yolov8n", name), 0.5);
    }
    EXPECT_GT(count, 0u);
    RecordProperty("boxes", static_cast<int>(count));
    RecordProperty("confirmed", static_cast<int>(confirmed));
    return static_cast<double>(confirmed) / static_cast<double>(count);
  }
};
}  // namespace

TEST_F(RealNetworks, NanoDetGivesTheBoxesOfTheReferenceRun)
{
  const auto [wanted, found] = comparison("nanodet-m", "detections", 10);
  EXPECT_GT(wanted, 100u);
  EXPECT_GE(static_cast<double>(found), 0.97 * static_cast<double>(wanted));
}

TEST_F(RealNetworks, Yolov8GivesTheBoxesOfTheReferenceRun)
{
  const auto [wanted, found] = comparison("yolov8n", "detections_yolov8n", 40);
  EXPECT_GT(wanted, 20u);
  EXPECT_GE(static_cast<double>(found), 0.97 * static_cast<double>(wanted));
}

TEST_F(RealNetworks, YoloxAgreesWithYolov8)
{
  const auto detector = loadDetector("yolox-nano");
  EXPECT_GE(agreementWithYolov8n(*detector, 20, 0.5), 0.7);
}

TEST_F(RealNetworks, YoloFastestAgreesWithYolov8)
{
  const auto detector = loadDetector("yolo-fastest-1.1-xl");
  EXPECT_GE(agreementWithYolov8n(*detector, 10, 0.4), 0.4) << "a weak network";
}

TEST_F(RealNetworks, Yolov8SegHasMasksOfItsObjects)
{
  const TemporaryFolder folder;
  const std::string unpack =
      "gunzip -c '" + models_ + "/yolov8n-seg.onnx.gz' > '" + folder.path("yolov8n-seg.onnx") + "'";
  ASSERT_EQ(std::system(unpack.c_str()), 0);
  ::setenv("QUADMAP_MODELS", folder.folder().c_str(), 1);
  const auto detector = loadDetector("yolov8n-seg");
  EXPECT_EQ(detector->description(), "yolov8n-seg (yolov8 with masks, 80 labels, input 640x640)");
  EXPECT_GE(agreementWithYolov8n(*detector, 60, 0.4), 0.7);
  for (const auto& object : detector->detect(image(imagesWithBoxes("detections", 1).front())))
  {
    ASSERT_TRUE(object.mask) << object.label;
    const auto& mask = *object.mask;
    EXPECT_GE(mask.x0, object.box.x1 - 1);
    EXPECT_LE(mask.x0 + mask.width, object.box.x2 + 1);
    EXPECT_LE(mask.y0 + mask.height, object.box.y2 + 1);
    const auto pixels = mask.pixels.expanded();
    const auto covered = std::count(pixels.begin(), pixels.end(), 1);
    EXPECT_GE(static_cast<double>(covered), 0.2 * object.box.area()) << object.label;
  }
}
