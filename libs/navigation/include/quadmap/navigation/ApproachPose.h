#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/base/OptionGroup.h"
#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
/** What a robot on the floor is, and how near it goes to things: doc/mathematics.md, section 23. */
struct DrivingOptions : public OptionGroup
{
  double robotRadius = 0.25;  //!< Of a circle around the robot [m], > 0
  double robotHeight = 1.2;   //!< What is higher above the floor is no obstacle [m], > 0
  double gap = 0.15;          //!< Left between the robot and the object [m], >= 0
  double farthest = 1.5;      //!< Most that is left when nothing nearer is free [m], > gap
  double minFree = 0.55;      //!< Cells of the grid that are free with this probability, (0, 1)
  /** Labels of what is approached from its long sides; no key of the INI file. What has a level top
   * is approached from all sides, everything else from its front. */
  std::vector<std::string> longSideLabels = {"bed"};

 private:
  void describe(OptionList& list) override;
};

/** A place to stand before an object. */
struct ApproachPose
{
  mrpt::math::TPose2D pose;  //!< In the map [m, rad]; the robot faces the object
  bool isUsualSide = true;   //!< False: nothing was free where people use the object
  double way = 0;            //!< Length of the shortest way from the robot in the grid [m]
};

/** A free pose before an object, at the side people use: the front of a chair or a screen, a long
 * side of a bed, any side of a table; a chair that is drawn up to a table is come to from beside or
 * behind. Of several it is the one with the shortest way, and when
 * none of them is free it is one at another side. The robot can drive there: a way through free
 * cells leads there from where it is.
 *
 * Objects are obstacles only as the grid shows them: footprintInto() writes them into it.
 * \param robot Where the robot is now, in the map. It may stand near an obstacle.
 * \param grid Of the same frame as the map; unknown cells are not free.
 * \return Nothing when no place is free and can be reached.
 * \exception std::out_of_range If there is no such object. */
std::optional<ApproachPose> approachPose(
    const CQuadricObjectMap& map,
    ObjectId object,
    const mrpt::math::TPose2D& robot,
    const mrpt::maps::COccupancyGridMap2D& grid,
    const DrivingOptions& options = {});

/** Marks the cells that the outlines of the confirmed objects touch as occupied, those of objects
 * aside that hang above the robot. The floor is the lowest end of all of them. The grid keeps its
 * size. \return Number of cells that were written. */
std::size_t footprintInto(
    const CQuadricObjectMap& map,
    mrpt::maps::COccupancyGridMap2D& grid,
    const DrivingOptions& options = {});

}  // namespace quadmap
