#pragma once

#include "quadmap/constellation/ConstellationOptions.h"

namespace quadmap
{
/** How a run finds itself in an existing object map. Section [relocalization]. */
struct RelocalizationOptions : public ConstellationOptions
{
  /** How far the sides of a known object are from where the map has them, beyond its covariance:
   * drift of the run that made it, sides that only one of them saw [m], > 0. So tightly do known
   * objects hold the poses */
  double mapSigma = 0.01;

 private:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
