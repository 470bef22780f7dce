#pragma once

#include <map>
#include <optional>

#include "Floor.h"
#include "FurnitureKit.h"

namespace quadmap::simulator
{
/** A place at a wall: x = 0 is the wall's surface, and +x leads into the room. */
struct WallPlace
{
  mrpt::poses::CPose3D T_world_place;
  double length = 0;  //!< Of the wall [m]
};

/** A room that is being furnished. What is put into it never overlaps what is there. */
class RoomBuilder
{
 public:
  RoomBuilder(Scene& scene, FurnitureKit& kit) : scene_(scene), kit_(kit) {}

  /** Puts an object where its pose says. \param freeInFront Depth of the floor before its +x side
   * that must be, and will be kept, free [m]. \return Its index, or nothing if there is no room. */
  std::optional<std::size_t> put(SceneObject object, double freeInFront = 0);

  /** Tries some places with the back to a wall. \param lift Height of z = 0 above the floor [m].
   * \param gap Between the back and the wall [m]. */
  std::optional<std::size_t> putAtWall(
      const SceneObject& object, double freeInFront, double lift = 0, double gap = 0.015);

  /** Tries some places away from the walls. \param around Floor around it to keep free [m]. */
  std::optional<std::size_t> putInTheMiddle(const SceneObject& object, double around);

  /** Tries some places anywhere on the floor. */
  std::optional<std::size_t> putOnTheFloor(const SceneObject& object);

  /** Tries some places on a shelf of a piece that stands. \param yaw Of the thing, relative to the
   * piece, or any [rad]. */
  std::optional<std::size_t> putOnShelf(
      const SceneObject& thing,
      std::size_t piece,
      const Shelf& shelf,
      std::optional<double> yaw = std::nullopt);

  /** Puts an object at a pose given in the frame of a piece that stands. */
  std::optional<std::size_t> putBeside(
      SceneObject object, std::size_t piece, const mrpt::poses::CPose3D& T_piece_obj);

  /** Makes the parts of an object from one on a thing of its own, which no detector knows. */
  void detach(std::size_t index, std::size_t firstPart);

  WallPlace placeAtWall(std::size_t wall, double along) const;

  const SceneObject& object(std::size_t index) const { return scene_.objects[index]; }
  Scene& scene() { return scene_; }
  FurnitureKit& kit() { return kit_; }

  void keepFree(const UprightBox& floor) { free_.push_back(floor); }

 private:
  void add(SceneObject object);
  bool fits(const SceneObject& object) const;

  Scene& scene_;
  FurnitureKit& kit_;
  std::vector<UprightBox> free_;  // where nothing may stand
  std::map<std::string, int> count_;
};

}  // namespace quadmap::simulator
