#include "quadmap/graph/FactorGraph.h"

#include <ceres/cost_function.h>
#include <ceres/manifold.h>

#include <algorithm>
#include <stdexcept>

#include "GraphProblem.h"
#include "quadmap/estimation/AxisRenaming.h"

namespace quadmap
{
std::size_t FactorGraph::addPose(const mrpt::poses::CPose3D& T_map_robot)
{
  poses_.push_back(poseBlockOf(T_map_robot));
  stepsByPose_.emplace_back();
  viewsByPose_.emplace_back();
  return poses_.size() - 1;
}

void FactorGraph::setPose(std::size_t index, const mrpt::poses::CPose3D& T_map_robot)
{
  poses_.at(index) = poseBlockOf(T_map_robot);
}

void FactorGraph::addStep(
    std::size_t from, std::size_t to, const mrpt::poses::CPose3DPDFGaussian& T_from_to)
{
  stepsByPose_.at(std::max(from, to)).push_back({from, to, T_from_to, true});
}

void FactorGraph::addKnownStep(
    std::size_t from, std::size_t to, const mrpt::poses::CPose3DPDFGaussian& T_from_to)
{
  stepsByPose_.at(std::max(from, to)).push_back({from, to, T_from_to, false});
}

void FactorGraph::setObject(
    ObjectId id, const Ellipsoid& object, const LabelProperties& label, ObjectFreedom freedom)
{
  Object& vertex = objects_[id];
  if (vertex.freedom != freedom)
  {
    vertex.prior = vertex.folded = std::nullopt;
    vertex.foldedBottom = 0;
  }
  vertex.block = objectBlockOf(object, freedom);
  vertex.freedom = freedom;
  vertex.label = label;
}

Ellipsoid FactorGraph::object(ObjectId id) const
{
  const Object& vertex = objects_.at(id);
  return objectOf(vertex.block, vertex.freedom);
}

void FactorGraph::setObjectPrior(ObjectId id, const ObjectPrior& prior)
{
  objects_.at(id).prior = prior;
}

/** Adds what one Gaussian knows of an upright object to that of its heir. */
void FactorGraph::bequeath(const ObjectPrior& from, Object& heir)
{
  const auto stateOf = [](const ObjectBlock& block)
  { return UprightState(Eigen::Map<const UprightState>(block.data())); };
  const AxisRenaming r = axisRenaming(stateOf(from.at), stateOf(heir.block));
  ObjectPrior moved;
  moved.L = r.matrix(from.L);
  moved.g = r.P * from.g;
  Eigen::Map<UprightState>(moved.at.data()) = r.state(stateOf(from.at));
  if (!heir.folded)
  {
    heir.folded = moved;
    return;
  }
  heir.folded->L += moved.L;
  heir.folded->g += moved.g + moved.L * (stateOf(heir.folded->at) - stateOf(moved.at));
}

void FactorGraph::removeObject(ObjectId id, std::optional<ObjectId> heir)
{
  const auto removed = objects_.find(id);
  if (heir && removed != objects_.end() && removed->second.folded)
    if (Object& to = objects_.at(*heir);
        to.freedom == ObjectFreedom::Upright && removed->second.freedom == to.freedom)
    {
      bequeath(*removed->second.folded, to);
      to.foldedBottom += removed->second.foldedBottom;
    }
  objects_.erase(id);
  for (std::size_t k = firstKept(); k < viewsByPose_.size(); ++k)
  {
    auto& views = viewsByPose_[k];
    if (heir)
      for (View& v : views) v.object = v.object == id ? *heir : v.object;
    else
      views.erase(
          std::remove_if(views.begin(), views.end(), [&](const View& v) { return v.object == id; }),
          views.end());
  }
}

void FactorGraph::addView(std::size_t pose, ObjectId id, const BoxMeasurement& view)
{
  if (!hasObject(id)) throw std::invalid_argument("FactorGraph: a view of an unknown object");
  if (pose < foldedUpTo_) fold({id, view}, poses_[pose]);
  if (pose >= firstKept()) viewsByPose_.at(pose).push_back({id, view});
}

void FactorGraph::removeViews(std::size_t pose)
{
  auto& views = viewsByPose_.at(pose);
  if (pose < foldedUpTo_ && !views.empty())
    throw std::invalid_argument("FactorGraph: these views are folded");
  views.clear();
}

std::size_t FactorGraph::viewCount() const
{
  std::size_t count = 0;
  for (const auto& views : viewsByPose_) count += views.size();
  return count;
}

void FactorGraph::foldBefore(std::size_t firstFree)
{
  for (; foldedUpTo_ < firstFree; ++foldedUpTo_)
  {
    for (const View& view : viewsByPose_[foldedUpTo_])
      if (hasObject(view.object)) fold(view, poses_[foldedUpTo_]);
    if (options_.keepsFolded) continue;
    viewsByPose_[foldedUpTo_] = std::vector<View>();
    stepsByPose_[foldedUpTo_] = std::vector<Step>();
  }
}

void FactorGraph::fold(const View& view, const PoseBlock& pose)
{
  Object& object = objects_.at(view.object);
  const auto factor = createViewFactor(
      view.view, object.label.shapeExponent, options_.estimator.huber, object.freedom);
  const int rows = factor->num_residuals(), step = incrementSize(object.freedom);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::VectorXd r(rows);
  RowMajor poseJacobian(rows, 7), J(rows, blockSize(object.freedom));
  const double* blocks[] = {pose.data(), object.block.data()};
  double* jacobians[] = {poseJacobian.data(), J.data()};
  factor->Evaluate(blocks, r.data(), jacobians);

  if (!object.folded)
    object.folded = {object.block, Eigen::MatrixXd::Zero(step, step), Eigen::VectorXd::Zero(step)};
  ObjectPrior& folded = *object.folded;
  Eigen::VectorXd d(step);  // from the Gaussian's linearisation to the present estimate
  if (const auto manifold = objectManifold(object.freedom))
  {
    RowMajor plus(blockSize(object.freedom), step);
    manifold->PlusJacobian(object.block.data(), plus.data());
    J = RowMajor(J * plus);
    manifold->Minus(object.block.data(), folded.at.data(), d.data());
  }
  else
    d = Eigen::Map<const UprightState>(object.block.data()) -
        Eigen::Map<const UprightState>(folded.at.data());
  // (16.13) of doc/mathematics.md
  folded.L += J.transpose() * J;
  folded.g += J.transpose() * (r - J * d);
  object.foldedBottom += bottomInformation(view.view);
}

}  // namespace quadmap
