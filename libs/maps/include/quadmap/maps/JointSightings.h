#pragma once

#include <map>
#include <set>

#include "quadmap/estimation/MapObject.h"

namespace quadmap
{
/** How often two objects had a box each in one image. One thing has one box in an image, so that
 * two that often have one each are two things, however much their cuboids overlap. */
class JointSightings
{
 public:
  /** \param seen All objects that have a box in one image. */
  void add(const std::set<ObjectId>& seen);

  /** Pairs of boxes, one of each object, in the same image. */
  unsigned pairs(ObjectId a, ObjectId b) const;

  /** Do images tell that two objects are two, doc/mathematics.md, (13.6)?
   * \param maxShare Of the boxes of one thing, those beside another of its boxes, in [0, 1]. */
  bool showTwoThings(const MapObject& a, const MapObject& b, double maxShare) const;

  /** What was seen with the absorbed object was seen with the kept one. */
  void merge(ObjectId kept, ObjectId absorbed);

  void remove(ObjectId id);
  void clear();

 private:
  unsigned pairsWithMerged(ObjectId id) const;

  std::map<ObjectId, std::map<ObjectId, unsigned>> pairs_;  // of both objects, to each other
  /** Of each object, the pairs that it had with what was merged into it. */
  std::map<ObjectId, unsigned> pairsWithMerged_;
};

}  // namespace quadmap
