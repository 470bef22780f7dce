#pragma once

#include <optional>

namespace quadmap
{
/** Carries times of a camera's clock to wall time.
 *
 * An image arrives some time after it was taken: rarely early, often late. So the wall time of an
 * image is the time of the camera's clock plus the least delay of the latest images. The delay may
 * grow by kDrift, as the clocks differ in speed, and shrinks by kSlew at most, so that the time
 * between two images stays within 10 % of what the camera says. Delays that jump by more than a
 * second tell of a wall clock that was set, and are not believed. A camera that starts its clock
 * anew is followed. */
class DeviceClock
{
 public:
  static constexpr double kDrift = 2e-4, kSlew = 0.1;  //!< [s/s]

  /** \param device Time of the image by the camera's clock [s].
   *  \param arrival Wall time when it arrived [s].
   *  \return Wall time of the image [s], later than the one before. */
  double wallTime(double device, double arrival);

 private:
  struct Last
  {
    double device = 0, offset = 0, wall = 0;
  };
  std::optional<Last> last_;
};

}  // namespace quadmap
