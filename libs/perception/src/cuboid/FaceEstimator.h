#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cloud/ObjectCloud.h"
#include "cloud/Precision.h"
#include "cuboid/UprightCloud.h"
#include "quadmap/obs/ObjectMeasurement.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** What a face's position was taken from. */
enum class FaceSource
{
  Surface,  //!< Points of the face itself
  Outline,  //!< Where the visible points end in the image
  FarEdge   //!< An outline of which the face itself is on the far side
};

/** Where one face of the cuboid is, and why. */
struct FaceEstimate
{
  double position = 0;  //!< Along the outward normal, from the camera [m]
  FaceMeasurement worth;
  FaceSource source = FaceSource::Outline;
  bool isCut = false;  //!< Its outline ends at something nearer or at the image's border
  double shift = 0;    //!< Of the points used from the camera, along the face (horizontally) [m]
};

/** How far the points of a front reach towards its back. */
struct FrontReach
{
  double position = 0;         //!< Along the back's outward normal, from the camera [m]
  std::optional<double> lean;  //!< Of the front from the vertical; nothing for an upright one [rad]
};

/** Faces in the order +x, -x, +y, -y, +z, -z. */
using Faces = std::array<FaceEstimate, kFaces>;
constexpr std::size_t kTop = 4, kBottom = 5;

/** Looks at an object's cloud along the axes of its cuboid (doc/mathematics.md, "Faces"). */
class FaceEstimator
{
 public:
  /** \param yaw Of the cuboid in the frame `upright`. All references must outlive the estimator. */
  FaceEstimator(
      const DepthCloud& cloud,
      const ScenePlanes& planes,
      const ObjectCloud& object,
      const UprightCloud& upright,
      double yaw,
      const PerceptionOptions& options);

  const Eigen::Matrix3d& R_obj_optical() const { return R_obj_optical_; }
  double range() const { return range_; }

  /** Cosine between a face's outward normal and the line of sight: > 0 faces away. */
  double facingAway(std::size_t face) const;

  Eigen::Vector3d normalOf(std::size_t face) const;  //!< Outward, in the object's frame

  /** Where the line through the middle of what is seen, along a face's outward normal, meets a
   * plane, as a coordinate along this normal [m]. */
  double behind(std::size_t face, const Plane& plane) const;

  double lowestSeen() const;  //!< Along the object's z, from the camera [m]

  /** Does little of what the box shows below the visible part stand in front of the object? Then
   * its foot is not hidden, but black or thin. */
  bool isFootInSight() const;

  /** How far before the object is what hides its lower end, horizontally [m]? Nothing when most of
   * that end is not hidden by anything nearer. */
  std::optional<double> distanceOfWhatHidesFoot() const;

  FaceEstimate face(std::size_t face) const;

  /** The lower end of the object by its cloud within the detector's box; its sigma is left open. */
  FaceEstimate endInBox() const;

  /** Share of the lines down through the object that go on beyond a position along -z [m]. */
  double shareOfLinesBelow(double position) const;

  /** How far most of the points reach when they are the front's alone, as of a screen. The others
   * are the rim's way to what is behind, and tell nothing of a back that nobody saw. Nothing when
   * something of the object lies behind the front. */
  std::optional<FrontReach> reachOfFront(std::size_t back) const;

  const ImageBox& box() const { return object_.box; }  //!< Of the detector [px]

  /** The near side of something round with this radius [m]: each point knows by its normal how far
   * it is from the outermost one. Nothing when too few points look at the camera. */
  std::optional<FaceEstimate> nearSideOfRound(std::size_t face, double radius) const;

  double cell() const { return cloud_.stride() * range_ / std::abs(cloud_.camera().fx); }  //!< [m]

 private:
  /** The object's cells on one line of the image that runs along the outward normal. */
  struct Line
  {
    std::size_t last = 0;  // index of the outermost point
    double along = 0;      // of that point [m]
  };
  struct Outline
  {
    std::vector<Line> lines;   // the outermost first
    double metresPerCell = 0;  // along the outward normal
  };

  /** Coordinate of a point, cosine of its normal, along a face's outward normal. */
  double along(std::size_t face, std::size_t point) const
  {
    return face % 2 == 0 ? points_[face / 2][point] : -points_[face / 2][point];
  }
  double cosine(std::size_t face, std::size_t point) const
  {
    return face % 2 == 0 ? normals_[face / 2][point] : -normals_[face / 2][point];
  }
  /** What all but the stray points lie within, along a face's outward normal [m]. */
  double extreme(std::size_t face) const { return extremes_[face]; }
  /** The coordinates along a face, horizontally (along the top: to the front). */
  const std::vector<double>& acrossOf(std::size_t face) const { return points_[face < 2 ? 1 : 0]; }
  std::size_t size() const { return cells_.size(); }
  /** The step kEndSlack along a face's outward normal, in the optical frame [m]. */
  Eigen::Vector3d stepTowards(std::size_t face) const
  {
    return kEndSlack * R_obj_optical_.transpose() * normalOf(face);
  }
  Outline outlineTowards(std::size_t face) const;
  bool endsOutsideBox(std::size_t face) const;
  double outlineSigmaOf(std::size_t face, double perCell) const;
  double noiseAt(std::size_t face, double position, std::size_t n) const;
  double cutShare(const Outline& outline, std::size_t face, double from) const;
  std::optional<FaceEstimate> surface(std::size_t face) const;
  double shellDepth() const;
  /** The plane of a side that leans. */
  struct LeaningSide
  {
    double angle = 0;   //!< From the vertical, positive where its top leans out [rad]
    double slope = 0;   //!< Tangent of the angle
    double offset = 0;  //!< Along the outward normal, at the height of the camera [m]

    double at(double height) const { return offset + slope * height; }
  };
  std::optional<LeaningSide> leaningSide(std::size_t face) const;  //!< Nothing when it is upright
  void reachOfLeaning(std::size_t face, FaceEstimate& side) const;
  void raiseTop(std::vector<double> shell, FaceEstimate& top) const;
  FaceEstimate outline(std::size_t face, const Outline& lines) const;
  bool leadsUp(std::size_t face, double position) const;
  bool isOnSupport(const Eigen::Vector3d& p, double tolerance) const;
  /** What the image shows next to the object. */
  struct Beyond
  {
    enum Kind
    {
      Background,
      Nearer,  // or at the object's depth
      Border
    } kind;
    Eigen::Vector3d point;  // of it, optical frame [m]
  };
  static DepthCloud::CellRange measuredPart(const DepthCloud& cloud);
  Beyond beyond(const ObjectCloud::Cell& cell, const Eigen::Vector3d& ahead_optical) const;
  /** Does the object go on beyond a cell at its rim: at the image border, behind something nearer,
   * or on a surface that the box or the cluster cut off? \param ahead_optical Where it would go. */
  bool isCut(const ObjectCloud::Cell& cell, const Eigen::Vector3d& ahead_optical) const
  {
    return beyond(cell, ahead_optical).kind != Beyond::Background;
  }

  const DepthCloud& cloud_;
  const ScenePlanes& planes_;
  const ObjectCloud& object_;
  const PerceptionOptions& options_;
  const DepthCloud::CellRange measured_;  // part of the image
  double range_;
  Eigen::Matrix3d R_obj_optical_;
  Eigen::Vector3d centroid_ = Eigen::Vector3d::Zero();
  const std::vector<ObjectCloud::Cell>& cells_;
  /** Of each axis of the cuboid the coordinates along it; normals are 0 where there are none. */
  std::array<std::vector<double>, 3> points_, normals_;
  std::array<double, kFaces> extremes_;
};

}  // namespace quadmap
