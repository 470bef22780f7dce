#pragma once

#include <algorithm>
#include <stdexcept>
#include <tuple>
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

  /** When the map ends, how many measurements it is of, and how sure it is of its objects: of two
   * maps the newer one has more of the first that differs. */
  std::tuple<mrpt::Clock::time_point, unsigned, double> age() const
  {
    mrpt::Clock::time_point end;
    unsigned measurements = 0;
    double logOdds = 0;
    for (const Object& o : objects)
    {
      end = std::max(end, o.object.lastSeen);
      measurements += o.object.observations();
      logOdds += o.object.logOdds();
    }
    return {end, measurements, logOdds};
  }
};

}  // namespace quadmap
