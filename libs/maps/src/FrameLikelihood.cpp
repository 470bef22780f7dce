#include "quadmap/maps/FrameLikelihood.h"

#include <cmath>

#include "quadmap/estimation/ResidualRow.h"
#include "quadmap/geometry/RotationDistance.h"

// The likelihood of an observation: section 14 of doc/mathematics.md.
namespace quadmap
{
namespace
{
/** A chi^2 above this adds nothing to the share of the outliers: exp(-40) of it is left. */
constexpr double kNegligible = 80;

/** A bound of -1/2 chi^2 that needs no inverse: no eigenvalue of S is above its trace. */
bool isHopeless(const Eigen::Vector3d& off, const Eigen::Matrix3d& S)
{
  return off.squaredNorm() > kNegligible * S.trace();
}

}  // namespace

/** A box at a pose of the robot; all in the map. */
struct FrameLikelihood::Placed
{
  Placed(const Box& seen, const LevelPose& pose, const Eigen::Matrix3d& R) :
      box(seen),
      rotation(R),
      position(pose.position),
      center(R * seen.view.center + pose.position),
      camera(R * seen.view.camera + pose.position),
      centerCovariance(R * seen.view.centerCovariance * R.transpose()),
      yaw(seen.view.yaw + pose.yaw)
  {
  }

  Plane placed(const Plane& plane) const
  {
    const Eigen::Vector3d n = rotation * plane.n;
    return {n, plane.d - n.dot(position)};
  }

  bool isInFront(const Eigen::Vector3d& p) const
  {
    return (rotation * box.forward).dot(p - camera) > 0;
  }

  const Box& box;
  const Eigen::Matrix3d& rotation;
  const Eigen::Vector3d& position;
  Eigen::Vector3d center, camera;
  Eigen::Matrix3d centerCovariance;
  double yaw;
};

FrameLikelihood::FrameLikelihood(
    std::vector<Box> boxes,
    std::vector<Target> targets,
    std::vector<Pairing> pairings,
    const LikelihoodOptions& options) :
    boxes_(std::move(boxes)),
    targets_(std::move(targets)),
    pairings_(std::move(pairings)),
    options_(options)
{
}

/** -1/2 chi^2 of a complete measurement, (14.2): centre, and yaw where both have one. */
double FrameLikelihood::completeTerm(const Placed& box, const Target& target) const
{
  const double sigma2 = options_.positionSigma * options_.positionSigma;
  const Eigen::Matrix3d S =
      box.centerCovariance + target.covariance + sigma2 * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d off = box.center - target.object.center();
  if (isHopeless(off, S)) return -kNegligible;
  double chi2 = off.dot(S.llt().solve(off));
  const ObjectView& view = box.box.view;
  if (view.yawDefined && target.orientationDefined)
  {
    const double yaw = yawDistance(box.yaw, target.yaw);
    chi2 += yaw * yaw /
            (view.yawSigma * view.yawSigma + target.yawVariance +
             options_.yawSigma * options_.yawSigma);
  }
  return -0.5 * chi2;
}

/** -1/2 chi^2 of a partial measurement, (14.3): its box edges should touch the object in front of
 * the camera, and its seed should lie in it. Without depth there is no term of the seed. */
double FrameLikelihood::edgesTerm(const Placed& box, const Target& target) const
{
  const ObjectView& view = box.box.view;
  const Eigen::Vector3d center = target.object.center();
  double chi2 = 0;
  if (box.box.hasSeed)
  {
    const Eigen::Vector3d off = box.center - center;
    const double sigma2 = options_.positionSigma * options_.positionSigma;
    const Eigen::Matrix3d S = box.centerCovariance + sigma2 * Eigen::Matrix3d::Identity();
    if (isHopeless(off, S)) return -kNegligible;
    chi2 += off.dot(S.llt().solve(off));
  }
  else if (!box.isInFront(center))
    return -kNegligible;
  const double range = (center - box.camera).norm();
  for (const auto& edge : view.edges)
  {
    const double sigma = range * std::hypot(edge.angle, options_.angleSigma) + view.pose.position;
    const double gap =
        tangencyResidual(box.placed(edge.plane), target.object, target.shapeExponent);
    chi2 += gap * gap / (sigma * sigma);
  }
  return -0.5 * chi2;
}

double FrameLikelihood::at(const LevelPose& pose) const
{
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(pose.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const double outliers = options_.outlierShare;
  double sum = 0;
  auto pairing = pairings_.begin();
  for (std::size_t k = 0; k < boxes_.size(); ++k)
  {
    const Placed box(boxes_[k], pose, R);
    double explained = 0;
    for (; pairing != pairings_.end() && pairing->box == k; ++pairing)
    {
      const Target& target = targets_[pairing->target];
      const double term =
          boxes_[k].view.complete ? completeTerm(box, target) : edgesTerm(box, target);
      explained += pairing->agreement * std::exp(term);
    }
    sum += std::log(outliers + (1 - outliers) * std::min(explained, 1.0));  // (14.1)
  }
  return sum;
}

}  // namespace quadmap
