#include "quadmap/dense/DenseOptions.h"

#include <mrpt/config/CConfigFile.h>

#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/OptionList.h"

namespace quadmap
{
void DenseOptions::describe(OptionList& list)
{
  list.about(
      "Dense clouds of rooms and objects: quadmap-export, quadmap-evaluate and quadmap-annotate.");
  list.number(
      "roomCell", roomCell, {0.001, 1}, "m", "Edge of the cubes that keep one point of the room.");
  list.number(
      "objectCell", objectCell, {0.001, 0.1}, "m", "The same for the points of the objects.");
  list.number("maxRange", maxRange, {0.5, 20}, "m", "Depth beyond this is ignored as noisy.");
  list.integer(
      "maxKeyframes", maxKeyframes, {1, 100000}, "",
      "Most keyframes that are read, spread evenly over the run.");
  list.integer("minHits", minHits, {1, 1000}, "", "Fewest pixels that saw a point.");
  list.number(
      "minWeightShare", minWeightShare, {0, 0.99}, "",
      "A point has at least this share of the weight (the inverse of the variance of its depths) "
      "of "
      "the heaviest one in the cubes around its own.");
  list.integer(
      "outlierNeighbours", outlierNeighbours, {2, 1000}, "",
      "A point is compared with so many around it.");
  list.number(
      "outlierDeviations", outlierDeviations, {0.1, 100}, "",
      "A point is dropped when it is farther from them than the mean of all points plus so many "
      "standard deviations.");
  list.integer(
      "normalNeighbours", normalNeighbours, {3, 1000}, "",
      "The normal of a point is that of the plane through so many points around it.");
  list.number(
      "boxShare", boxShare, {0.5, 1}, "",
      "The points of an object lie within at least this share of its boxes.");
  list.number(
      "clearance", clearance, {0, 0.2}, "m",
      "Points nearer to what the object stands on or at belong to that.");
  list.number(
      "growDistance", growDistance, {0.002, 1}, "m",
      "Largest gap between the points of one part of an object.");
  list.number(
      "smoothingRadius", smoothingRadius, {0.001, 0.2}, "m",
      "The points of an object move onto the plane of those within this distance.");
  list.number(
      "surfaceTolerance", surfaceTolerance, {0.001, 1}, "m",
      "Points so near to the surface of an object count as on it; so far behind it a ray went "
      "through.");
}

DenseOptions readDenseOptions(const std::string& path)
{
  requireReadableIni(path);
  const mrpt::config::CConfigFile config(path);
  if (!config.sectionExists("dense"))
    throw std::invalid_argument(path + ": has no section [dense]");
  DenseOptions options;
  try
  {
    options.loadFromConfigFile(config, "dense");
  }
  catch (const std::invalid_argument& e)
  {
    throw std::invalid_argument(path + ": " + e.what());
  }
  return options;
}

}  // namespace quadmap
