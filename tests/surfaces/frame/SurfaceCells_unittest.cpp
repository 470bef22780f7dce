#include "frame/SurfaceCells.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../SyntheticFrame.h"
#include "frame/SurfaceRegions.h"

using namespace quadmap;

namespace
{
constexpr unsigned kPixels = 4;  // per cell of a 640x480 image

/** A cabinet on the floor, with a noise like a depth camera's. */
SyntheticFrame cabinetOnFloor(double noise)
{
  SyntheticFrame frame;
  frame.add(1.8, 0.1, 0, 0.4, {0.5, 0.8, 0.6});
  frame.noise = noise;
  return frame;
}

DepthCloud cloudOf(const SyntheticFrame& frame) { return {frame.scan(), SurfaceOptions()}; }

struct Surroundings
{
  Eigen::Vector3d normal;
  double roughness;
};

/** Of a cell with only valid ones around: smallest eigenvector of the covariance of the points. */
Surroundings byEigenvectors(const SurfaceCells& cells, int column, int row, int width)
{
  Eigen::Matrix3Xd points(3, width * width);
  for (int r = 0; r < width; ++r)
    for (int c = 0; c < width; ++c)
    {
      const int index = (row - width / 2 + r) * cells.columns() + column - width / 2 + c;
      points.col(r * width + c) = cells[static_cast<std::size_t>(index)].point.cast<double>();
    }
  points.colwise() -= Eigen::Vector3d(points.rowwise().mean());
  const Eigen::Matrix3d scatter = points * points.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  return {solver.eigenvectors().col(0), solver.eigenvalues()[0] / scatter.trace()};
}

}  // namespace

TEST(SurfaceCells, AgreeWithTheEigenvectorsOfThePointsAround)
{
  const SyntheticFrame frame = cabinetOnFloor(0.001);
  const SurfaceCells cells(cloudOf(frame));
  int compared = 0;
  double angles = 0, ratios = 0;
  for (int r = 20; r < cells.rows() - 20; r += 3)
    for (int c = 20; c < cells.columns() - 20; c += 3)
    {
      // Where the whole surroundings show one box or the floor, the window is 8 cells wide.
      const unsigned u = kPixels * static_cast<unsigned>(c), v = kPixels * static_cast<unsigned>(r);
      const int what = frame.look(u, v).first;
      bool isInside = what > -2;
      for (unsigned du : {0u, 96u})
        for (unsigned dv : {0u, 96u})
          isInside = isInside && frame.look(u + du - 48, v + dv - 48).first == what;
      const auto& cell = cells[static_cast<std::size_t>(r * cells.columns() + c)];
      if (!isInside || !cell.hasPlane() || cell.point.z() > 3) continue;
      const auto oracle = byEigenvectors(cells, c, r, 8);
      if (oracle.roughness > 0.02) continue;  // across an edge between two faces
      angles += std::acos(std::min(1.0, std::abs(oracle.normal.dot(cell.normal.cast<double>()))));
      ratios += double(cell.roughness) / oracle.roughness;
      ++compared;
    }
  ASSERT_GT(compared, 200);
  // The noise turns either normal by some two degrees; regressions of depth and of distance part
  // by a small share of that, and share their residuals.
  EXPECT_LT(angles / compared, 0.3 * M_PI / 180);
  EXPECT_NEAR(ratios / compared, 1.0, 0.05);
}

TEST(SurfaceCells, AreExactWithoutNoise)
{
  SyntheticFrame frame;
  const SurfaceCells cells(cloudOf(frame));
  const auto T_optical_world = -(frame.T_world_sensor + T_sensor_optical());
  const Eigen::Vector3d up = T_optical_world.getRotationMatrix().asEigen().col(2);
  int planes = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    if (!cells[i].hasPlane()) continue;
    ++planes;
    // Depth comes in steps of 0.1 mm; at 3 m and a grazing angle they turn a window by as much.
    EXPECT_GT(cells[i].normal.cast<double>().dot(up), std::cos(0.01));
    EXPECT_NEAR(cells[i].offset, 1.3, 0.02);
  }
  EXPECT_GT(planes, 8000);
}

TEST(SurfaceCells, HaveNoPlaneBesideAJump)
{
  SyntheticFrame frame;
  frame.add(1.0, 0, 0.8, 0, {0.2, 0.3, 0.3});  // floats well before the floor
  const SurfaceCells cells(cloudOf(frame));
  int beside = 0;
  for (int r = 10; r < cells.rows() - 10; ++r)
    for (int c = 10; c < cells.columns() - 10; ++c)
    {
      const auto seenAt = [&](int dc)
      { return frame.look(kPixels * static_cast<unsigned>(c + dc), kPixels * unsigned(r)).first; };
      if (seenAt(0) == seenAt(1)) continue;
      for (const int dc : {-1, 0, 1, 2})
        EXPECT_FALSE(cells[static_cast<std::size_t>(r * cells.columns() + c + dc)].hasPlane())
            << c << " " << r;
      ++beside;
    }
  EXPECT_GT(beside, 20);
}

TEST(SurfaceRegions, AreTheFacesOfThings)
{
  const SyntheticFrame frame = cabinetOnFloor(0.001);
  const SurfaceCells cells(cloudOf(frame));
  const auto regions = surfaceRegions(cells, 150);
  const auto T_world_optical = frame.T_world_sensor + T_sensor_optical();
  int floors = 0, tops = 0, sides = 0;
  std::size_t last = cells.size();
  for (const auto& region : regions)
  {
    EXPECT_LE(region.cells.size(), last) << "the largest comes first";
    last = region.cells.size();
    const Plane plane = region.plane.transformed(T_world_optical);
    const bool isLevel = plane.n.z() > std::cos(0.02);
    floors += isLevel && std::abs(plane.d) < 0.01 ? 1 : 0;
    tops += isLevel && std::abs(plane.d + 0.6) < 0.01 ? 1 : 0;
    sides += std::abs(plane.n.z()) < 0.02 ? 1 : 0;
    int astray = 0;
    for (const std::size_t i : region.cells)
      astray += std::abs(region.plane.signedDistance(cells[i].point.cast<double>())) > 0.03 ? 1 : 0;
    EXPECT_LT(astray, 0.01 * static_cast<double>(region.cells.size()));
  }
  EXPECT_EQ(floors, 1);
  EXPECT_EQ(tops, 1);
  EXPECT_GE(sides, 1);
  EXPECT_EQ(regions.size(), static_cast<std::size_t>(floors + tops + sides));
}

TEST(SurfaceRegions, AreNotMadeOfTooFewCells)
{
  const SurfaceCells cells(cloudOf(cabinetOnFloor(0.001)));
  const auto all = surfaceRegions(cells, 100);
  ASSERT_GT(all.size(), 1u);
  const auto large = surfaceRegions(cells, all.back().cells.size());
  EXPECT_EQ(large.size(), all.size() - 1);
}
