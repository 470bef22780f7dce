#include "quadmap/estimation/Existence.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quadmap;

TEST(Existence, ADetectionAndAMissAddTheLogRatiosOfTheirProbabilities)
{
  const ExistenceEvidence evidence(0.5, 0.1);
  EXPECT_DOUBLE_EQ(evidence.detection(), std::log(5));
  EXPECT_DOUBLE_EQ(evidence.miss(), std::log(0.5 / 0.9));
}

TEST(Existence, DetectionsAddUpToABound)
{
  ExistenceOptions options;
  EXPECT_DOUBLE_EQ(existenceAfterDetections(1, 0.5, options), 1 + 0.5 * std::log(5));
  EXPECT_EQ(existenceAfterDetections(options.maxLogOdds - 0.1, 1, options), options.maxLogOdds);
}

TEST(Existence, ABoxShowsAnObjectWhenItLiesInTheOutlineAndTheLabelsAgree)
{
  LabelTable labels;
  MapObject object;
  object.labelCounts["chair"] = 3;
  const ImageBox outline{100, 100, 200, 200};
  const ShownRule rule;
  const auto shows = [&](const ImageBox& box, const std::string& label)
  { return mayShow(box, label, object, outline, labels, rule); };
  EXPECT_TRUE(shows({110, 110, 190, 190}, "chair"));
  EXPECT_FALSE(shows({110, 110, 190, 190}, "spoon")) << "another label";
  EXPECT_FALSE(shows({110, 110, 130, 130}, "chair")) << "a speck in the outline";
  EXPECT_FALSE(shows({50, 50, 250, 250}, "chair")) << "three quarters of the box are outside";
  ShownRule anySize = rule;
  anySize.minInside = 0;
  EXPECT_TRUE(mayShow({50, 50, 250, 250}, "chair", object, outline, labels, anySize));
}
