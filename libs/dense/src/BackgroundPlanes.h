#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

namespace quadmap
{
/** A point near an object, for the planes behind it. */
struct NearPoint
{
  Eigen::Vector3d position;  //!< In the map [m]
  Eigen::Vector3d normal;    //!< Unit, to where it was seen from
  double weight = 0;         //!< How much was measured there, > 0
  double share = 0;          //!< Of the object's boxes that it lies in, in [0, 1]
};

/** What an object stands on or at: n x = d, the object where n x > d. */
struct BackgroundPlane
{
  Eigen::Vector3d normal;  //!< Unit
  double distance = 0;     //!< d [m]
  double spread = 0;       //!< Standard deviation of its points along the normal [m]

  double height(const Eigen::Vector3d& p) const { return normal.dot(p) - distance; }
};

/** The horizontal surface that an object stands on: the highest one of those that go on around the
 * points in its boxes, and of which these do not reach far below.
 * \param near All points about the object.
 * \param candidates Those of them in its boxes. */
std::optional<BackgroundPlane> supportOf(
    const std::vector<NearPoint>& near, const std::vector<NearPoint>& candidates);

/** The vertical surfaces that go on outside the boxes, with all candidates in front of them. */
std::vector<BackgroundPlane> wallsOf(
    const std::vector<NearPoint>& near, const std::vector<NearPoint>& candidates);

}  // namespace quadmap
