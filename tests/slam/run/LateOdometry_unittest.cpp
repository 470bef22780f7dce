#include <gtest/gtest.h>
#include <mrpt/obs/CRawlog.h>

#include <algorithm>
#include <map>
#include <utility>

#include "../../sensors/SampleRawlog.h"
#include "quadmap/simulator/Simulator.h"
#include "quadmap/slam/RawlogRun.h"

using namespace quadmap;

namespace
{
/** Gives the odometry of a recording the times at which a late clock has it, all but the first
 * pose, where the robot stands. */
void delayOdometry(const std::string& rawlog, double seconds)
{
  mrpt::obs::CRawlog recorded, late;
  ASSERT_TRUE(recorded.loadFromRawLogFile(rawlog));
  std::multimap<mrpt::Clock::time_point, mrpt::obs::CObservation::Ptr> byTime;
  bool isFirst = true;
  for (std::size_t i = 0; i < recorded.size(); ++i)
  {
    const auto observation = recorded.getAsObservation(i);
    if (observation->sensorLabel == "odometry" && !std::exchange(isFirst, false))
      observation->timestamp =
          mrpt::Clock::fromDouble(mrpt::Clock::toDouble(observation->timestamp) + seconds);
    byTime.emplace(observation->timestamp, observation);
  }
  for (const auto& [time, observation] : byTime) late.insert(observation);
  ASSERT_TRUE(late.saveToRawLogFile(rawlog));
}

/** Warnings of a run along a corridor and back that say that the poses are doubtful. */
std::ptrdiff_t doubtsWhenLateBy(double seconds)
{
  const TemporaryFolder folder;
  auto scene = simulator::readScene(simulator::findScene("corridor"));
  scene.options.resize(160, 120);
  RawlogRunRequest request;
  request.rawlog = folder.path("a.rawlog");
  request.outputDirectory = folder.path("out");
  simulator::simulateToFiles(
      simulator::Simulator(scene, LabelTable::installed(), 1), request.rawlog);
  if (seconds > 0) delayOdometry(request.rawlog, seconds);
  const auto warnings = runOnRawlog(request).result.warnings;
  return std::count_if(
      warnings.begin(), warnings.end(),
      [](const auto& text)
      { return text.find("that the robot came back to were gone") != std::string::npos; });
}
}  // namespace

// On a straight way at one speed no step contradicts what is seen. The things on the way back are
// elsewhere than on the way there.
TEST(LateOdometry, IsTold) { EXPECT_EQ(doubtsWhenLateBy(5), 1); }

TEST(LateOdometry, IsNotToldOfWhatIsInTime) { EXPECT_EQ(doubtsWhenLateBy(0), 0); }
