#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

namespace quadmap
{
/** What PCL does for the clouds. Without it each function throws as requirePcl() does. The results
 * do not depend on the number of threads. */
namespace pointOperations
{
using Points = std::vector<Eigen::Vector3f>;  //!< [m]

/** The indices of the points that are no outliers, ascending. An outlier is farther from its
 * neighbours, on average, than all points are from theirs, by more than so many standard
 * deviations. Of fewer than three points all are kept. */
std::vector<std::size_t> withoutOutliers(
    const Points& points, int neighbours, double standardDeviations);

struct SurfaceNormal
{
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  //!< Unit; zero where there are too few points
  float curvature = 0;  //!< Smallest eigenvalue of the neighbours' covariance / sum of all three
};

/** The normals of the planes through each point's neighbours, of either sign. */
std::vector<SurfaceNormal> surfaceNormals(const Points& points, int neighbours);

/** The parts of a cloud: any two points of a part are joined by steps of at most `distance` [m].
 * Each part has its indices ascending; the largest part is first. */
std::vector<std::vector<std::size_t>> connectedParts(const Points& points, double distance);

/** The points moved onto the surface they scatter about: along the normal of the plane through all
 * points within `radius` [m], onto that plane. \param weights Of the points, > 0. */
Points ontoSurface(const Points& points, const std::vector<float>& weights, double radius);

}  // namespace pointOperations
}  // namespace quadmap
