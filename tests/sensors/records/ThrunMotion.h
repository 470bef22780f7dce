#pragma once

#include <mrpt/obs/CActionRobotMovement2D.h>

namespace quadmap
{
/** Odometry with the noise of Thrun's model, of which a file states this number of particles. */
inline mrpt::obs::CActionRobotMovement2D thrunMotion(unsigned particles)
{
  using mrpt::obs::CActionRobotMovement2D;
  CActionRobotMovement2D::TMotionModelOptions thrun;
  thrun.modelSelection = CActionRobotMovement2D::mmThrun;
  thrun.thrunModel.nParticlesCount = particles;
  CActionRobotMovement2D move;
  move.computeFromOdometry({0.1, 0.2, 0.3}, thrun);
  return move;
}
}  // namespace quadmap
