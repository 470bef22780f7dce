#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "Doubles.h"
#include "LookedAtRegion.h"
#include "PointFilter.h"
#include "PointGraph.h"
#include "quadmap/estimation/Association.h"
#include "quadmap/points/PointSlam.h"

namespace quadmap
{
/** What PointSlam does: doc/mathematics.md, section 18. Its functions are in one file per job:
 * PointSlamImpl_online.cpp, _association.cpp, _doubles.cpp, _estimate.cpp and _existence.cpp. */
template <int D>
class PointSlamImpl
{
 public:
  PointSlamImpl(
      const PointOptions& options,
      bool posesGiven,
      PointVisibility<D> visible,
      double detectionProbability) :
      options_(options),
      posesGiven_(posesGiven),
      visible_(std::move(visible)),
      detectionProbability_(detectionProbability)
  {
  }

  void addFrame(
      const PointOdometry<D>& step,
      const std::vector<PointMeasurement<D>>& measurements,
      const PointPose<D>& origin);
  void finish();
  PointResult<D> result() const;
  const PointPose<D>& pose() const { return filter_.pose(); }  //!< Pose of the last frame

 private:
  struct Frame
  {
    std::vector<PointMeasurement<D>> measurements;
    std::vector<PointDecision> decisions;  //!< Objects are indices of landmarks_
  };
  /** Something that was measured and may be an object. */
  struct Landmark
  {
    PointObject<D> object;
    std::size_t lastFrame = 0;
    bool alive = true;  //!< It was neither absorbed by another landmark nor given up
  };
  /** Indices of landmarks_. */
  using Ids = std::vector<std::size_t>;
  /** By measurement and landmark. */
  using Innovations = std::vector<std::vector<PointInnovation<D>>>;

  // PointSlamImpl_online.cpp
  /** Carries out the frame's decisions in the filter and counts them. */
  void joinOrStart(Frame& frame);
  /** Gives up landmarks that were seen too seldom for too long. */
  void forgetFleeting();
  bool isTimeToMerge() const;
  Doubles likelyDoublesInFilter() const;
  void mergeOnline();
  void restartFilter();

  // PointSlamImpl_association.cpp
  struct World
  {
    double volume = 1;   //!< Where objects may be [m^D]
    double density = 1;  //!< Number of objects per volume [1/m^D]
  };
  World world() const;
  unsigned labelsSeen() const;  //!< U, the number of labels
  /** What the other frames know of the landmarks: the frame's own measurements are left out. */
  std::vector<AssociationTarget> targetsFor(const Frame& frame, const Ids& ids) const;
  /** Rows are measurements, columns are landmarks; -infinity where the association is not clear.
   *  \param density Number of objects per volume [1/m^D]. */
  Eigen::MatrixXd logLikelihoods(
      const Frame& frame, const Innovations& innovations, double density) const;
  std::vector<PointDecision> decide(
      const Frame& frame, const Ids& ids, const Innovations& innovations) const;
  /** The decisions that the measurements' `instance` makes. */
  std::vector<PointDecision> decideAsGiven(const Frame& frame);
  /** Associates all measurements anew, with smoothed poses. \return Whether a decision changed. */
  bool reassociate(const Ids& ids);

  // PointSlamImpl_doubles.cpp
  Doubles likelyDoubles(const Ids& ids, const Eigen::MatrixXd& covariance) const;
  bool isWorthMerging(const Doubles& doubles, double logOdds) const;
  /** Merges the best doubles if the optimised graph agrees.
   *  \param cost Cost of the graph; it is updated when doubles were merged.
   *  \return Whether doubles were merged. */
  bool mergeDoubles(double logOdds, double& cost);
  void absorb(std::size_t kept, std::size_t absorbed);
  /** Counts observations and labels of all landmarks anew, from the decisions. */
  void recount();

  // PointSlamImpl_estimate.cpp
  /** Landmarks with at least `matureObservations` observations. */
  Ids mature() const;
  PointGraph<D> graphOf(const Ids& ids) const;
  void takeOver(const PointGraph<D>& graph, const Ids& ids);
  /** Optimises all poses and these landmarks. \return The cost. */
  double estimate(const Ids& ids);
  void estimateConfirmed();

  // PointSlamImpl_existence.cpp
  struct Appearance
  {
    std::size_t seen = 0, missed = 0;  //!< Numbers of frames
  };
  Appearance appearanceOf(std::size_t id) const;
  bool shouldBeSeen(const PointVector<D>& position, std::size_t pose) const;
  /** Sets log-odds of existence and `confirmed` of all mature landmarks. */
  void judge();

  PointOptions options_;
  bool posesGiven_ = false;
  PointVisibility<D> visible_;
  double detectionProbability_ = 0;
  std::vector<PointPose<D>> poses_;
  std::vector<PointOdometry<D>> steps_;
  std::vector<Frame> frames_;
  std::vector<Landmark> landmarks_;
  PointFilter<D> filter_;
  Ids inFilter_;                                     //!< Landmarks of the filter's objects
  std::map<std::uint32_t, std::size_t> landmarkOf_;  //!< By instance, when associations are given
  std::size_t lastMergeTest_ = 0;                    //!< Index of a frame
  LookedAtRegion<D> lookedAt_;
  PointResult<D> outcome_;
};

}  // namespace quadmap
