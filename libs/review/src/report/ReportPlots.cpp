#include "ReportPlots.h"

#include <algorithm>

#include "quadmap/base/SvgPlot.h"
#include "quadmap/evaluation/TrajectoryAlignment.h"
#include "quadmap/geometry/ConvexHull.h"
#include "quadmap/geometry/PosePosition.h"

namespace quadmap
{
namespace
{
using Points = std::vector<Eigen::Vector2d>;

// Colours that show on light and dark pages alike.
const SvgPlot::Style kBefore{"#8a8a8a", 1.5, true, 0}, kAfter{"#2b7de0", 1.5, false, 0},
    kTruth{"#2ca02c", 1.5, false, 0}, kObject{"#d07a00", 1.0, false, 0.15};

constexpr std::size_t kMostPoints = 1000;  // of a line, as more cannot be told apart

Points thinned(const Points& points)
{
  const std::size_t step = points.size() / kMostPoints + 1;
  Points kept;
  for (std::size_t i = 0; i < points.size(); i += step) kept.push_back(points[i]);
  return kept;
}

Points fromAbove(const Trajectory& trajectory)
{
  Points points;
  for (const StampedPose& stamped : trajectory)
    points.push_back(positionOf(stamped.pose).head<2>());
  return thinned(points);
}

Points fromAbove(const Ellipsoid& object)
{
  const Eigen::Matrix<double, 3, 8> corners = object.cuboidCorners();
  Points below;
  for (Eigen::Index i = 0; i < corners.cols(); ++i) below.emplace_back(corners.col(i).head<2>());
  return convexHull(below);
}

/** The true trajectory as it lies in the map. */
Trajectory inMap(const ReportTruth& truth)
{
  Trajectory moved = *truth.trajectory;
  const mrpt::poses::CPose3D T_map_truth = -truth.figures.T_truth_estimated;
  for (StampedPose& stamped : moved) stamped.pose = T_map_truth + stamped.pose;
  return moved;
}

/** Distances of the positions of pairs over time since `start`.
 * \param isAligned The estimated positions are carried to the true ones before. */
Points distances(const std::vector<PosePair>& pairs, bool isAligned, double start)
{
  if (pairs.empty()) return {};
  const mrpt::poses::CPose3D T = isAligned ? alignPositions(pairs) : mrpt::poses::CPose3D();
  Points points;
  for (const PosePair& pair : pairs)
    points.emplace_back(
        pair.time - start,
        (positionOf(pair.T_truth_body) - positionOf(T + pair.T_estimated_body)).norm());
  return thinned(points);
}

}  // namespace

std::string trackPlot(const ReportTracks& tracks)
{
  SvgPlot plot({"Seen from above", "x [m]", "y [m]"}, true);
  for (const ObjectRecord& object : tracks.objects)
    plot.addArea(fromAbove(object.object), kObject, "objects");
  if (tracks.truth && tracks.truth->trajectory)
    plot.addLine(fromAbove(inMap(*tracks.truth)), kTruth, "truth");
  plot.addLine(fromAbove(tracks.odometry), kBefore, "before (odometry)");
  plot.addLine(fromAbove(tracks.corrected), kAfter, "after");
  for (const ObjectRecord& object : tracks.objects)
    plot.addText(object.object.center().head<2>(), object.label + " " + object.id);
  return plot.toSvg();
}

std::string errorPlot(const ReportTracks& tracks)
{
  if (tracks.corrected.empty()) return "";
  const double start = tracks.corrected.front().time;
  if (tracks.truth && tracks.truth->trajectory)
  {
    const ReportTruth& truth = *tracks.truth;
    const auto errors = [&](const Trajectory& estimated)
    {
      return distances(
          pairByTime(*truth.trajectory, estimated, truth.maxTimeDifference), !truth.inPlace, start);
    };
    SvgPlot plot({"Error of the positions", "time [s]", "error [m]"});
    plot.addLine(errors(tracks.odometry), kBefore, "before (odometry)");
    plot.addLine(errors(tracks.corrected), kAfter, "after");
    return plot.toSvg();
  }
  const Points moved = distances(pairByTime(tracks.odometry, tracks.corrected), false, start);
  if (moved.empty()) return "";
  SvgPlot plot({"How far the correction moved positions", "time [s]", "moved [m]"});
  plot.addLine(moved, kAfter, "after to before");
  return plot.toSvg();
}

}  // namespace quadmap
