#pragma once

#include <Eigen/Dense>
#include <limits>
#include <string>
#include <vector>

#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/simulator/Primitive.h"
#include "quadmap/simulator/SimulatorOptions.h"

namespace quadmap::simulator
{
enum class Pattern
{
  Mottled,  //!< Clouds of several sizes
  Checker,  //!< Tiles, each with its own shade
  Stripes   //!< Grain or planks along x
};

/** How a surface looks to the colour camera, and whether the depth camera sees it. */
struct Material
{
  std::string name;
  Eigen::Vector3d color = Eigen::Vector3d(128, 128, 128);  //!< R, G, B in [0, 255]
  Pattern pattern = Pattern::Mottled;
  double scale = 0.1;     //!< Size of the pattern's cells [m], > 0
  double contrast = 0.2;  //!< Relative change of brightness, in [0, 1]
  bool depth = true;      //!< False for screens, glass and the like
};

/** Where something that walks is at one time. */
struct WayPoint
{
  double time;                       //!< [s since the start]
  mrpt::poses::CPose3D T_world_obj;  //!< Upright
};

/** One piece of furniture, upright and made of primitives. Its parts are given in its frame `obj`,
 * whose z = 0 is usually where it stands. */
struct SceneObject
{
  std::string name;   //!< Name in the scene file
  std::string label;  //!< Empty for furniture that only occludes: no detector knows it
  mrpt::poses::CPose3D T_world_obj;
  /** The object stands there while from <= time < to [s since the start]. A piece that is moved is
   * in the scene several times. */
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
  bool orientationDefined = true;
  std::vector<Primitive> parts;  //!< Never empty
  /** Of what walks: it goes straight and evenly from one point to the next, in the order of time.
   * It has no place on a map. Empty for all that stays. */
  std::vector<WayPoint> way;

  bool standsAt(double time) const { return from <= time && time < to; }

  /** T_world_obj at a time. */
  mrpt::poses::CPose3D poseAt(double time) const;

  /** The tight cuboid of all parts along the axes of `obj`, at its T_world_obj. */
  Ellipsoid truth() const;
};

/** The room. Its walls stand at x = +-size.x / 2 and y = +-size.y / 2, and its floor is z = 0. */
struct Room
{
  Eigen::Vector3d size = Eigen::Vector3d(6, 5, 2.6);  //!< [m]
  std::size_t floor = 0, walls = 0, ceiling = 0;      //!< Indices into Scene::materials
};

/** Where the camera is (eye) and where it looks (target) at one point of its way, in the world [m].
 * A robot that drives and looks where it goes has its target at its eye. */
struct Waypoint
{
  Eigen::Vector3d eye, target;
};

/** A simulated room. The world is z-up, with its origin on the floor in the middle of the room. */
struct Scene
{
  Room room;
  std::vector<Material> materials;
  std::vector<SceneObject> objects;  //!< In the order of their names
  std::vector<Waypoint> waypoints;   //!< At least four for a walk, otherwise two
  SimulatorOptions options;          //!< What the file says about the simulation
};

/** Reads a scene file, whose sections and keys are in doc/guide/write-a-scene.md.
 * \exception std::runtime_error For a file that cannot be read or a value that makes no sense. The
 * message names file, section and key. */
Scene readScene(const std::string& path);

/** The file of a scene: `nameOrPath` itself when it is a path (has a '/' or ends in ".ini"), else
 * scenes/NAME.ini of the installed data. \exception std::runtime_error If there is none. */
std::string findScene(const std::string& nameOrPath);

}  // namespace quadmap::simulator
