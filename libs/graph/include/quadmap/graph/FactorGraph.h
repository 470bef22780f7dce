#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <Eigen/Dense>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "quadmap/estimation/BoxMeasurement.h"
#include "quadmap/estimation/EstimatorOptions.h"
#include "quadmap/estimation/MapObject.h"
#include "quadmap/graph/GraphFactors.h"
#include "quadmap/graph/GraphState.h"
#include "quadmap/graph/StepNoise.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
struct FactorGraphOptions
{
  EstimatorOptions estimator;  //!< Huber's threshold, sigmas of priors: those of the object map
  int maxIterations = 30;      //!< Of one optimisation, >= 1
  double floorSigma = 0.02;    //!< Bottom of things that stand on one floor [m]; 0: no such factor
  /** False: only windows are optimised. Views and steps before them are then forgotten, so that
   * memory grows by no more than a pose for each keyframe. */
  bool keepsFolded = true;
};

/** Poses and objects that are estimated together (doc/mathematics.md, "The graph"). The first pose
 * is fixed: it defines the map.
 *
 * optimise() frees everything. optimiseWindow() frees the latest poses and the objects seen from
 * them; older poses stay, and what they said of an object is kept as a Gaussian, so that its cost
 * depends on the window and not on the past.
 *
 * Single-threaded and deterministic: same calls, same bytes. */
class FactorGraph
{
 public:
  explicit FactorGraph(const FactorGraphOptions& options) : options_(options) {}

  /** \return Index of the new pose; the first is 0. */
  std::size_t addPose(const mrpt::poses::CPose3D& T_map_robot);
  std::size_t poses() const { return poses_.size(); }
  mrpt::poses::CPose3D pose(std::size_t index) const { return poseOf(poses_.at(index)); }
  void setPose(std::size_t index, const mrpt::poses::CPose3D& T_map_robot);
  /** A step of odometry. */
  void addStep(std::size_t from, std::size_t to, const mrpt::poses::CPose3DPDFGaussian& T_from_to);
  /** What is known of two poses from elsewhere. It is no odometry and errs by what it claims. */
  void addKnownStep(
      std::size_t from, std::size_t to, const mrpt::poses::CPose3DPDFGaussian& T_from_to);
  /** How many times as much as it claims the odometry errs by, in all its steps; at first it is
   * believed. */
  void setStepNoise(const StepNoise& noise) { stepNoise_ = noise; }

  /** A new object, or another first guess or label for a known one. */
  void setObject(
      ObjectId id,
      const Ellipsoid& object,
      const LabelProperties& label,
      ObjectFreedom freedom = ObjectFreedom::Upright);
  bool hasObject(ObjectId id) const { return objects_.count(id) != 0; }
  Ellipsoid object(ObjectId id) const;
  /** Sets knowledge from elsewhere, 1/2 d^t L d + g^t d with d the increment from its `at`
   * (doc/mathematics.md, (16.9)). */
  void setObjectPrior(ObjectId id, const ObjectPrior& prior);
  /** Forgets the object and its views. Another one may take the views over, and what folded ones
   * said as well when both are upright. */
  void removeObject(ObjectId id, std::optional<ObjectId> heir = std::nullopt);

  /** A view from a pose that optimiseWindow() frees no more is folded at once. */
  void addView(std::size_t pose, ObjectId id, const BoxMeasurement& view);
  /** \exception std::invalid_argument If they are folded: that can not be undone. */
  void removeViews(std::size_t pose);
  std::size_t viewCount() const;

  struct Summary
  {
    bool converged = false;
    int iterations = 0;
    double initialCost = 0, finalCost = 0;  //!< Half the sum of squared residuals, robust
    std::size_t freePoses = 0, freeObjects = 0, residuals = 0;
  };
  Summary optimise();
  /** \param firstFree Poses before it stay where they are (pose 0 always). Never decreases. */
  Summary optimiseWindow(std::size_t firstFree);
  /** Optimises the objects alone. All poses stay. */
  Summary optimiseObjects();

  struct Marginals
  {
    /** Covariance of the increments of the last pose (GraphState.h). That of pose 0 is zero. */
    Eigen::Matrix<double, 6, 6> lastPose = Eigen::Matrix<double, 6, 6>::Zero();
    std::map<ObjectId, Eigen::MatrixXd> objects;
  };
  /** Covariances of the free poses and objects, with everything else fixed. \param firstFree As in
   * optimiseWindow(); 0: everything. \param withObjects False: of the last pose only. */
  Marginals marginals(std::size_t firstFree, bool withObjects);
  /** Covariances of the increments of all poses (GraphState.h), that of pose 0 being zero. It takes
   * about as long as one iteration of optimise().
   * \return Nothing when a pose is not joined to pose 0: by steps, by views of common objects or by
   * objects with a prior, directly or by other poses. */
  std::vector<Eigen::Matrix<double, 6, 6>> poseMarginals();
  /** Joint covariance of the increments of some poses, six rows each in the order given; those of
   * pose 0 are zero.
   * \param shouldStop Asked for each of these poses.
   * \return Nothing when any pose is not joined to pose 0, as above, or after a yes to
   * shouldStop(). */
  std::optional<Eigen::MatrixXd> jointMarginal(
      const std::vector<std::size_t>& poses,
      const std::function<bool()>& shouldStop = [] { return false; });
  /** Covariances of the objects' increments, given all poses. */
  std::map<ObjectId, Eigen::MatrixXd> objectMarginals();

  /** Covariances of the upright objects' increments relative to the trajectory as a whole, (16.18)
   * of doc/mathematics.md: the poses err, too, but a motion of everything together is no error of a
   * map. \param firstPose The first one of the trajectory.
   * \return Nothing when no pose is free or the normal matrix cannot be factorised. */
  std::map<ObjectId, UprightCovariance> alignedObjectMarginals(std::size_t firstPose);

  /** What a window says of its last pose and of the odometry, at the present estimate. Both follow
   * from one normal matrix. */
  struct WindowFit
  {
    /** Covariance of the increments of the last pose (GraphState.h). */
    Eigen::Matrix<double, 6, 6> lastPose = Eigen::Matrix<double, 6, 6>::Zero();
    StepFit steps;  //!< How the steps agree with all else, (16.21) of doc/mathematics.md
  };
  /** \param firstFree As in optimiseWindow(). \param steps The first and one past the last pose of
   * those that the steps in question lead to.
   * \exception std::runtime_error When the normal matrix cannot be factorised. */
  WindowFit windowFit(std::size_t firstFree, std::pair<std::size_t, std::size_t> steps);
  /** How all steps agree with all else, with all poses free.
   * \return Zeros when no pose is free or the normal matrix cannot be factorised. */
  StepFit stepFit();

  /** How much the views of one pose know of the relative pose of one object. */
  struct GraphEdge
  {
    std::size_t pose = 0;
    ObjectId object = 0;
    double positionInformation = 0;  //!< Mean over all directions [1/m^2]
    double angleInformation = 0;     //!< Mean over all axes [1/rad^2]
  };
  /** The views at the present estimate in a form for graphs of poses, which know no sizes: those
   * are taken as they are. Information is the same in all directions, because programs differ in
   * the axes they think it belongs to. */
  std::vector<GraphEdge> graphEdges() const;

 private:
  friend class GraphProblem;

  struct Object
  {
    ObjectBlock block{};
    ObjectFreedom freedom = ObjectFreedom::Upright;
    LabelProperties label;
    std::optional<ObjectPrior> prior;   //!< From elsewhere
    std::optional<ObjectPrior> folded;  //!< What the poses before foldedUpTo_ said
    double foldedBottom = 0;            //!< Of that, the information on its bottom [1/m^2]
  };
  struct Step
  {
    std::size_t from = 0, to = 0;
    mrpt::poses::CPose3DPDFGaussian T_from_to;
    bool isOdometry = true;

    /** With the covariance that it really has. */
    mrpt::poses::CPose3DPDFGaussian believed(const StepNoise& noise) const
    {
      return isOdometry ? scaled(T_from_to, noise) : T_from_to;
    }
  };
  struct View
  {
    ObjectId object = 0;
    BoxMeasurement view;
  };

  std::size_t firstKept() const { return options_.keepsFolded ? 0 : foldedUpTo_; }
  static void bequeath(const ObjectPrior& from, Object& heir);
  void foldBefore(std::size_t firstFree);
  void fold(const View& view, const PoseBlock& pose);

  FactorGraphOptions options_;
  StepNoise stepNoise_;
  std::vector<PoseBlock> poses_;
  std::vector<std::vector<Step>> stepsByPose_;  //!< At the later of their two poses
  std::vector<std::vector<View>> viewsByPose_;
  std::map<ObjectId, Object> objects_;
  std::deque<double> floorHeights_;  //!< Estimated so far [m]; a problem points to those it has
  std::size_t foldedUpTo_ = 0;
};

}  // namespace quadmap
