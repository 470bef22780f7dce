#pragma once

#include <map>
#include <set>
#include <utility>

#include "quadmap/estimation/MapObject.h"

namespace quadmap
{
/** In how many images two objects had a box each. One thing has one box in an image, so that two
 * that often have one each are two things, however much their cuboids overlap. */
class JointSightings
{
 public:
  /** \param seen All objects that have a box in one image. */
  void add(const std::set<ObjectId>& seen);

  /** Number of images in which both had a box. */
  unsigned images(ObjectId a, ObjectId b) const;

  /** Do images tell that two objects are two, doc/mathematics.md, (13.6)?
   * \param maxShare Of the images of one thing, those in which it has two boxes, in [0, 1]. */
  bool areTwo(const MapObject& a, const MapObject& b, double maxShare) const;

  /** What was seen with the absorbed object was seen with the kept one. */
  void merge(ObjectId kept, ObjectId absorbed);

  void remove(ObjectId id);
  void clear();

 private:
  unsigned twice(ObjectId id) const;

  std::map<std::pair<ObjectId, ObjectId>, unsigned> images_;  // the smaller id first
  std::map<ObjectId, unsigned> twice_;  // images in which it had two boxes, one of a merged object
};

}  // namespace quadmap
