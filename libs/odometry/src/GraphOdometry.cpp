#include "quadmap/odometry/GraphOdometry.h"

#include <mrpt/core/format.h>
#include <mrpt/graphs/CNetworkOfPoses.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "GraphText.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/InputFile.h"
#include "quadmap/base/OutputSet.h"
#include "quadmap/base/StderrCapture.h"

namespace quadmap
{
using mrpt::graphs::TNodeID;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;
using Graph = mrpt::graphs::CNetworkOfPoses3DInf;

namespace
{
/** 100,000 poses with edges. In memory a line takes many times its length. */
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 25;
constexpr double kSameTime = 1e-3;  // between rounded time stamps of one image [s]
constexpr double kSilent = 1e-15;   // information below this is rounding: a planar edge states none

/** Whether an information matrix states nothing about these coordinates. */
bool isSilent(const Eigen::Matrix<double, 6, 6>& matrix, std::initializer_list<int> coordinates)
{
  for (const int i : coordinates)
    if (!matrix.row(i).isZero() || !matrix.col(i).isZero()) return false;
  return true;
}

/** The text of a graph, with the times that MRPT's reader takes for comments. */
class GraphFile
{
 public:
  explicit GraphFile(const std::string& path) : path_(path)
  {
    requireOneRun(path);
    const auto file = openModestText(path, kMostBytes);
    std::stringstream text;
    text << file.rdbuf();
    times = checkGraphText(text.str(), path);
    read(text);
    if (graph.nodes.empty())
      throw std::runtime_error(path + ": no pose graph, it has no VERTEX3 line");
    for (const auto& t : times)
      if (graph.nodes.count(t.node) == 0)
        throw std::runtime_error(mrpt::format(
            "%s: a TIME of node %u, which is not there", t.place.c_str(), unsigned(t.node)));
  }

  Graph graph;
  std::vector<NodeTime> times;

  /** Covariance of the step from a node to another one, when an edge joins them. It is zero for the
   * coordinates of which a planar edge says nothing. */
  std::optional<mrpt::math::CMatrixDouble66> stepCovariance(TNodeID from, TNodeID to) const
  {
    const bool isForward = graph.edgeExists(from, to);
    if (!isForward && !graph.edgeExists(to, from)) return std::nullopt;
    const auto& edge = isForward ? graph.getEdge(from, to) : graph.getEdge(to, from);
    const Eigen::Matrix<double, 6, 6> given = edge.cov_inv.asEigen();
    const bool isPlanar = !given.isZero() && isSilent(given, {2, 4, 5});
    Eigen::Matrix<double, 6, 6> information = given;
    if (isPlanar)
      for (const int i : {2, 4, 5})
        information(i, i) = 1;  // any positive number gives it an inverse
    if (!information.isApprox(information.transpose()) ||
        information.llt().info() != Eigen::Success)
      throw std::runtime_error(mrpt::format(
          "%s: the information of the edge between %u and %u is not positive definite",
          path_.c_str(), unsigned(from), unsigned(to)));
    const Eigen::Matrix<double, 6, 6> covariance = information.inverse();
    CPose3DPDFGaussian step(edge.mean, mrpt::math::CMatrixDouble66(covariance));
    if (isPlanar)
      for (const int i : {2, 4, 5}) step.cov(i, i) = 0;
    return (isForward ? step : -step).cov;
  }

 private:
  void read(std::istream& text)
  {
    const StderrCapture capture;  // where MRPT tells of what it passes over
    try
    {
      graph.readAsText(text);
    }
    catch (const std::exception& e)
    {
      throw std::runtime_error(path_ + ": " + rootMessage(e));
    }
  }

  std::string path_;
};

/** The nodes from the first on that are numbered one after the other and joined by edges. */
std::vector<TNodeID> chainOf(const Graph& graph)
{
  std::vector<TNodeID> chain{graph.nodes.begin()->first};
  for (TNodeID next = chain[0] + 1; graph.nodes.count(next) != 0; ++next)
  {
    if (!graph.edgeExists(next - 1, next) && !graph.edgeExists(next, next - 1)) break;
    chain.push_back(next);
  }
  return chain;
}

}  // namespace

GraphOdometry::GraphOdometry(const std::string& path) : path_(path)
{
  const GraphFile file(path);
  warningOfCut_ = warningOfCut(path);
  std::vector<TNodeID> nodes;
  std::map<double, TNodeID> nodeAt;
  for (const auto& t : file.times) nodeAt.emplace(t.time, t.node);
  std::map<TNodeID, std::size_t> indexOf;
  for (const auto& [time, node] : nodeAt)
  {
    const auto [known, isNew] = indexOf.emplace(node, nodes.size());
    if (isNew) nodes.push_back(node);
    times_[time] = known->second;
  }
  if (file.times.empty()) nodes = chainOf(file.graph);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    poses_.push_back(
        {file.graph.nodes.at(nodes[i]),
         i + 1 < nodes.size() ? file.stepCovariance(nodes[i], nodes[i + 1]) : std::nullopt});
  wasUsed_.resize(poses_.size(), false);
  for (auto it = times_.begin(); it != times_.end(); ++it)
    if (it != times_.begin()) longestGap_ = std::max(longestGap_, it->first - std::prev(it)->first);
}

std::optional<CPose3D> GraphOdometry::poseAt(double time)
{
  latest_.reset();
  const std::size_t image = images_++;
  if (times_.empty())
  {
    latest_ = image;
    if (*latest_ >= poses_.size())
      throw std::runtime_error(mrpt::format(
          "%s: %zu robot poses without times (# TIME lines), but the recording has more images",
          path_.c_str(), poses_.size()));
  }
  else
  {
    auto nearest = times_.lower_bound(time - kSameTime);
    for (auto it = nearest; it != times_.end() && it->first <= time + kSameTime; ++it)
      if (std::abs(it->first - time) <= std::abs(nearest->first - time)) nearest = it;
    if (nearest != times_.end() && nearest->first <= time + kSameTime) latest_ = nearest->second;
    if (!latest_ && isFarOutside(time)) ++imagesOutside_;
  }
  if (!latest_) return std::nullopt;
  wasUsed_[*latest_] = true;
  return poses_[*latest_].T_map_robot;
}

std::optional<CPose3DPDFGaussian> GraphOdometry::takeStep(const PoseUncertaintyOptions& options)
{
  std::optional<CPose3DPDFGaussian> result;
  if (keyframe_ && latest_) result = step(*keyframe_, *latest_, options);
  keyframe_ = latest_;
  return result;
}

CPose3DPDFGaussian GraphOdometry::step(
    std::size_t from, std::size_t to, const PoseUncertaintyOptions& options) const
{
  if (to < from) return -step(to, from, options);
  if (to == from) return odometryStep(options, poses_[from].T_map_robot, poses_[to].T_map_robot);
  std::optional<CPose3DPDFGaussian> sum;
  for (std::size_t i = from; i < to; ++i)
  {
    auto next = odometryStep(options, poses_[i].T_map_robot, poses_[i + 1].T_map_robot);
    if (const auto& stated = poses_[i].stepCovariance)
      for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c)
          if ((*stated)(r, r) > kSilent && (*stated)(c, c) > kSilent)
            next.cov(r, c) = (*stated)(r, c);
    sum = sum ? *sum + next : next;
  }
  return *sum;
}

/** Between the keyframes of a run there are images without a pose, and behind the last keyframe a
 * few. Many of them behind it mean that the graph is of another recording, or a part of its own. */
bool GraphOdometry::isFarOutside(double time) const
{
  return time < times_.begin()->first - longestGap_ || time > times_.rbegin()->first + longestGap_;
}

std::string GraphOdometry::warning() const
{
  std::string text = warningOfCut_;
  if (const auto misfit = warningOfMisfit(); !misfit.empty())
    text += (text.empty() ? "" : "; ") + misfit;
  return text.empty() ? text : path_ + ": " + text;
}

std::string GraphOdometry::warningOfMisfit() const
{
  const auto unused = std::count(wasUsed_.begin(), wasUsed_.end(), false);
  if (times_.empty() || unused == static_cast<std::ptrdiff_t>(poses_.size())) return {};
  std::string text;
  if (unused > 0)
    text = mrpt::format("%td of %zu poses have the time of no image", unused, poses_.size());
  if (imagesOutside_ > 0)
    text += mrpt::format(
        "%s%zu of %zu images are before all poses or behind them, by more than these are apart",
        text.empty() ? "" : ", and ", imagesOutside_, images_);
  return text;
}

void GraphOdometry::requireAllUsed() const
{
  if (times_.empty() && images_ < poses_.size())
    throw std::runtime_error(mrpt::format(
        "%s: %zu robot poses without times (# TIME lines), but the recording has %zu images",
        path_.c_str(), poses_.size(), images_));
}

}  // namespace quadmap
