#pragma once

#include <cstdint>
#include <random>

namespace quadmap::simulator
{
/** What a random stream is for. Streams of different purposes share no numbers. */
enum class Purpose : std::uint64_t
{
  Depth = 1,
  Color,
  Detector,
  Odometry,
  Mask,
  Room,
  View
};

/** Random numbers that depend on nothing but (random seed, purpose, frame). Frames may therefore be
 * made in any order and on any number of threads. The distributions are our own, because those of
 * `random` differ between standard libraries. */
class RandomStream
{
 public:
  RandomStream(std::uint64_t seed, Purpose purpose, std::uint64_t frame);

  double uniform();                        //!< In [0, 1)
  double uniform(double min, double max);  //!< In [min, max)
  double gaussian();                       //!< Mean 0, standard deviation 1
  std::uint64_t below(std::uint64_t n);    //!< In {0, ..., n-1}; n > 0

 private:
  std::mt19937_64 engine_;
  double spare_ = 0;  // the second number of the last Box-Muller pair
  bool hasSpare_ = false;
};

}  // namespace quadmap::simulator
