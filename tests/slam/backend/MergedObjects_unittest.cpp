#include "backend/MergedObjects.h"

#include <gtest/gtest.h>

#include "../../maps/ObjectMapFixture.h"

using namespace quadmap;
using namespace quadmap::testing;

TEST(MergedObjects, ViewsAndPlacesGoToTheHeir)
{
  CQuadricObjectMap map = smallMap();
  ASSERT_EQ(map.objects().size(), 2u);
  const ObjectId kept = map.objects().begin()->first, absorbed = map.objects().rbegin()->first;
  for (const bool heirIsKnown : {true, false})
  {
    FactorGraph graph({});
    CamerasOf cameras{
        {    kept,            {{1, 0, 0}}},
        {absorbed, {{2, 0, 0}, {3, 0, 0}}}
    };
    graph.addPose({});
    graph.setObject(absorbed, map.find(absorbed)->object, LabelProperties());
    if (heirIsKnown) graph.setObject(kept, map.find(kept)->object, LabelProperties());
    for (int i = 0; i < 3; ++i) graph.addView(0, absorbed, BoxMeasurement());

    CQuadricObjectMap merged = map;
    merged.merge(kept, absorbed);
    followMerged(merged, graph, cameras);
    EXPECT_FALSE(graph.hasObject(absorbed));
    EXPECT_TRUE(graph.hasObject(kept));
    EXPECT_EQ(graph.viewCount(), 3u);
    graph.removeObject(kept);
    EXPECT_EQ(graph.viewCount(), 0u) << "they were the heir's";
    EXPECT_EQ(cameras.count(absorbed), 0u);
    EXPECT_EQ(cameras.at(kept).size(), 3u);
  }
}

TEST(MergedObjects, BoxesOfEarlierKeyframesGoToTheHeir)
{
  CQuadricObjectMap map = smallMap();
  const ObjectId kept = map.objects().begin()->first, absorbed = map.objects().rbegin()->first;
  std::vector<BoxDecision> decisions(4);
  decisions[0].decision.object = kept;
  decisions[1].decision.object = absorbed;
  decisions[3].decision.object = absorbed + 1;
  map.merge(kept, absorbed);
  followMerged(map, decisions);
  EXPECT_EQ(decisions[0].decision.object, kept);
  EXPECT_EQ(decisions[1].decision.object, kept);
  EXPECT_FALSE(decisions[2].decision.object);
  EXPECT_EQ(decisions[3].decision.object, absorbed + 1);
}
