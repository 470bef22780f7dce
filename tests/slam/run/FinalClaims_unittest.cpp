#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../SyntheticRoom.h"
#include "quadmap/slam/RawlogRun.h"

using namespace quadmap;

// A map is given away with all that speaks against it, (11.25): nobody estimates it once more.
TEST(FinalClaims, OfARunHoldWhatContradictsItsObjects)
{
  const TemporaryFolder folder;
  RawlogRunRequest request;
  request.rawlog = QUADMAP_SOURCE_DIR "/rawlogs/home.rawlog";
  request.outputDirectory = folder.path("out");
  const CQuadricObjectMap given = runOnRawlog(request).result.map;

  CQuadricObjectMap anew = given;
  double widest = 0;
  for (const auto& [id, object] : given.objects())
  {
    if (!object.confirmed) continue;
    anew.relabel(id, object.label());  // estimates it, without what contradicts the estimate
    const double without = anew.objects().at(id).covariance.trace();
    widest = std::max(widest, std::sqrt(object.covariance.trace() / without));
  }
  EXPECT_GT(widest, 1.5)
      << "the recording has an object that was seen larger than it is said to be";

  anew.conclude();
  for (const auto& [id, object] : given.objects())
  {
    if (!object.confirmed) continue;
    const UprightCovariance difference = anew.objects().at(id).covariance - object.covariance;
    EXPECT_LT(difference.norm(), 0.01 * object.covariance.norm()) << object.label();
  }
}
