#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "quadmap/simulator/RandomStream.h"
#include "quadmap/simulator/Scene.h"

namespace quadmap::simulator
{
/** A level place that things may stand on, in the frame of the furniture that has it. */
struct Shelf
{
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  //!< [m]
  Eigen::Vector2d half = Eigen::Vector2d::Zero();    //!< Half of its sizes along x and y [m]
  double z = 0;                                      //!< Height of its surface [m]
  double headroom = 0;                               //!< Free height above it [m]
};

/** A piece of furniture that faces +x and stands on z = 0, and what can be put on or under it. */
struct Furniture
{
  SceneObject object;
  std::vector<Shelf> shelves;
};

/** Draws numbers and materials for the furniture of one room, and counts its names. No two draws
 * may be arguments of one call or sides of one operator, which compilers evaluate in an order of
 * their own: the room of a seed would depend on it. In braces they come from left to right. */
class FurnitureKit
{
 public:
  /** Both must outlive the kit, which adds to the materials. */
  FurnitureKit(RandomStream& random, std::vector<Material>& materials) :
      random_(random), materials_(materials)
  {
  }

  double between(double min, double max) { return random_.uniform(min, max); }
  double gaussian(double sigma) { return sigma * random_.gaussian(); }
  bool chance(double share) { return random_.uniform() < share; }
  std::size_t pick(std::size_t n) { return static_cast<std::size_t>(random_.below(n)); }
  int whole(int min, int max)
  {
    return min + static_cast<int>(pick(static_cast<std::size_t>(max - min + 1)));
  }

  /** \name Each call makes another material, an index into Scene::materials. */
  /** @{ */
  std::size_t wood();
  std::size_t lacquer();  //!< Painted boards, mostly light
  std::size_t cloth();
  std::size_t metal();
  std::size_t darkPlastic();  //!< Infrared light hardly comes back
  std::size_t ceramic();
  std::size_t leaves();
  std::size_t paper();
  std::size_t cover();  //!< Bright: books, suitcases, boxes
  std::size_t skin();
  std::size_t printed();  //!< Pictures
  std::size_t screen();   //!< Gives no depth, unless it is matt
  std::size_t glass();
  std::size_t wallpaper();
  std::size_t floor();
  std::size_t ceiling();
  /** @} */

 private:
  std::size_t add(Material material);
  Eigen::Vector3d colorBetween(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  Eigen::Vector3d near(const Eigen::Vector3d& color, double spread);

  RandomStream& random_;
  std::vector<Material>& materials_;
};

/** \name Numbers that the text of a scene holds exactly, and that people can read. */
/** @{ */
double inMillimetres(double metres);
double inTenthsOfDegrees(double radians);
/** @} */

/** A labelled object without parts. \param label Empty for what no detector knows. */
SceneObject objectOf(const std::string& label, bool orientationDefined = true);

/** \name Add a part to an object. Center and full size in its frame [m]; angles in radians. */
/** @{ */
void addBox(
    SceneObject& object,
    const Eigen::Vector3d& center,
    const Eigen::Vector3d& size,
    std::size_t material,
    double yaw = 0,
    double pitch = 0);
void addCylinder(
    SceneObject& object,
    const Eigen::Vector3d& center,
    const Eigen::Vector3d& size,
    std::size_t material);
void addEllipsoid(
    SceneObject& object,
    const Eigen::Vector3d& center,
    const Eigen::Vector3d& size,
    std::size_t material,
    double yaw = 0,
    double pitch = 0);
/** Four legs, from the floor up to `height`. \param reach x and y of their centres [m]. */
void addLegs(
    SceneObject& object,
    const Eigen::Vector2d& reach,
    double height,
    double thickness,
    bool round,
    std::size_t material);
/** @} */

}  // namespace quadmap::simulator
