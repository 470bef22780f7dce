#pragma once

#include <Eigen/Dense>
#include <map>
#include <optional>
#include <vector>

#include "quadmap/maps/Association.h"
#include "quadmap/slam/points/Constellation.h"
#include "quadmap/slam/points/PointFilter.h"
#include "quadmap/slam/points/PointGraph.h"
#include "quadmap/slam/points/PointOptions.h"
#include "quadmap/slam/points/PointTypes.h"
#include "quadmap/slam/points/PointView.h"

namespace quadmap
{
/** What PointSlam found out. */
template <int D>
struct PointResult
{
  std::vector<PointPose<D>> poses;
  std::vector<PointObject<D>> objects;
  std::vector<std::vector<PointDecision>> decisions;  //!< By pose and measurement
  int rounds = 0;                                     //!< Of finish()
  double lastMove = 0;                                //!< Of any pose in the last one [m]
  bool converged = false;
};

/** Takes positions of things a robot saw for objects, without being told which is which, and
 * corrects the robot's trajectory by them: a nonparametric pose graph (Mu et al., IROS 2016; see
 * doc/mathematics.md, "Points"), in the plane (D = 2) or in space (D = 3).
 *
 * addFrame() works online: a measurement joins an object when it is clear which, given how unsure
 * the robot is of where it stands; else it starts one of its own. Objects mapped twice because of
 * drift become one when a constellation of them fits. finish() estimates everything anew, in turn
 * with the associations. Single-threaded and deterministic. */
template <int D>
class PointSlam
{
 public:
  /** \param posesGiven Poses are exactly where the odometry says.
   *  \param visible When not given, the measurements show where the sensor looks, and how often it
   *  sees what is there.
   *  \param detectionProbability Of a `visible` object, per frame, in (0, 1). */
  explicit PointSlam(
      const PointOptions& options,
      bool posesGiven = false,
      PointVisibility<D> visible = {},
      double detectionProbability = 0.7);

  /** \param step Motion since the frame before; of the first frame it is not looked at: its pose is
   *  `origin`. */
  void addFrame(
      const PointOdometry<D>& step,
      const std::vector<PointMeasurement<D>>& measurements,
      const PointPose<D>& origin = {});

  /** After the last frame. */
  void finish();

  /** Objects with the evidence so far, those in doubt included. */
  PointResult<D> result() const;
  const PointPose<D>& pose() const { return filter_.pose(); }  //!< Of the last frame

 private:
  struct Frame
  {
    std::vector<PointMeasurement<D>> measurements;
    std::vector<PointDecision> decisions;  //!< Objects are indices of tracks_
  };
  /** What may be an object. */
  struct Track
  {
    PointObject<D> object;
    std::size_t lastFrame = 0;
    bool alive = true;  //!< Neither merged nor given up
  };
  using Ids = std::vector<std::size_t>;
  using Innovations = std::vector<std::vector<PointInnovation<D>>>;  //!< By measurement and track

  std::vector<PointDecision> decide(
      const Frame& frame, const Ids& ids, const Innovations& innovations) const;
  /** Evidence from other frames only. */
  std::vector<AssociationTarget> targetsFor(const Frame& frame, const Ids& ids) const;
  /** Rows: measurements, columns: tracks; -infinity where it is not clear. \param density [1/m^D]
   */
  Eigen::MatrixXd logLikelihoods(
      const Frame& frame, const Innovations& innovations, double density) const;
  std::vector<PointDecision> decideAsGiven(const Frame& frame);
  void joinOrStart(Frame& frame);
  void forgetFleeting();
  void recount();

  struct World
  {
    double volume = 1;   //!< Where objects may be [m^D]
    double density = 1;  //!< Of objects [1/m^D]
  };
  World world() const;
  unsigned labelsSeen() const;  //!< U

  Ids mature() const;
  PointGraph<D> graphOf(const Ids& ids) const;
  void takeOver(const PointGraph<D>& graph, const Ids& ids);
  Constellation likelyDoubles(const Ids& ids, const Eigen::MatrixXd& covariance) const;
  bool isWorthMerging(const Constellation& doubles, double logOdds) const;
  double estimate(const Ids& ids);  //!< All poses and these tracks; returns the cost
  bool isTimeToMerge() const;
  Constellation likelyDoublesInFilter() const;
  void mergeOnline();
  void restartFilter();
  bool mergeDoubles(double logOdds, double& cost);
  void absorb(std::size_t kept, std::size_t absorbed);
  bool reassociate(const Ids& ids);
  struct Appearance
  {
    std::size_t seen = 0, missed = 0;  //!< Frames
  };
  Appearance appearanceOf(std::size_t id) const;
  bool shouldBeSeen(const PointVector<D>& position, std::size_t pose) const;
  void judge();
  void estimateConfirmed();

  PointOptions options_;
  bool posesGiven_ = false;
  PointVisibility<D> visible_;
  double detectionProbability_ = 0;
  std::vector<PointPose<D>> poses_;
  std::vector<PointOdometry<D>> steps_;
  std::vector<Frame> frames_;
  std::vector<Track> tracks_;
  PointFilter<D> filter_;
  Ids inFilter_;                                  //!< Tracks of the filter's objects
  std::map<std::uint32_t, std::size_t> trackOf_;  //!< By instance, when associations are given
  std::size_t lastMergeTest_ = 0;
  PointView<D> view_;
  PointResult<D> outcome_;
};

}  // namespace quadmap
