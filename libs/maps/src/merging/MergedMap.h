#pragma once

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "quadmap/estimation/MapObject.h"
#include "quadmap/maps/ObjectEstimator.h"

namespace quadmap
{
/** One of two maps, as far as merging needs it. */
struct MergedMap
{
  struct Object
  {
    MapObject object;
    InformationPrior known;  //!< What its measurements say, without the label's prior
  };
  std::vector<Object> objects;

  std::vector<const MapObject*> confirmed() const
  {
    std::vector<const MapObject*> confirmed;
    for (const Object& o : objects)
      if (o.object.confirmed) confirmed.push_back(&o.object);
    return confirmed;
  }

  /** \exception std::out_of_range If there is no such object. */
  const Object& at(ObjectId id) const
  {
    for (const Object& o : objects)
      if (o.object.id == id) return o;
    throw std::out_of_range("no such object");
  }

  /** When the map ends, and how many measurements it is of. */
  std::pair<mrpt::Clock::time_point, unsigned> age() const
  {
    std::pair<mrpt::Clock::time_point, unsigned> age;
    for (const Object& o : objects)
    {
      age.first = std::max(age.first, o.object.lastSeen);
      age.second += o.object.observations();
    }
    return age;
  }
};

}  // namespace quadmap
