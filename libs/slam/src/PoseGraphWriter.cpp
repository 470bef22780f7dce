#include "quadmap/slam/PoseGraphWriter.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/poses/Lie/SO.h>

#include <cmath>
#include <fstream>
#include <map>
#include <utility>

#include "PoseAngles.h"
#include "quadmap/obs/OutputFile.h"

namespace quadmap
{
using mrpt::poses::CPose3D;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace
{
constexpr double kUprightSigma = 0.035;  //!< Roll and pitch of a supported object, 2 deg [rad]
constexpr double kUnknownYawSigma =
    0.453;  //!< Anything within a quarter turn: pi/2 / sqrt(12) [rad]

/** Where a graph's line has yaw, pitch and roll (MRPT's order of a pose: x y z yaw pitch roll). */
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

/** \param information In MRPT's order. */
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

/** A complete measurement numbers the axes of a cuboid as it likes; the map may have chosen another
 * of the four upright ways. \return The measured pose, turned to fit the map's. */
CPose3D turnedLike(const CPose3D& T_map_measured, const CPose3D& T_map_obj)
{
  CPose3D best = T_map_measured;
  double bestAngle = 2 * M_PI;
  for (int turns = 0; turns < 4; ++turns)
  {
    const CPose3D turned = T_map_measured + CPose3D(0, 0, 0, turns * M_PI / 2, 0, 0);
    const double angle =
        mrpt::poses::Lie::SO<3>::log((turned - T_map_obj).getRotationMatrix()).norm();
    if (angle >= bestAngle) continue;
    bestAngle = angle;
    best = turned;
  }
  return best;
}

/** Standard deviation of the measured centre along axis 0..2 of the measurement [m]. */
double centreSigma(const CompleteMeasurement& m, int axis)
{
  const auto& plus = m.faces[2 * static_cast<std::size_t>(axis)];
  const auto& minus = m.faces[2 * static_cast<std::size_t>(axis) + 1];
  const auto isKnown = [](const FaceMeasurement& f)
  { return f.kind == FaceKind::Measured || f.kind == FaceKind::Support; };
  const double half = m.object_sensor.semiAxes()[axis];
  const double sigmaPlus = isKnown(plus) ? plus.sigma : half;
  const double sigmaMinus = isKnown(minus) ? minus.sigma : half;
  return 0.5 * std::hypot(sigmaPlus, sigmaMinus);
}

/** Information of T_robot_obj, in MRPT's order, positions along the robot's axes.
 *  \param R_robot_measured The axes the measurement's faces belong to. */
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

/** What several cameras of one pose measured of one object, as one edge: MRPT keeps only one
 * between two nodes. The mean is weighted by information. */
class FusedEdge
{
 public:
  void add(const CPose3D& T_robot_obj, const Matrix6& information)
  {
    if (information_.isZero()) first_ = T_robot_obj;
    Vector6 difference;
    for (unsigned i = 0; i < 6; ++i)
    {
      difference[i] = T_robot_obj[i] - first_[i];
      if (i >= 3) difference[i] = mrpt::math::wrapToPi(difference[i]);
    }
    information_ += information;
    weighted_ += information * difference;
  }

  CPose3D mean() const
  {
    const Vector6 d = information_.ldlt().solve(weighted_);
    return {first_[0] + d[0], first_[1] + d[1], first_[2] + d[2],
            first_[3] + d[3], first_[4] + d[4], first_[5] + d[5]};
  }
  const Matrix6& information() const { return information_; }

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  CPose3D first_;
  Matrix6 information_ = Matrix6::Zero();
  Vector6 weighted_ = Vector6::Zero();  //!< Sum of information times difference to `first_`
};

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
    for (std::size_t n = 1; n < nodes_.size(); ++n) writeOdometry(n);
    if (result_.edges.empty())
      for (const auto& decision : result_.decisions) addMeasurement(decision);
    for (const auto& edge : result_.edges) addEdge(edge);
    for (const auto& [nodes, edge] : measurements_)
      writeEdge(out_, nodes.first, nodes.second, edge.mean(), edge.information());
  }

 private:
  void writeOdometry(std::size_t n)
  {
    const auto step = stepTo(n);
    writeEdge(out_, n - 1, n, step.mean, step.cov.asEigen().inverse());
  }

  /** From the node before, as the estimation had it: steps lead from keyframe to keyframe. */
  mrpt::poses::CPose3DPDFGaussian stepTo(std::size_t n) const
  {
    const std::size_t from = nodes_[n - 1].keyframes.front(), to = nodes_[n].keyframes.front();
    const auto stated = [&](std::size_t k) { return result_.keyframes[k].odometryStep; };
    if (to == from + 1 && stated(to)) return *stated(to);
    // Several cameras, or not in the order of time: their steps may be at rest.
    auto step = odometryStep(uncertainty_, nodes_[n - 1].T_odom_robot, nodes_[n].T_odom_robot);
    for (std::size_t k = from + 1; k <= to; ++k)
      if (stated(k) && nodeOf_[k] == n && nodeOf_[k - 1] == n - 1) step.cov = stated(k)->cov;
    return step;
  }

  void addEdge(const FactorGraph::PoseEdge& edge)
  {
    const MapObject* object = result_.map.find(edge.object);
    if (!object || !object->confirmed) return;
    Matrix6 information = Matrix6::Zero();
    information.diagonal() << Eigen::Vector3d::Constant(edge.positionInformation),
        Eigen::Vector3d::Constant(edge.angleInformation);
    measurements_[{nodeOf_[edge.pose], nodes_.size() + edge.object}].add(
        edge.T_robot_obj, information);
  }

  void addMeasurement(const BoxDecision& box)
  {
    const MapObject* object =
        box.decision.object ? result_.map.find(*box.decision.object) : nullptr;
    if (!object || !object->confirmed) return;
    loadBoxes(box.keyframe);
    const auto& measurement = boxes_->objects.at(box.decision.box).measurement;
    if (!measurement.complete) return;

    const std::size_t node = nodeOf_[box.keyframe];
    const CPose3D& T_map_robot = nodes_[node].T_map_robot;
    const CPose3D T_robot_measured =
        boxes_->sensorPose + measurement.complete->object_sensor.pose();
    const CPose3D T_robot_obj =
        turnedLike(T_map_robot + T_robot_measured, object->object.pose()) - T_map_robot;
    measurements_[{node, nodes_.size() + object->id}].add(
        T_robot_obj,
        measurementInformation(
            *measurement.complete, T_robot_measured.getRotationMatrix().asEigen(), T_robot_obj));
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
  std::vector<std::size_t> nodeOf_;                                        //!< Each keyframe
  std::map<std::pair<std::size_t, std::size_t>, FusedEdge> measurements_;  //!< By their nodes
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
  if (!out) throw std::runtime_error(path + ": cannot be written");
  file.commit();
}

}  // namespace quadmap
