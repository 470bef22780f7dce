#include <gtest/gtest.h>
#include <malloc.h>

#include "../surfaces/SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

using namespace quadmap;

namespace
{
/** Allocated and not freed in this process [bytes]; all of malloc, whoever called it. */
std::size_t liveMemory()
{
  const auto info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}
}  // namespace

TEST(FramePerception, KeepsNoMemoryOfFrames)
{
  std::vector<mrpt::obs::CObservation3DRangeScan> scans;
  std::vector<CObservationObjects> boxes;
  Eigen::Vector3d up_sensor;
  for (int i = 0; i < 4; ++i)
  {
    SyntheticFrame frame;
    frame.noise = 0.002;
    frame.add(1.9 + 0.1 * i, -0.3, 0, 0.4 * i, {0.4, 0.5, 0.6});
    frame.add(2.4, 0.5, 0, 0.2, {0.5, 0.5, 0.8});
    up_sensor = frame.up_sensor();
    scans.push_back(frame.scan());
    boxes.push_back(frame.observation({frame.detect(0, "suitcase"), frame.detect(1, "chair")}));
  }
  const FramePerception perception(PerceptionOptions(), LabelTable::installed());
  const auto measureAll = [&](int passes)
  {
    for (int pass = 0; pass < passes; ++pass)
      for (std::size_t i = 0; i < scans.size(); ++i)
      {
        CObservationObjects measured = boxes[i];
        perception.measure(scans[i], measured, up_sensor);
        ASSERT_NE(measured.objects[0].measurement.kind, MeasurementKind::None);
      }
  };
  // Threads of the libraries keep a few freed bytes for themselves, more or fewer as they happen to
  // run; what a frame leaves behind adds up in every pass.
  constexpr int kPasses = 20;
  measureAll(2);
  int grown = 0;
  for (int pass = 0; pass < kPasses; ++pass)
  {
    const std::size_t before = liveMemory();
    if (before == 0) GTEST_SKIP() << "malloc is not that of the C library";
    measureAll(1);
    if (liveMemory() > before) ++grown;
  }
  EXPECT_LT(grown, kPasses / 2) << "of " << kPasses << " passes";
}
