#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/quadric/BoxView.h"
#include "quadmap/quadric/QuadricEstimate.h"

namespace quadmap
{
/** One thing that boxes show. */
struct QuadricObject
{
  MapObject record;  //!< Its id, labels and counts; the ellipsoid may be tilted
  QuadricCovariance covariance = QuadricCovariance::Identity();
  std::vector<BoxView> views;
  std::optional<std::uint32_t> instance;  //!< When instance ids are believed
  /** A track: there are too few views, or from too few directions, to know its distance from
   * anything but the label's usual size. */
  bool waits = true;
  bool settled = false;       //!< Estimated together with the poses: views do not change it
  std::size_t estimated = 0;  //!< Views behind the last estimate
};

/** The objects that the boxes of some keyframes show, without depth.
 *
 * A box that belongs to nothing starts a track: an ellipsoid of the label's usual size where it
 * fills the box, with a covariance that is long along the ray. Boxes of later keyframes are
 * compared with objects and tracks alike, by how far their edges are from touching; the covariance
 * makes this the epipolar band for a track, and the posterior of the Dirichlet process decides
 * (doc/mathematics.md). When a track was seen from directions different enough it becomes an
 * object: the best that the linear solution, a sphere at the triangulated centre and the track's
 * own ellipsoid lead to. */
class QuadricObjects
{
 public:
  /** Where each keyframe is. */
  using PoseOf = std::function<mrpt::poses::CPose3D(std::size_t)>;
  using Decision = CQuadricObjectMap::Decision;

  /** \param labels Must outlive it. */
  QuadricObjects(const InsertionOptions& options, const LabelTable& labels);

  /** Joins the boxes of the next keyframe with the objects.
   * \param poseCovariance Of that keyframe's pose, of steps (GraphState.h).
   * \return A decision per view; nothing for one that waits. */
  std::vector<Decision> add(
      const std::vector<BoxView>& views,
      mrpt::Clock::time_point time,
      const Eigen::Matrix<double, 6, 6>& poseCovariance,
      const PoseOf& poseOf);

  /** Makes one of objects that overlap and were never seen side by side.
   * \return The ids that were kept and absorbed. */
  std::vector<std::pair<ObjectId, ObjectId>> mergeOverlapping(const PoseOf& poseOf);

  /** Forgets views and tracks, but what they said of the objects: for another round. */
  void beginRound();
  /** Drops what no longer has the views to be an object. */
  void endRound();
  /** What an estimation together with the poses found out. */
  void settle(ObjectId id, const Ellipsoid& object, const QuadricCovariance& covariance);

  using All = std::map<ObjectId, QuadricObject>;
  const All& all() const { return objects_; }  //!< Tracks too

  /** The finished object in the form of the object map, upright. */
  MapObject finished(const QuadricObject& object, const PoseOf& poseOf) const;

 private:
  Eigen::MatrixXd likelihoods(
      const std::vector<BoxView>& views,
      const Eigen::Matrix<double, 6, 6>& poseCovariance,
      const PoseOf& poseOf) const;
  void addView(QuadricObject& object, const BoxView& view, mrpt::Clock::time_point time);
  ObjectId startTrack(const BoxView& view, mrpt::Clock::time_point time, const PoseOf& poseOf);
  void estimate(QuadricObject& object, const PoseOf& poseOf);
  /** \return True when the track became an object. */
  bool promote(QuadricObject& track, const PoseOf& poseOf);
  void forgetOldTracks();

  const InsertionOptions options_;
  const LabelTable& labels_;
  All objects_;
  ObjectId nextId_ = 1;
};

}  // namespace quadmap
