#include <algorithm>
#include <cmath>

#include "InsertionFrame.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/geometry/Support.h"

namespace quadmap
{
namespace
{
/** -1/2 chi^2 of a complete measurement: centre, and yaw where both have one. */
double completeTerm(
    const ObjectView& view, const MapObject& object, const LikelihoodOptions& options)
{
  const double sigma2 = options.positionSigma * options.positionSigma;
  const Eigen::Matrix3d S = view.centerCovariance + object.covariance.topLeftCorner<3, 3>() +
                            sigma2 * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d off = view.center - object.object.center();
  double chi2 = off.dot(S.llt().solve(off));
  if (view.yawDefined && object.orientationDefined)
  {
    const double yaw = yawDistance(view.yaw, uprightStateOf(object.object)[3]);
    chi2 += yaw * yaw /
            (view.yawSigma * view.yawSigma + object.covariance(3, 3) +
             options.yawSigma * options.yawSigma);
  }
  return -0.5 * chi2;
}

/** -1/2 chi^2 of a partial measurement: its box edges should touch the object, in front of the
 * camera. */
double edgesTerm(
    const ObjectView& view,
    const MapObject& object,
    double shapeExponent,
    const LikelihoodOptions& options)
{
  double chi2 = 0;
  const double range = (object.object.center() - view.camera).norm();
  for (const auto& edge : view.edges)
  {
    const double sigma = range * std::hypot(edge.angle, options.angleSigma) + view.positionSigma;
    const double gap = tangencyResidual(edge.plane, object.object, shapeExponent);
    chi2 += gap * gap / (sigma * sigma);
  }
  const Eigen::Vector3d off = view.center - object.object.center();
  const double sigma2 = options.positionSigma * options.positionSigma;
  const Eigen::Matrix3d S = view.centerCovariance + sigma2 * Eigen::Matrix3d::Identity();
  return -0.5 * (chi2 + off.dot(S.llt().solve(off)));
}

}  // namespace

bool CQuadricObjectMap::internal_canComputeObservationLikelihood(
    const mrpt::obs::CObservation& obs) const
{
  const auto* boxes = dynamic_cast<const CObservationObjects*>(&obs);
  if (!boxes) return false;
  return std::any_of(
      boxes->objects.begin(), boxes->objects.end(),
      [](const DetectedObject& d)
      {
        return d.measurement.kind == MeasurementKind::Complete ||
               d.measurement.kind == MeasurementKind::Partial;
      });
}

/** sum over boxes of log( e + (1-e) min(1, sum_i exp(term_i)) ), the inner sum over objects with
 * weighted with how far the labels agree; e is the share of boxes that show nothing of the map. */
double CQuadricObjectMap::internal_computeObservationLikelihood(
    const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& takenFrom) const
{
  const auto* boxes = dynamic_cast<const CObservationObjects*>(&obs);
  if (!boxes) return 0;
  const double outliers = likelihoodOptions.outlierShare;
  const Frame frame = frameOf(*boxes, takenFrom);

  double logLikelihood = 0;
  for (const ObjectView& view : frame.views)
  {
    double explained = 0;
    for (const auto& [id, object] : objects_)
    {
      if (likelihoodOptions.onlyConfirmed && !object.confirmed) continue;
      const double agreement = labelAgreement(object, view.label, *labels_);
      if (agreement == 0) continue;
      const double term = view.complete
                              ? completeTerm(view, object, likelihoodOptions)
                              : edgesTerm(
                                    view, object, labels_->properties(object.label()).shapeExponent,
                                    likelihoodOptions);
      explained += agreement * std::exp(term);
    }
    logLikelihood += std::log(outliers + (1 - outliers) * std::min(explained, 1.0));
  }
  return logLikelihood;
}

}  // namespace quadmap
