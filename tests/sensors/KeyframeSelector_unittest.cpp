#include "quadmap/sensors/KeyframeSelector.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
KeyframeOptions byMotion()
{
  KeyframeOptions options;
  options.every = 0;
  options.minTranslation = 0.1;
  options.minRotation = mrpt::DEG2RAD(5.0);
  options.maxInterval = 2.0;
  return options;
}
}  // namespace

TEST(KeyframeSelector, EveryNthFrameOfEachSensor)
{
  KeyframeOptions options;
  options.every = 3;
  KeyframeSelector selector(options);
  std::string left, right;
  for (int i = 0; i < 7; ++i)
  {
    left += selector.isKeyframe("left", i, CPose3D(i, 0, 0, 0, 0, 0)) ? 'K' : '-';
    if (i >= 2) right += selector.isKeyframe("right", i, CPose3D()) ? 'K' : '-';
  }
  EXPECT_EQ(left, "K--K--K");
  EXPECT_EQ(right, "K--K-");
}

TEST(KeyframeSelector, TranslationAddsUpOverFrames)
{
  KeyframeSelector selector(byMotion());
  std::string kinds;
  for (int i = 0; i < 8; ++i)  // 3.5 cm a frame: the limit is passed in every third
    kinds += selector.isKeyframe("c", 0.01 * i, CPose3D(0, 0.035 * i, 0, 0, 0, 0)) ? 'K' : '-';
  EXPECT_EQ(kinds, "K--K--K-");
}

TEST(KeyframeSelector, RotationCountsAboutAnyAxisAndAcrossPi)
{
  for (const CPose3D& axis :
       {CPose3D(0, 0, 0, 1, 0, 0), CPose3D(0, 0, 0, 0, 1, 0), CPose3D(0, 0, 0, 0, 0, 1)})
  {
    const auto turned = [&](double degrees)
    {
      const double a = mrpt::DEG2RAD(degrees);
      return CPose3D(0, 0, 0, a * axis.yaw(), a * axis.pitch(), a * axis.roll());
    };
    KeyframeSelector selector(byMotion());
    EXPECT_TRUE(selector.isKeyframe("c", 0, turned(178)));
    EXPECT_FALSE(selector.isKeyframe("c", 0.1, turned(182)));  // 4 degrees, -178 to MRPT
    EXPECT_TRUE(selector.isKeyframe("c", 0.2, turned(184)));
  }
}

TEST(KeyframeSelector, TimeAloneMakesAKeyframe)
{
  KeyframeSelector selector(byMotion());
  EXPECT_TRUE(selector.isKeyframe("c", 100.0, CPose3D()));
  EXPECT_FALSE(selector.isKeyframe("c", 101.9, CPose3D()));
  EXPECT_TRUE(selector.isKeyframe("c", 102.0, CPose3D()));
  EXPECT_FALSE(selector.isKeyframe("c", 103.9, CPose3D())) << "the clock starts at the last one";
}
