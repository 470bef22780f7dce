#pragma once

#include <Eigen/Dense>
#include <limits>
#include <string>
#include <vector>

#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/sensors/simulator/Primitive.h"
#include "quadmap/sensors/simulator/SimulatorOptions.h"

namespace quadmap::simulator
{
enum class Pattern
{
  Mottled,  //!< Clouds of several sizes
  Checker,  //!< Tiles, each with its own shade
  Stripes   //!< Grain or planks along x
};

/** How a surface looks to the colour camera and whether the depth camera sees it. */
struct Material
{
  std::string name;
  Eigen::Vector3d color = Eigen::Vector3d(128, 128, 128);  //!< R, G, B in [0, 255]
  Pattern pattern = Pattern::Mottled;
  double scale = 0.1;     //!< Size of the pattern's cells [m], > 0
  double contrast = 0.2;  //!< Relative change of brightness, in [0, 1]
  bool depth = true;      //!< False: screens, glass and the like return no depth
};

/** One piece of furniture: upright, made of primitives. Frame `obj` is the frame its parts are
 * given in (for furniture, z = 0 is usually where it stands). */
struct SceneObject
{
  std::string name;   //!< In the scene file
  std::string label;  //!< Empty: furniture that no detector knows; it occludes, and has no truth
  mrpt::poses::CPose3D T_world_obj;
  /** It stands there while from <= time < to [s since the start]. Furniture that is moved is in the
   * scene several times. */
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
  bool orientationDefined = true;
  std::vector<Primitive> parts;  //!< Never empty

  bool standsAt(double time) const { return from <= time && time < to; }

  /** The tight cuboid of all parts along the axes of `obj`. */
  Ellipsoid truth() const;
};

/** The walls stand at x = +-size.x / 2 and y = +-size.y / 2, the floor at z = 0. */
struct Room
{
  Eigen::Vector3d size = Eigen::Vector3d(6, 5, 2.6);  //!< [m]
  std::size_t floor = 0, walls = 0, ceiling = 0;      //!< Indices into Scene::materials
};

/** The view the robot takes at one point of its way, in the world [m]. A robot that drives and may
 * look where it goes has its target at its eye. */
struct Waypoint
{
  Eigen::Vector3d eye, target;
};

/** World: z up, origin on the floor in the middle of the room. */
struct Scene
{
  Room room;
  std::vector<Material> materials;
  std::vector<SceneObject> objects;  //!< In the order of their names
  std::vector<Waypoint> waypoints;   //!< At least four of a walk, else two
  SimulatorOptions options;          //!< What the file says about the simulation
};

/** Reads a scene file; doc/guide/write-a-scene.md tells its sections and keys.
 * \exception std::runtime_error On a file that cannot be read or a value that makes no sense; the
 * message names file, section and key. */
Scene readScene(const std::string& path);

/** The file of a scene: `nameOrPath` itself when it is a path (has a '/' or ends in ".ini"), else
 * scenes/NAME.ini of the installed data. \exception std::runtime_error If there is none. */
std::string findScene(const std::string& nameOrPath);

}  // namespace quadmap::simulator
