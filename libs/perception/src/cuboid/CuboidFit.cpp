#include "cuboid/CuboidFit.h"

#include <algorithm>
#include <cmath>

#include "cloud/Precision.h"
#include "cuboid/FaceEstimator.h"
#include "cuboid/FaceSigmas.h"
#include "cuboid/HeadingEstimate.h"
#include "cuboid/HeldUp.h"
#include "cuboid/OnWall.h"
#include "cuboid/TopRim.h"
#include "cuboid/UnseenBack.h"
#include "quadmap/surfaces/SurfaceTolerance.h"
#include "support/UnseenFoot.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kSides = 4;

/** Completes the faces of a round thing (cup, ball). Its near side and its width are seen, and it
 * is as deep as it is wide. */
void completeRound(Faces& faces, const FaceEstimator& estimator)
{
  if (faces[2].worth.kind != FaceKind::Measured || faces[3].worth.kind != FaceKind::Measured)
    return;
  for (std::size_t side : {2, 3}) faces[side].position += roundShift(estimator.cell());
  const double radius = 0.5 * (faces[2].position + faces[3].position);
  for (std::size_t side : {2, 3})
    faces[side].worth.sigma = roundOutlineSigma(radius, faces[side].worth.sigma);
  if (const auto near = estimator.nearSideOfRound(1, radius); near) faces[1] = *near;
  FaceEstimate& far = faces[0];
  const double near = -faces[1].position;
  if (near + 2.0 * radius < far.position) return;  // deeper than wide: keep what was seen
  far.position = near + 2.0 * radius;
  far.worth = {FaceKind::Measured, roundFarSigma(radius, faces[1].worth.sigma)};
}

/** Decides where a lower part of the object may reach that is out of sight. The near sides say "at
 * least" when something hides that part, as a table hides a chair: the object may come nearer
 * below. It then reaches to what hides it, and ends on the far side where its top does. All sides
 * say "at least" when the foot is in sight but returns no depth, unless the object is round: plants
 * are wider above. */
void placeHiddenPart(Faces& faces, const FaceEstimator& estimator, const LabelProperties& label)
{
  constexpr double kMinHidden = 0.06;  // [m]; points near the support count as the support's
  const double top = faces[kTop].position;
  const double bottom = faces[kBottom].worth.kind == FaceKind::Support
                            ? -faces[kBottom].position
                            : top - label.typicalSize.z();
  if (estimator.lowestSeen() - bottom < std::max(kMinHidden, kOpenShare * (top - bottom))) return;
  const bool isOpen = label.dominantDirection && estimator.isFootInSight();
  const auto before = estimator.distanceOfWhatHidesFoot();
  const bool isTucked = before && *before < label.typicalSize.head<2>().minCoeff();
  for (std::size_t side = 0; side < kSides; ++side)
  {
    auto& worth = faces[side].worth;
    const double away = estimator.facingAway(side);
    if (isTucked && faces[side].source == FaceSource::FarEdge && !faces[side].isCut)
      worth.kind = FaceKind::Measured;
    else if ((isOpen || away < -kTurnedAway) && worth.kind == FaceKind::Measured)
      worth.kind = FaceKind::AtLeast;
    worth.sigma += kEndWidth;
  }
}

/** Spreads of its kind by which what is seen of an object is lower than usual. */
double spreadsTooLow(
    const Faces& faces, const FaceEstimator& estimator, const LabelProperties& label)
{
  const double seen = faces[kTop].position - estimator.lowestSeen();
  return label.spreadsBetween(std::max(seen, kMinHalfSize), label.typicalSize.z());
}

/** The heading by the sides of the object, or by the rim of its top where that tells it better. */
HeadingEstimate headingOf(
    const UprightCloud& upright, const std::optional<TopRim>& rim, const PerceptionOptions& options)
{
  HeadingEstimate bySides = estimateHeading(upright, options);
  const auto byRim = rim ? rim->heading() : std::nullopt;
  if (byRim && (!bySides.defined || byRim->sigma < bySides.sigma)) return *byRim;
  return bySides;
}

/** An object with a level top ends where its top does. What is below may be hidden or return no
 * depth (the legs of a table): it is within. */
void endAtRim(
    const TopRim& rim,
    double yaw,
    const FaceEstimator& estimator,
    const PerceptionOptions& options,
    Faces& faces)
{
  const Eigen::Vector2d x(std::cos(yaw), std::sin(yaw)), y(-x.y(), x.x());
  const std::array<Eigen::Vector2d, kSides> normals = {x, -x, y, -y};
  for (std::size_t side = 0; side < kSides; ++side)
  {
    FaceEstimate& face = faces[side];
    if (const auto end = rim.side(normals[side]))
    {
      face.position = end->position;
      // Across from the camera, in the frame of the cuboid: y of +-x faces, x of +-y faces.
      face.shift = normals[side].dot(side < 2 ? x : y) * (side < 2 ? 1 : -1) * end->shift;
      face.worth = {FaceKind::Measured, outlineSigma(end->perCell, estimator.range(), options)};
    }
    else if (estimator.facingAway(side) > -kTurnedAway && face.worth.kind == FaceKind::Measured)
      face.worth.kind = FaceKind::AtLeast;
  }
}

/** The rim of a thing that rises little above the noise of its support is taken for the support:
 * the sides lie outside of what is left. The edges of the box tell where. */
void openThinSides(double clear, Faces& faces)
{
  const double height = faces[kTop].position + faces[kBottom].position;
  if (height > clear) return;
  for (std::size_t side = 0; side < kSides; ++side)
    if (faces[side].source != FaceSource::Surface && faces[side].worth.kind == FaceKind::Measured)
      faces[side].worth.kind = FaceKind::AtLeast;
}

/** Adds the share of the heading to the sigma of each side, equation (8.11). A wrong heading turns
 * a face about the middle of the cuboid, and the part of the face that was seen moves by the lever.
 * Without a heading the corners that make the outline move, too. */
void addHeadingSigma(Faces& faces, const HeadingEstimate& yaw)
{
  constexpr double kUnknownSigma = 0.045;  // of the smallest rectangle's heading [rad]
  const double middle[2] = {
      0.5 * (faces[0].position - faces[1].position), 0.5 * (faces[2].position - faces[3].position)};
  const double half[2] = {
      0.5 * (faces[0].position + faces[1].position), 0.5 * (faces[2].position + faces[3].position)};
  for (std::size_t side = 0; side < kSides; ++side)
  {
    const std::size_t across = side < 2 ? 1 : 0;
    double lever = faces[side].shift - middle[across];
    if (!yaw.defined) lever = std::hypot(lever, half[across]);
    faces[side].worth.sigma =
        std::hypot(faces[side].worth.sigma, lever * (yaw.defined ? yaw.sigma : kUnknownSigma));
  }
}

/** A top that slopes, as one does whose up is wrong by the pose's error, counts in its middle. */
void setTopInTheMiddle(const Eigen::Matrix3d& R_obj_optical, const Plane& top, Faces& faces)
{
  const Eigen::Vector3d n = R_obj_optical * top.n;
  const double x = 0.5 * (faces[0].position - faces[1].position);
  const double y = 0.5 * (faces[2].position - faces[3].position);
  faces[kTop].position = -(n.x() * x + n.y() * y + top.d) / n.z();
}

/** Fits cuboids to clouds of one frame. */
class CuboidFitter
{
 public:
  CuboidFitter(
      const DepthCloud& cloud,
      const ScenePlanes& planes,
      const LabelProperties& label,
      const PerceptionOptions& options) :
      cloud_(cloud), planes_(planes), label_(label), options_(options)
  {
  }

  /** \param heldUp The bottom, when the object is a part that something else holds up. */
  CompleteMeasurement fit(const ObjectCloud& object, const std::optional<double>& heldUp) const
  {
    const Eigen::Vector3d up = object.support ? planes_.plane(*object.support).plane.n : planes_.up;
    const UprightCloud upright = uprightCloud(cloud_, object, up);
    std::optional<TopRim> rim;
    if (object.top && label_.dominantDirection)
      rim.emplace(cloud_, object, *object.top, upright.R_upright_optical, options_);
    HeadingEstimate yaw;
    if (label_.dominantDirection) yaw = headingOf(upright, rim, options_);

    const FaceEstimator estimator(cloud_, planes_, object, upright, yaw.yaw, options_);
    const HeldUp hold(cloud_.camera(), estimator, label_, options_);
    Faces faces = facesAsSeen(estimator, object);
    if (heldUp)
      faces[kBottom] = hold.bottomAt(*heldUp, faces);
    else if (const auto bottom = hold.bottomOf(faces))
    {
      // What is below is the stand's, and would tell of the object's sides. When it is most of what
      // is there, the box was not drawn around what it holds.
      const ObjectCloud part = partAbove(*bottom, up, object);
      if (2 * part.points.size() > object.points.size()) return fit(part, bottom);
    }
    complete(estimator, object, rim, yaw, faces);

    CompleteMeasurement out;
    out.object_sensor = cuboidOf(faces, estimator.R_obj_optical());
    for (std::size_t face = 0; face < kFaces; ++face) out.faces[face] = faces[face].worth;
    out.yawDefined = yaw.defined;
    out.yawSigma = yaw.sigma;
    out.yawDominance = yaw.dominance;
    return out;
  }

 private:
  /** The faces as the cloud shows them, the support and the level top where there are. */
  Faces facesAsSeen(const FaceEstimator& estimator, const ObjectCloud& object) const
  {
    Faces faces;
    const auto isKnown = [&](std::size_t face)
    { return face == kBottom ? object.support.has_value() : face == kTop && object.top; };
    for (std::size_t face = 0; face < kFaces; ++face)
      if (!isKnown(face)) faces[face] = estimator.face(face);
    // Things stand on something. A lower end that is not the support's is where the view of it
    // ends.
    if (!object.support && label_.support != UsualSupport::Wall &&
        faces[kBottom].worth.kind == FaceKind::Measured)
      faces[kBottom].worth.kind = FaceKind::AtLeast;
    if (object.top)
    {
      faces[kTop].position = estimator.behind(kTop, *object.top);
      faces[kTop].worth = {FaceKind::Measured, horizontalTopSigma(estimator.range(), options_)};
    }
    if (object.support)
    {
      // Distance of the supporting plane below the camera, along the object's -z.
      faces[kBottom].position = planes_.plane(*object.support).plane.d;
      faces[kBottom].worth = {FaceKind::Support, supportSigma(estimator.range(), options_)};
    }
    return faces;
  }

  /** Decides what the parts of the object that are not seen leave of its faces, by its kind and by
   * what is around it. */
  void complete(
      const FaceEstimator& estimator,
      const ObjectCloud& object,
      const std::optional<TopRim>& rim,
      const HeadingEstimate& yaw,
      Faces& faces) const
  {
    const bool stands = faces[kBottom].worth.kind == FaceKind::Support;
    if (stands || isFootOutOfSight(object, label_, spreadsTooLow(faces, estimator, label_)))
      placeHiddenPart(faces, estimator, label_);
    if (stands) openThinSides(clearOfSupport(estimator.range(), label_, options_), faces);
    openUnseenBacks(estimator, label_, faces);
    if (rim) endAtRim(*rim, yaw.yaw, estimator, options_, faces);
    if (object.onWall) endAtWall(*object.onWall, estimator, options_, faces);
    if (label_.dominantDirection)
      addHeadingSigma(faces, yaw);
    else
      completeRound(faces, estimator);
    if (object.top) setTopInTheMiddle(estimator.R_obj_optical(), *object.top, faces);
  }

  const DepthCloud& cloud_;
  const ScenePlanes& planes_;
  const LabelProperties& label_;
  const PerceptionOptions& options_;
};

}  // namespace

Ellipsoid cuboidOf(const Faces& faces, const Eigen::Matrix3d& R_obj_optical)
{
  Eigen::Vector3d center_obj, semiAxes;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto positive = static_cast<std::size_t>(2 * axis);
    const double high = faces[positive].position, low = -faces[positive + 1].position;
    center_obj[axis] = 0.5 * (high + low);
    semiAxes[axis] = std::max(kMinHalfSize, 0.5 * (high - low));
  }
  const Eigen::Vector3d center = R_obj_optical.transpose() * center_obj;
  return Ellipsoid(
      mrpt::poses::CPose3D::FromRotationAndTranslation(
          mrpt::math::CMatrixDouble33(R_obj_optical.transpose()),
          mrpt::math::TPoint3D(center.x(), center.y(), center.z())),
      semiAxes);
}

CompleteMeasurement fitCuboid(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectCloud& object,
    const LabelProperties& label,
    const PerceptionOptions& options)
{
  return CuboidFitter(cloud, planes, label, options).fit(object, {});
}

}  // namespace quadmap
