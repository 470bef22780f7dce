#include "DeviceClock.h"

#include <gtest/gtest.h>

#include <random>

using namespace quadmap;

TEST(DeviceClock, FollowsTheCameraAndNotTheDelaysOnItsWay)
{
  constexpr double kStart = 1.7e9, kLeast = 0.01;  // wall time of the camera's start; delay [s]
  std::mt19937 random(1);
  std::exponential_distribution<double> delay(1 / 0.02);
  DeviceClock clock;
  const double first = delay(random);
  clock.wallTime(0, kStart + kLeast + first);
  for (int i = 1; i < 3000; ++i)
  {
    const double device = i / 30.0;
    const double wall = clock.wallTime(device, kStart + device + kLeast + delay(random));
    // The first delay is forgotten at the rate kSlew, and a second shows what delays are short.
    if (device < first / DeviceClock::kSlew + 1) continue;
    EXPECT_NEAR(wall, kStart + device + kLeast, 0.004) << i;
  }
}

TEST(DeviceClock, FollowsAClockThatIsSlow)
{
  constexpr double kSlow = 1e-4;
  DeviceClock clock;
  for (int i = 0; i < 30000; ++i)
  {
    const double device = i / 30.0, arrival = 1000 + device * (1 + kSlow);
    EXPECT_NEAR(clock.wallTime(device, arrival), arrival, 1e-6);
  }
}

TEST(DeviceClock, TimesAlwaysGrow)
{
  DeviceClock clock;
  double last = 0;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> delay(0, 0.3);
  for (int i = 0; i < 1000; ++i)
  {
    const double device = i / 60.0, wall = clock.wallTime(device, 1000 + device + delay(random));
    EXPECT_GT(wall - last, 0.89 / 60) << "the camera says 1/60 s";
    last = wall;
  }
}

TEST(DeviceClock, DoesNotFollowAWallClockThatIsSet)
{
  DeviceClock clock;
  EXPECT_DOUBLE_EQ(clock.wallTime(0, 1000), 1000);
  EXPECT_NEAR(clock.wallTime(1, 1001 + 3600), 1001, 1e-9);
  EXPECT_NEAR(clock.wallTime(2, 1002 - 3600), 1002, 1e-9);
}

TEST(DeviceClock, FollowsACameraThatStartsItsClockAnew)
{
  DeviceClock clock;
  EXPECT_DOUBLE_EQ(clock.wallTime(50, 1000), 1000);
  EXPECT_DOUBLE_EQ(clock.wallTime(0, 1001), 1001);
  EXPECT_NEAR(clock.wallTime(1, 1002), 1002, 1e-9);
  EXPECT_GT(clock.wallTime(0, 1001.5), 1002) << "never back";
}
