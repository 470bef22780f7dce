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
/** A piece of surface of an image, optical frame. */
struct SurfaceSample
{
  Eigen::Vector3d point;   // [m]
  Eigen::Vector3d normal;  // towards the camera
};

/** Surface all over the image, about 80x60 samples where there is depth. */
std::vector<SurfaceSample> sampleSurface(const VisualImage& image);

/** How two images lie to each other, and how well that is known. */
struct MotionEstimate
{
  Eigen::Isometry3d T_to_from = Eigen::Isometry3d::Identity();
  Matrix6 covariance = Matrix6::Zero();  //!< Of x in exp(x) T_to_from: [m], [rad]
  int found = 0;                         //!< Correspondences
  int inliers = 0;                       //!< ... that agree with the motion
  int overlap = 0;                       //!< Surface samples that the second image may see
  double surfaceShare = 0;               //!< ... the share of them that it does see

  double inlierShare() const { return found > 0 ? static_cast<double>(inliers) / found : 0; }
  double sigmaPosition() const;  //!< In the worst direction [m]
  double sigmaAngle() const;     //!< About the worst axis [rad]
};

/** From correspondences and surfaces to motion. */
class MotionEstimator
{
 public:
  explicit MotionEstimator(const VisualOdometryOptions& options) : options_(options) {}

  /** The motion most correspondences agree on (P3P RANSAC), rough; keeps only those that do.
   *  Nothing when hardly any do. The same input gives the same result. */
  std::optional<Eigen::Isometry3d> consensus(
      std::vector<Correspondence>& correspondences,
      const PinholeCamera& camera,
      int minInliers,
      int maxIterations) const;

  /** Gauss-Newton on pixels and depth of the correspondences and on the distances between the
   *  surfaces, from a first guess. Nothing when the equations are singular. */
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
