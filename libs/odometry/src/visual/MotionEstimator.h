#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "Correspondences.h"
#include "RigidMotion.h"
#include "VisualImage.h"

namespace quadmap
{
/** A small piece of a surface in an image, in `optical`. */
struct SurfaceSample
{
  Eigen::Vector3d point;   // [m]
  Eigen::Vector3d normal;  // towards the camera
};

/** Samples of the surfaces in an image, about 80 x 60 where there is depth everywhere. */
std::vector<SurfaceSample> sampleSurface(const VisualImage& image);

/** The motion between two images, and how well it is known. */
struct MotionEstimate
{
  Eigen::Isometry3d T_to_from = Eigen::Isometry3d::Identity();
  Matrix6 covariance = Matrix6::Zero();  //!< Of x in exp(x) T_to_from [m], [rad]
  int found = 0;                         //!< Number of correspondences
  int inliers = 0;                       //!< Number of these that agree with the motion
  int overlap = 0;                       //!< Samples of surfaces that the second image may show
  double surfaceShare = 0;               //!< Share of these that it does show, in [0, 1]

  double inlierShare() const { return found > 0 ? static_cast<double>(inliers) / found : 0; }
  double sigmaPosition() const;  //!< In the worst direction [m]
  double sigmaAngle() const;     //!< About the worst axis [rad]
};

/** Estimates motion from correspondences and surfaces: doc/mathematics.md, section 15. */
class MotionEstimator
{
 public:
  explicit MotionEstimator(const VisualOdometryOptions& options) : options_(options) {}

  /** The motion on which most correspondences agree, roughly (P3P RANSAC). It keeps only the
   *  correspondences that agree, and returns nothing when hardly any do. The same input gives the
   *  same result. */
  std::optional<Eigen::Isometry3d> consensus(
      std::vector<Correspondence>& correspondences,
      const PinholeCamera& camera,
      int minInliers,
      int maxIterations) const;

  /** Refines a first guess by Gauss-Newton, on pixels and depths of the correspondences and on the
   *  distances between surfaces: doc/mathematics.md, (15.3) to (15.8). It returns nothing when the
   *  equations are singular. */
  std::optional<MotionEstimate> refine(
      const std::vector<Correspondence>& correspondences,
      const std::vector<SurfaceSample>& surface,
      const VisualImage& to,
      const Eigen::Isometry3d& T_to_from,
      double sigmaPixel) const;

 private:
  struct Equations;
  void addCorrespondences(
      const std::vector<Correspondence>& correspondences,
      const PinholeCamera& camera,
      const Eigen::Isometry3d& T_to_from,
      double sigmaPixel,
      Equations& equations) const;
  void addSurface(
      const std::vector<SurfaceSample>& surface,
      const VisualImage& to,
      const Eigen::Isometry3d& T_to_from,
      double gate,
      Equations& equations) const;
  double depthVariance(double z) const;  // [m^2]

  const VisualOdometryOptions& options_;
};

}  // namespace quadmap
