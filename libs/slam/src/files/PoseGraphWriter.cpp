#include "files/PoseGraphWriter.h"

#include <mrpt/core/bits_math.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <utility>

#include "quadmap/base/OutputFile.h"
#include "quadmap/estimation/MeasuredGeometry.h"
#include "quadmap/geometry/PoseAngles.h"

namespace quadmap
{
using mrpt::poses::CPose3D;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace
{
constexpr double kUprightSigma = 0.035;  //!< Of roll and pitch of a supported object [rad]
/** Sigma of a uniform angle within a quarter turn, pi/2 / sqrt(12) [rad]. */
constexpr double kUnknownYawSigma = 0.453;

constexpr double kLoose = 1e-6;  //!< Information that is practically none [1/m^2], [1/rad^2]

/** Positions, in a line of a graph, of MRPT's order of a pose: x y z yaw pitch roll. */
constexpr int kTextOrder[] = {0, 1, 2, 5, 4, 3};

void writePose(std::ostream& out, const CPose3D& pose)
{
  for (const int i : kTextOrder) out << " " << pose[static_cast<unsigned>(i)];
}

void writeNode(std::ostream& out, std::size_t id, const CPose3D& pose)
{
  out << "VERTEX3 " << id;
  writePose(out, pose);
  out << "\n";
}

/** Writes an edge. \param information In MRPT's order. */
void writeEdge(
    std::ostream& out,
    std::size_t from,
    std::size_t to,
    const CPose3D& T_from_to,
    const Matrix6& information)
{
  out << "EDGE3 " << from << " " << to;
  writePose(out, T_from_to);
  for (int row = 0; row < 6; ++row)
    for (int col = row; col < 6; ++col) out << " " << information(kTextOrder[row], kTextOrder[col]);
  out << "\n";
}

/** Standard deviation of the measured centre along axis 0..2 of the measurement [m]. */
double centreSigma(const CompleteMeasurement& m, int axis)
{
  const auto& plus = m.faces[2 * static_cast<std::size_t>(axis)];
  const auto& minus = m.faces[2 * static_cast<std::size_t>(axis) + 1];
  const double half = m.object_sensor.semiAxes()[axis];
  const double sigmaPlus = isEquality(plus.kind) ? plus.sigma : half;
  const double sigmaMinus = isEquality(minus.kind) ? minus.sigma : half;
  return 0.5 * std::hypot(sigmaPlus, sigmaMinus);
}

/** Information of T_robot_obj in MRPT's order, with positions along the robot's axes.
 *  \param R_robot_measured Rotation whose columns are the axes of the measured faces. */
Matrix6 measurementInformation(
    const CompleteMeasurement& m,
    const Eigen::Matrix3d& R_robot_measured,
    const CPose3D& T_robot_obj)
{
  Eigen::Vector3d weights;
  for (int axis = 0; axis < 3; ++axis) weights[axis] = std::pow(centreSigma(m, axis), -2);
  const double yawSigma = m.yawDefined ? m.yawSigma : kUnknownYawSigma;
  const Eigen::Vector3d turnWeights(
      std::pow(kUprightSigma, -2), std::pow(kUprightSigma, -2), std::pow(yawSigma, -2));
  const Eigen::Matrix3d J = localTurnsPerAngle(T_robot_obj);
  Matrix6 information = Matrix6::Zero();
  information.topLeftCorner<3, 3>() =
      R_robot_measured * weights.asDiagonal() * R_robot_measured.transpose();
  information.bottomRightCorner<3, 3>() = J.transpose() * turnWeights.asDiagonal() * J;
  return information;
}

/** The information of a step in the form that MRPT 2.5 reads back. MRPT loses the correlations of
 * angles, and the rest of a full matrix may then not be positive definite. The result therefore
 * only has the variances and the correlations of positions. */
Matrix6 stepInformation(const Matrix6& covariance)
{
  Matrix6 kept = covariance.diagonal().asDiagonal();
  kept.topLeftCorner<3, 3>() = covariance.topLeftCorner<3, 3>();
  return kept.inverse();
}

class GraphText
{
 public:
  GraphText(
      std::ostream& out,
      const std::vector<PoseNode>& nodes,
      const SlamResult& result,
      const KeyframeSpool& spool,
      const PoseUncertaintyOptions& uncertainty) :
      out_(out),
      nodes_(nodes),
      result_(result),
      spool_(spool),
      uncertainty_(uncertainty),
      nodeOf_(nodeOfEachKeyframe(nodes))
  {
    out_.precision(10);
  }

  void write()
  {
    for (std::size_t n = 0; n < nodes_.size(); ++n)
    {
      for (const std::size_t k : nodes_[n].keyframes)
        out_ << mrpt::format("# TIME %zu %.6f\n", n, result_.keyframes[k].time);
      writeNode(out_, n, nodes_[n].T_map_robot);
      if (n == 0) out_ << "FIX 0\n";
    }
    for (const MapObject* object : result_.map.confirmedObjects())
      writeNode(out_, nodes_.size() + object->id, object->object.pose());
    for (std::size_t n = 1; n < nodes_.size(); ++n)
      writeEdge(
          out_, n - 1, n, nodes_[n].T_map_robot - nodes_[n - 1].T_map_robot,
          stepInformation(stepCovariance(n)));
    if (result_.edges.empty())
      for (const auto& decision : result_.decisions) addMeasurement(decision);
    for (const auto& edge : result_.edges) addEdge(edge);
    tieLooseObjects();
    for (const auto& [ends, information] : measurements_)
      writeEdge(out_, ends.first, nodes_.size() + ends.second, T_robot_obj(ends), information);
  }

 private:
  using Ends = std::pair<std::size_t, ObjectId>;  // a node and an object

  CPose3D T_robot_obj(const Ends& ends) const
  {
    return result_.map.find(ends.second)->object.pose() - nodes_[ends.first].T_map_robot;
  }

  /** Covariance of the step from the node before to node n. It is the sum of the estimation's
   * steps, which lead from keyframe to keyframe. */
  Matrix6 stepCovariance(std::size_t n) const
  {
    const std::size_t from = nodes_[n - 1].keyframes.front(), to = nodes_[n].keyframes.front();
    const auto stated = [&](std::size_t k) { return result_.keyframes[k].odometryStep; };
    if (to == from + 1 && stated(to)) return stated(to)->cov.asEigen();
    // With several cameras, or out of the order of time, steps between the nodes may be at rest.
    auto step = odometryStep(uncertainty_, nodes_[n - 1].T_odom_robot, nodes_[n].T_odom_robot);
    for (std::size_t k = from + 1; k <= to; ++k)
      if (stated(k) && nodeOf_[k] == n && nodeOf_[k - 1] == n - 1) step.cov = stated(k)->cov;
    return step.cov.asEigen();
  }

  bool isConfirmed(ObjectId id) const
  {
    const MapObject* object = result_.map.find(id);
    return object && object->confirmed;
  }

  /** Adds information. MRPT keeps one edge between two nodes, so that the information of several
   * cameras is summed. */
  void add(const Ends& ends, const Matrix6& information)
  {
    measurements_.try_emplace(ends, Matrix6::Zero()).first->second += information;
  }

  void addEdge(const FactorGraph::GraphEdge& edge)
  {
    if (!isConfirmed(edge.object)) return;
    Matrix6 information = Matrix6::Zero();
    information.diagonal() << Eigen::Vector3d::Constant(edge.positionInformation),
        Eigen::Vector3d::Constant(edge.angleInformation);
    add({nodeOf_[edge.pose], edge.object}, information);
  }

  void addMeasurement(const BoxDecision& box)
  {
    if (!box.decision.object || !isConfirmed(*box.decision.object)) return;
    loadBoxes(box.keyframe);
    const auto& measurement = boxes_->objects.at(box.decision.box).measurement;
    if (!measurement.complete) return;

    const Ends ends(nodeOf_[box.keyframe], *box.decision.object);
    const CPose3D T_robot_measured =
        boxes_->sensorPose + measurement.complete->object_sensor.pose();
    add(ends, measurementInformation(
                  *measurement.complete, T_robot_measured.getRotationMatrix().asEigen(),
                  T_robot_obj(ends)));
  }

  /** Ties objects without edges to the first node, as MRPT's optimiser fails for nodes without
   * edges.
   */
  void tieLooseObjects()
  {
    std::set<ObjectId> held;
    for (const auto& [ends, information] : measurements_) held.insert(ends.second);
    for (const MapObject* object : result_.map.confirmedObjects())
      if (held.count(object->id) == 0) add({0, object->id}, kLoose * Matrix6::Identity());
  }

  void loadBoxes(std::size_t keyframe)
  {
    if (boxes_ && keyframe == boxesOf_) return;
    boxes_ = spool_.objects(keyframe);
    boxesOf_ = keyframe;
  }

  std::ostream& out_;
  const std::vector<PoseNode>& nodes_;
  const SlamResult& result_;
  const KeyframeSpool& spool_;
  const PoseUncertaintyOptions& uncertainty_;
  std::vector<std::size_t> nodeOf_;       //!< Node of each keyframe
  std::map<Ends, Matrix6> measurements_;  //!< Sums of information
  CObservationObjects::Ptr boxes_;
  std::size_t boxesOf_ = 0;
};

}  // namespace

void writePoseGraph(
    const std::string& path,
    const std::vector<PoseNode>& nodes,
    const SlamResult& result,
    const KeyframeSpool& spool,
    const PoseUncertaintyOptions& uncertainty)
{
  OutputFile file(path);
  std::ofstream out(file.temporaryPath());
  GraphText(out, nodes, result, spool, uncertainty).write();
  out.close();
  if (!out) file.fail();
  file.commit();
}

}  // namespace quadmap
