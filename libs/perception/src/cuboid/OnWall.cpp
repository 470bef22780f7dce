#include "cuboid/OnWall.h"

#include "cuboid/FaceSigmas.h"

namespace quadmap
{
void endAtWall(
    const WallDistance& onWall,
    const FaceEstimator& estimator,
    const PerceptionOptions& options,
    Faces& faces)
{
  constexpr double kParallel = 0.98;  // cosine: 11 degrees
  const Eigen::Vector3d outOfWall = estimator.R_obj_optical() * onWall.wall.n;
  for (std::size_t back = 0; back < 4; ++back)
  {
    if (-estimator.normalOf(back).dot(outOfWall) < kParallel) continue;
    FaceEstimate& front = faces[back ^ 1U];
    faces[back].position = estimator.behind(back, onWall.wall);
    front.position = onWall.distance - faces[back].position;
    for (FaceEstimate* face : {&faces[back], &front})
      face->worth = {FaceKind::Measured, surfaceSigma(estimator.range(), options)};
  }
}

}  // namespace quadmap
