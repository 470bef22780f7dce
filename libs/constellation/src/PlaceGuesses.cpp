#include "PlaceGuesses.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace quadmap
{
namespace
{
class PlaceGuesses
{
 public:
  PlaceGuesses(const Constellations& both, const ConstellationOptions& options) :
      both_(both), options_(options)
  {
    const std::size_t n = both.local.size();
    const std::size_t pairs = std::max<std::size_t>(1, n * (n - 1) / 2);
    share_ = std::max<std::size_t>(1, kMaxPairsOfPairs / pairs);
  }

  std::vector<Place> all()
  {
    for (std::size_t i = 0; i < both_.local.size(); ++i)
    {
      for (const std::size_t j : both_.alike[i])
        if (both_.bothHaveHeadings(i, j)) addByHeading(i, j);
      for (std::size_t i2 = i + 1; i2 < both_.local.size(); ++i2) addByTwo(i, i2);
    }
    return std::move(places_);
  }

 private:
  void addByHeading(std::size_t i, std::size_t j)
  {
    const MapObject &local = *both_.local[i], &known = *both_.map[j];
    for (int turn = 0; turn < 4; ++turn)
    {
      Place place;
      place.yaw = mrpt::math::wrapToPi(yawOf(known) - yawOf(local) + turn * M_PI / 2);
      place.t = known.object.center() - place.R() * local.object.center();
      places_.push_back(place);
    }
  }

  void addByTwo(std::size_t i1, std::size_t i2)
  {
    const auto &alike1 = both_.alike[i1], &alike2 = both_.alike[i2];
    const std::size_t pairs = alike1.size() * alike2.size();
    const std::size_t stride = std::max<std::size_t>(1, (pairs + share_ - 1) / share_);
    // Each time the search starts with another object of the map, so that all have a share.
    for (std::size_t k = (i1 + i2) % stride; k < pairs; k += stride)
    {
      const std::size_t j1 = alike1[k / alike2.size()], j2 = alike2[k % alike2.size()];
      if (j1 == j2) continue;
      if (const auto place = placeOfTwo(i1, i2, j1, j2)) places_.push_back(*place);
    }
  }

  /** Mean over the horizontal directions, of an object of both [m^2]. */
  double variance(std::size_t i, std::size_t j) const
  {
    const auto sum = [](const MapObject& o) { return o.covariance(0, 0) + o.covariance(1, 1); };
    return (sum(*both_.local[i]) + sum(*both_.map[j])) / 2 +
           options_.positionSigma * options_.positionSigma;
  }

  /** Where two local objects are two of the map, or nothing when their distances differ. */
  std::optional<Place> placeOfTwo(
      std::size_t i1, std::size_t i2, std::size_t j1, std::size_t j2) const
  {
    const Eigen::Vector3d a1 = both_.local[i1]->object.center(),
                          a2 = both_.local[i2]->object.center();
    const Eigen::Vector3d b1 = both_.map[j1]->object.center(), b2 = both_.map[j2]->object.center();
    const Eigen::Vector2d a = (a2 - a1).head<2>(), b = (b2 - b1).head<2>();
    const double sigma = std::sqrt(variance(i1, j1) + variance(i2, j2));
    if (std::abs(a.norm() - b.norm()) > 3 * sigma) return std::nullopt;
    if (std::min(a.norm(), b.norm()) < 3 * sigma)
      return std::nullopt;  // the direction is not known
    Place place;
    place.yaw = mrpt::math::wrapToPi(std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()));
    place.t = (b1 + b2) / 2 - place.R() * (a1 + a2) / 2;
    return place;
  }

  const Constellations& both_;
  const ConstellationOptions& options_;
  std::size_t share_;  //!< Of each two local objects, in pairs of the map
  std::vector<Place> places_;
};

}  // namespace

double yawOf(const MapObject& object) { return uprightStateOf(object.object)[3]; }

std::vector<Place> guessPlaces(const Constellations& both, const ConstellationOptions& options)
{
  return PlaceGuesses(both, options).all();
}

}  // namespace quadmap
