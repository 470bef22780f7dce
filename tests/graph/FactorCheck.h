#pragma once

#include <ceres/cost_function.h>
#include <ceres/manifold.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "quadmap/graph/GraphFactors.h"

namespace quadmap::testing
{
constexpr double kQuadratic = 1e9;  // Huber threshold that never acts [sigmas]

/** One parameter block of a factor under test. */
struct Block
{
  std::vector<double> values;
  const ceres::Manifold* manifold = nullptr;  // null: flat

  int steps() const { return manifold ? manifold->TangentSize() : static_cast<int>(values.size()); }
  Block moved(int coordinate, double h) const
  {
    Block b = *this;
    if (!manifold)
    {
      b.values[static_cast<std::size_t>(coordinate)] += h;
      return b;
    }
    std::vector<double> step(static_cast<std::size_t>(steps()), 0.0);
    step[static_cast<std::size_t>(coordinate)] = h;
    manifold->Plus(values.data(), step.data(), b.values.data());
    return b;
  }
};

inline Eigen::VectorXd residualsOf(const ceres::CostFunction& f, const std::vector<Block>& blocks)
{
  std::vector<const double*> pointers;
  for (const auto& b : blocks) pointers.push_back(b.values.data());
  Eigen::VectorXd r(f.num_residuals());
  EXPECT_TRUE(f.Evaluate(pointers.data(), r.data(), nullptr));
  return r;
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/** Derivatives by the steps of a block, as Ceres forms them. */
inline std::vector<Eigen::MatrixXd> jacobiansOf(
    const ceres::CostFunction& f, const std::vector<Block>& blocks)
{
  std::vector<const double*> pointers;
  std::vector<RowMajor> ambient;
  std::vector<double*> out;
  for (const auto& b : blocks)
  {
    pointers.push_back(b.values.data());
    ambient.emplace_back(RowMajor::Zero(f.num_residuals(), static_cast<int>(b.values.size())));
  }
  for (auto& J : ambient) out.push_back(J.data());
  Eigen::VectorXd r(f.num_residuals());
  EXPECT_TRUE(f.Evaluate(pointers.data(), r.data(), out.data()));
  std::vector<Eigen::MatrixXd> result;
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    RowMajor plus = RowMajor::Identity(ambient[i].cols(), blocks[i].steps());
    if (blocks[i].manifold) blocks[i].manifold->PlusJacobian(blocks[i].values.data(), plus.data());
    result.emplace_back(ambient[i] * plus);
  }
  return result;
}

/** Compares all derivatives with central differences. */
inline void expectRightDerivatives(const ceres::CostFunction& f, const std::vector<Block>& blocks)
{
  const auto analytic = jacobiansOf(f, blocks);
  constexpr double h = 1e-6;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (int c = 0; c < blocks[i].steps(); ++c)
    {
      auto plus = blocks, minus = blocks;
      plus[i] = blocks[i].moved(c, h);
      minus[i] = blocks[i].moved(c, -h);
      const Eigen::VectorXd numeric = (residualsOf(f, plus) - residualsOf(f, minus)) / (2 * h);
      const Eigen::VectorXd off = analytic[i].col(c) - numeric;
      EXPECT_LT(off.norm(), 1e-5 * (1 + numeric.norm()))
          << "block " << i << ", step " << c << "\nanalytic " << analytic[i].col(c).transpose()
          << "\nnumeric  " << numeric.transpose();
    }
}

inline const ceres::Manifold* poseSpace()
{
  static const auto manifold = poseManifold();
  return manifold.get();
}

inline Block poseBlock(const mrpt::poses::CPose3D& pose)
{
  const PoseBlock b = poseBlockOf(pose);
  return {
      {b.begin(), b.end()},
      poseSpace()
  };
}

inline Block objectBlock(const Ellipsoid& object, ObjectFreedom freedom)
{
  static const auto manifold = objectManifold(ObjectFreedom::Free);
  const ObjectBlock b = objectBlockOf(object, freedom);
  return {
      {b.begin(), b.begin() + blockSize(freedom)},
      freedom == ObjectFreedom::Free ? manifold.get() : nullptr
  };
}

}  // namespace quadmap::testing
