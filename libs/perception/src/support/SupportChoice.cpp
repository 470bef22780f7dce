#include "support/SupportChoice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/surfaces/SurfaceTolerance.h"
#include "quadmap/surfaces/WallDistance.h"
#include "support/SupportEvidence.h"
#include "support/SupportRing.h"

namespace quadmap
{
namespace
{
// Evidence is added up in natural logarithms of odds. Each kind is bounded, so that no single one
// decides against all others, and is weak or strong (what lies below a surface is twice as strong):
// finer weights decide no better.
constexpr double kWeak = 1.5;
constexpr double kStrong = 4.0;

/** The log-odds that the height of an object above a surface adds, equation (6.2); <= 0.
 * \param height Of the object's top above the surface [m]. \param tooLow What too low a top takes
 * away at most. */
double heightPenalty(double height, const LabelProperties& label, double tooLow)
{
  constexpr double kMinSpread = 0.3;
  // Of a top that is not above the surface it is -infinity: as much too low as can be.
  const double ratio = std::log(std::max(0.0, height) / label.typicalSize.z());
  const double deviation = ratio / std::max(kMinSpread, label.sizeSpread);
  return -(ratio > 0 ? kWeak : tooLow) * std::min(1.0, 0.25 * deviation * deviation);
}

/** The detections whose tops are planes of the scene, by the index of the plane. */
using Tops = std::map<int, const DetectedObject*>;

/** Decides for one box at a time. */
class SupportJudge
{
 public:
  SupportJudge(
      const DepthCloud& cloud,
      const ScenePlanes& planes,
      const Tops& tops,
      const DetectedObject& detection,
      const LabelProperties& label,
      const RoughObject& object,
      const PerceptionOptions& options) :
      cloud_(cloud),
      planes_(planes),
      tops_(tops),
      detection_(detection),
      label_(label),
      object_(object),
      options_(options),
      ring_(ringAround(cloud, planes.up, detection.box, options))
  {
  }

  BoxSupport decide() const
  {
    BoxSupport out;
    double best = kWeak;  // a support must be likelier than something out of sight
    for (const int i : planes_.horizontal)
    {
      if (ownerOf(i) == &detection_) continue;
      const double score = object_.empty() ? flatScore(i) : standingScore(i);
      if (score <= best) continue;
      best = score;
      out.plane = i;
    }
    if (!out.plane && label_.support == UsualSupport::Floor && !isBelowFloor() && !isAboveFloor())
      out.plane = planes_.floor;
    for (const int i : planes_.vertical)
      if (const double score = hangingScore(i); score > best)
      {
        best = score;
        out.wall = i;
      }
    if (out.wall) out.plane.reset();
    return out;
  }

 private:
  /** The detection whose object has this plane as its top; null when no box has. */
  const DetectedObject* ownerOf(int i) const
  {
    const auto top = tops_.find(i);
    return top == tops_.end() ? nullptr : top->second;
  }

  /** Is the object under the floor of the frame, as what one sees down a flight of stairs? */
  bool isBelowFloor() const
  {
    if (!planes_.floor || object_.empty()) return false;
    const auto& middle = object_.points[object_.points.size() / 2];
    return planes_.plane(*planes_.floor).plane.signedDistance(middle) < 0;
  }

  /** Does the object end far above the floor of the frame, as a cupboard on a wall? */
  bool isAboveFloor() const
  {
    return planes_.floor && !object_.empty() && evidenceOn(*planes_.floor).endsAbove();
  }

  double usual(int i) const
  {
    return label_.support == UsualSupport::Floor && planes_.isFloor(i) ? kStrong : 0.0;
  }

  /** A low top may be hidden or cut off. But the back of a chair rises a little above the table
   * that the chair was pushed under. */
  double tooLow(int i) const
  {
    return label_.support == UsualSupport::Floor && !planes_.isFloor(i) ? kStrong : 0.0;
  }

  StandingEvidence evidenceOn(int i) const
  {
    const ScenePlane& plane = planes_.plane(i);
    SupportSurface surface = {plane.plane, plane.extent};
    if (const auto* owner = ownerOf(i)) surface.box = owner->box;
    return standingEvidence(cloud_, surface, object_, detection_.box, options_);
  }

  /** The log-odds that the object stands on a horizontal plane, equation (6.1). */
  double standingScore(int i) const
  {
    const auto e = evidenceOn(i);
    if (e.endsAbove()) return -std::numeric_limits<double>::infinity();
    constexpr double kGapScale = 0.10;  // [m]
    // Where there is a gap, something nearer may carry the object.
    return kStrong * (e.covered - 2 * e.below) - kWeak * (1 - std::exp(-e.gap / kGapScale)) -
           kStrong * e.absent * std::min(1.0, e.gap / kGapScale) +
           kWeak * touching(planes_.plane(i).plane) + usual(i) +
           heightPenalty(e.top, label_, tooLow(i));
  }

  /** The log-odds that an object lies on a plane so flat that its points are the plane's. */
  double flatScore(int i) const
  {
    return (kStrong + kWeak) * touching(planes_.plane(i).plane) + usual(i);
  }

  double touching(const Plane& plane) const { return shareOn(ring_, plane, Ring::LowerHalf); }

  /** The log-odds that the object hangs on a wall, equation (6.3). */
  double hangingScore(int i) const
  {
    if (label_.support == UsualSupport::Floor) return 0;
    const Plane& wall = planes_.plane(i).plane;
    if (!object_.empty())
    {
      std::vector<double> distances;
      for (const auto& p : object_.points) distances.push_back(wall.signedDistance(p));
      const double distance = median(std::move(distances));
      if (!mayHangOnWall(distance)) return 0;
    }
    return kStrong * shareOn(ring_, wall, Ring::All);
  }

  const DepthCloud& cloud_;
  const ScenePlanes& planes_;
  const Tops& tops_;
  const DetectedObject& detection_;
  const LabelProperties& label_;
  const RoughObject& object_;
  const PerceptionOptions& options_;
  std::vector<RingPoint> ring_;
};

/** Does the lower end of a box lie within another one? */
bool endsWithin(
    const PinholeCamera& camera,
    const Eigen::Vector3d& up,
    const ImageBox& upper,
    const ImageBox& lower)
{
  const Eigen::Vector2d down = downInImage(camera, up, upper);
  const double x = upper.centerX() + 0.5 * down.x() * upper.width();
  const double y = upper.centerY() + 0.5 * down.y() * upper.height();
  return x > lower.x1 && x < lower.x2 && y > lower.y1 && y < lower.y2;
}

/** Adds to the planes the small horizontal tops of objects that other boxes end on. */
Tops addTops(
    const DepthCloud& cloud,
    const std::vector<DetectedObject>& boxes,
    const std::vector<std::optional<RoughObject>>& objects,
    ScenePlanes& planes,
    const PerceptionOptions& options)
{
  Tops tops;
  for (std::size_t lower = 0; lower < boxes.size(); ++lower)
  {
    if (!objects[lower]) continue;
    bool carries = false;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      carries = carries || (i != lower && objects[i] &&
                            endsWithin(cloud.camera(), planes.up, boxes[i].box, boxes[lower].box));
    if (!carries) continue;
    auto top = topOf(cloud, planes, *objects[lower], boxes[lower].box, options);
    if (!top) continue;
    const int index = static_cast<int>(planes.all.planes.size());
    tops[index] = &boxes[lower];
    planes.horizontal.push_back(index);
    planes.all.planes.push_back(std::move(*top));
  }
  return tops;
}

/** A surface that lies mostly in a detector's box belongs to a thing, as the top of a bed does. */
void markFurniture(const std::vector<std::optional<RoughObject>>& objects, ScenePlanes& planes)
{
  for (const auto& object : objects)
  {
    if (!object) continue;
    for (std::size_t i = 0; i < object->planeShares.size(); ++i)
      if (object->owns(static_cast<int>(i))) planes.all.planes[i].isFurniture = true;
  }
}

}  // namespace

SupportedScene chooseSupports(
    const DepthCloud& cloud,
    ScenePlanes planes,
    const std::vector<DetectedObject>& boxes,
    const LabelTable& labels,
    const PerceptionOptions& options)
{
  std::vector<std::optional<RoughObject>> objects;
  std::vector<LabelProperties> properties;
  for (const auto& detection : boxes)
  {
    properties.push_back(labels.properties(detection.label));
    const bool inImage =
        detection.box.isValid() &&
        detection.box.clipped(cloud.camera().width, cloud.camera().height).isValid();
    objects.emplace_back();
    if (inImage) objects.back() = roughObject(cloud, planes, detection, properties.back(), options);
  }
  markFurniture(objects, planes);
  const auto tops = addTops(cloud, boxes, objects, planes, options);
  std::vector<BoxSupport> supports;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    supports.push_back(
        objects[i]
            ? SupportJudge(cloud, planes, tops, boxes[i], properties[i], *objects[i], options)
                  .decide()
            : BoxSupport());
  return {std::move(planes), std::move(supports)};
}

}  // namespace quadmap
