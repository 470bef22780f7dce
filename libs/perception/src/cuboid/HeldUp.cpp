#include "cuboid/HeldUp.h"

#include <cmath>

#include "cuboid/CuboidFit.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/geometry/Support.h"
#include "quadmap/perception/BoxEdges.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
namespace
{
/** How far an object reaches out of its box below, equation (8.12), and how well the edge of the
 * box is known there [m]. */
struct Overhang
{
  double reach = 0, sigma = 0;
};

/** The overhang of an object over the edges of its box that its bottom looks out over. */
class LowerEdges
{
 public:
  LowerEdges(
      const PinholeCamera& camera,
      const FaceEstimator& estimator,
      const Faces& faces,
      double shapeExponent,
      const PerceptionOptions& options) :
      edges_(edgesWithoutDepth(camera, estimator.box(), options)),
      estimator_(estimator),
      faces_(faces),
      shapeExponent_(shapeExponent)
  {
  }

  /** Over the edge that contradicts the object most; nothing when no edge tells of its bottom. */
  std::optional<Overhang> overhang(double bottom) const
  {
    Faces faces = faces_;
    faces[kBottom].position = bottom;
    const Ellipsoid object =
        cuboidOf(faces, estimator_.R_obj_optical()).transformed(T_sensor_optical());
    const Eigen::Matrix3d R = object.rotation();
    std::optional<Overhang> most;
    for (const EdgeMeasurement& edge : edges_)
    {
      const Plane& plane = edge.plane_sensor;
      if (edge.state != EdgeState::Usable || !looksOver(plane, -R.col(2))) continue;
      const Eigen::Vector3d n_obj = R.transpose() * plane.n;
      const double h = supportFunction<double>(n_obj, object.semiAxes(), shapeExponent_);
      const Overhang here{
          h - plane.signedDistance(object.center()), estimator_.range() * edge.sigmaAngle};
      if (!most || here.reach / here.sigma > most->reach / most->sigma) most = here;
    }
    return most;
  }

  /** The bottom with which the object ends where its box does, in its lower half. */
  std::optional<double> bottomInBox() const
  {
    constexpr int kHalvings = 20;  // of the height: to a millionth
    double low = faces_[kBottom].position, high = 0.5 * (low - faces_[kTop].position);
    if (overhang(high)->reach > 0) return {};
    for (int i = 0; i < kHalvings; ++i)
    {
      const double middle = 0.5 * (low + high);
      (overhang(middle)->reach > 0 ? low : high) = middle;
    }
    return high;
  }

 private:
  std::array<EdgeMeasurement, 4> edges_;  // their planes in the sensor's frame
  const FaceEstimator& estimator_;
  const Faces& faces_;
  double shapeExponent_;
};

}  // namespace

std::optional<FaceEstimate> heldUpBottom(
    const PinholeCamera& camera,
    const FaceEstimator& estimator,
    const Faces& standing,
    const LabelProperties& label,
    const PerceptionOptions& options)
{
  constexpr double kContradicts = 3.0;  // standard deviations
  if (standing[kBottom].worth.kind != FaceKind::Support || label.support == UsualSupport::Floor)
    return {};
  const LowerEdges edges(camera, estimator, standing, label.shapeExponent, options);
  const double support = standing[kBottom].position;
  const auto below = edges.overhang(support);
  FaceEstimate end = estimator.endInBox();
  if (!below || end.isCut) return {};  // from straight above no edge tells
  if (support - end.position >= clearOfSupport(estimator.range(), label, options))
  {
    const double disagreement = std::abs(edges.overhang(end.position)->reach);
    if (disagreement >= std::abs(below->reach)) return {};
    // What shows at the lower edge of the box may be what holds the object up.
    end.worth = {FaceKind::Measured, std::hypot(below->sigma, disagreement)};
    return end;
  }
  // The box is a rectangle, and of a screen seen at an angle it holds some of the stand as well.
  if (below->reach <= kContradicts * below->sigma) return {};
  const auto bottom = edges.bottomInBox();
  if (!bottom) return {};
  end.position = *bottom;
  end.worth = {FaceKind::Measured, below->sigma};
  return end;
}

}  // namespace quadmap
