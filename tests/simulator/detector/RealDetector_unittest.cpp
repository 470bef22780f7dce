#include <gtest/gtest.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <array>

#include "../../obs/TestData.h"
#include "../SceneFixture.h"
#include "quadmap/folders/FolderKinds.h"
#include "quadmap/simulator/SimulatedDetector.h"

// Compares the default errors of the detector with those of a real one, both measured in the same
// way, and with the figures of doc/guide/write-a-scene.md.

namespace quadmap::simulator
{
namespace
{
using Boxes = std::vector<DetectedObject>;

constexpr std::array<double, 2> kSizes = {60, 250};  // bounds of the classes of size [px]

/** The box that overlaps most, and by more than a half. An empty `label` allows any label. */
const DetectedObject* matchOf(const ImageBox& box, const std::string& label, const Boxes& boxes)
{
  const DetectedObject* best = nullptr;
  double bestIoU = 0.5;
  for (const auto& other : boxes)
  {
    const double iou = imageBoxIoU(box, other.box);
    if (iou <= bestIoU || (!label.empty() && other.label != label)) continue;
    best = &other;
    bestIoU = iou;
  }
  return best;
}

/** An object that has boxes of one label before and after a frame. */
struct BoxPair
{
  DetectedObject before, after;
  ImageBox middle() const
  {
    return {
        0.5 * (before.box.x1 + after.box.x1), 0.5 * (before.box.y1 + after.box.y1),
        0.5 * (before.box.x2 + after.box.x2), 0.5 * (before.box.y2 + after.box.y2)};
  }
};

std::vector<BoxPair> boxPairsOf(const Boxes& before, const Boxes& after)
{
  std::vector<BoxPair> pairs;
  for (const auto& object : before)
    if (const auto* again = matchOf(object.box, object.label, after))
      pairs.push_back({object, *again});
  return pairs;
}

/** Errors of the boxes of frames that have a frame before and one after. */
struct BoxErrors
{
  std::array<std::vector<double>, 3> edges;  // errors of one frame, by class of size [px]
  unsigned pairs = 0, missed = 0, otherLabel = 0;
  unsigned sure = 0, sureMissed = 0;  // those with scores of 0.5 before and after

  void add(const BoxPair& pair, const Boxes& now)
  {
    const bool isSure = std::min(pair.before.score, pair.after.score) >= 0.5;
    const auto* found = matchOf(pair.middle(), pair.before.label, now);
    ++pairs;
    sure += isSure;
    if (found)
    {
      addEdges(pair.middle(), found->box);
      return;
    }
    ++missed;
    sureMissed += isSure;
    otherLabel += matchOf(pair.middle(), "", now) != nullptr;
  }

  /** Adds the errors of the edges, but not of those at the border of the image. */
  void addEdges(const ImageBox& expected, const ImageBox& box)
  {
    const double size = std::sqrt(expected.area());
    auto& errors = edges[size < kSizes[0] ? 0 : size < kSizes[1] ? 1 : 2];
    for (const auto& [edge, last] : {
             std::pair{&ImageBox::x1, 639.0},
             {&ImageBox::x2, 639.0},
             {&ImageBox::y1, 479.0},
             {&ImageBox::y2, 479.0}
    })
      if (expected.*edge > 5 && expected.*edge < last - 5)
        // Of three equal and independent errors e: e - (e + e) / 2 has 1.5 times the variance.
        errors.push_back((box.*edge - expected.*edge) / std::sqrt(1.5));
  }

  double deviation(std::size_t size) const { return momentsOf(edges[size]).deviation; }

  /** Standard deviation of a Gaussian whose middle half is as wide. */
  double middleDeviation(std::size_t size) const
  {
    std::vector<double> values;
    for (const double e : edges[size]) values.push_back(std::abs(e));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle / 0.6745;
  }

  /** Share of errors beyond three standard deviations. A Gaussian has 0.0027. */
  double tails(std::size_t size) const
  {
    const double limit = 3 * middleDeviation(size);
    const auto beyond = std::count_if(
        edges[size].begin(), edges[size].end(), [&](double e) { return std::abs(e) > limit; });
    return static_cast<double>(beyond) / static_cast<double>(edges[size].size());
  }
};

double share(unsigned part, unsigned all) { return part / static_cast<double>(all); }

/** The default detector in three frames of one object that does not move and is fully visible. */
class StillObject
{
 public:
  void measure(const BoxPair& pair, BoxErrors& errors)
  {
    const auto object = std::find_if(
        scene_.objects.begin(), scene_.objects.end(),
        [&](const SceneObject& o) { return o.label == pair.before.label; });
    if (object == scene_.objects.end()) return;
    const auto index = static_cast<std::size_t>(object - scene_.objects.begin());
    const VisibleObject seen{index, pair.middle(), 1, pair.middle()};
    std::array<Boxes, 3> frames;
    for (auto& frame : frames)
    {
      RandomStream random(1, Purpose::Detector, frameNumber_++);
      frame = detector_.detect({seen}, CameraOptions().pinhole(), random).boxes;
    }
    for (const auto& found : boxPairsOf(frames[0], frames[2])) errors.add(found, frames[1]);
  }

 private:
  static Scene sceneOfLabels()
  {
    std::string text = kRoomText;
    for (const auto* label : {"book", "chair", "cup", "dining table", "tv"})
      text += mrpt::format(
          "[object %s]\nlabel = %s\nposition = 0 0 0\npart = box 0 0 0 1 1 1 grey\n", label, label);
    return sceneFromText(text);
  }

  const Scene scene_ = sceneOfLabels();
  const LabelTable labels_ = LabelTable::installed();
  const SimulatedDetector detector_{scene_, DetectorOptions(), labels_};
  std::uint64_t frameNumber_ = 0;
};

TEST(RealDetector, SimulatedBoxesErrSimilarly)
{
  const std::string folder = testData("kitchen_a");
  if (folder.empty()) GTEST_SKIP() << "kitchen_a is not there";
  const FrameFolder data = openFrameFolder("tum", folder);
  const LabelTable labels = LabelTable::installed();
  std::vector<Boxes> frames;
  for (std::size_t i = 0; i < data.frames().size(); ++i)
  {
    frames.emplace_back();
    const auto boxes = data.boxes(i);
    if (boxes) frames.back() = boxes->objects;
    for (auto& box : frames.back()) box.label = labels.canonical(box.label);
  }
  BoxErrors real, simulated;
  StillObject still;
  for (std::size_t i = 1; i + 1 < frames.size(); ++i)
    for (const auto& pair : boxPairsOf(frames[i - 1], frames[i + 1]))
    {
      real.add(pair, frames[i]);
      for (int repeat = 0; repeat < 10; ++repeat) still.measure(pair, simulated);
    }

  const std::string guide = readFile(QUADMAP_SOURCE_DIR "/doc/guide/write-a-scene.md");
  const auto expectInGuide = [&](const std::string& row)
  { EXPECT_NE(std::string::npos, guide.find(row)) << row; };
  const char* const names[] = {"below 60 px", "60 to 250 px", "above 250 px"};
  for (std::size_t size = 0; size < 3; ++size)
  {
    const double there = real.middleDeviation(size), here = simulated.middleDeviation(size);
    // Of 228 edges at least, four of a box: +- 16 % when those of a box err together; two of these.
    EXPECT_LT(std::max(there / here, here / there), 1.35) << names[size];
    std::string row = mrpt::format("| %s | %zu |", names[size], real.edges[size].size());
    for (const auto* errors : {&real, &simulated})
      row += mrpt::format(
          " %.1f | %.1f | %.1f %% |", errors->middleDeviation(size), errors->deviation(size),
          100 * errors->tails(size));
    expectInGuide(row);
  }
  // 54 of 694: +- 1.1 %, three of these.
  EXPECT_NEAR(share(real.missed, real.pairs), share(simulated.missed, simulated.pairs), 0.033);
  EXPECT_NEAR(
      share(real.otherLabel, real.pairs), share(simulated.otherLabel, simulated.pairs), 0.015)
      << "11 of 694: +- 0.5 %, three of these";
  for (const auto& [name, errors] : {
           std::pair{     "real",      &real},
           {"simulated", &simulated}
  })
    expectInGuide(mrpt::format(
        "| %s | %u | %.1f %% | %.1f %% | %.1f %% |", name, errors->pairs,
        100 * share(errors->missed, errors->pairs), 100 * share(errors->otherLabel, errors->pairs),
        100 * share(errors->sureMissed, errors->sure)));
}

}  // namespace
}  // namespace quadmap::simulator
