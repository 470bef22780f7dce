#include "quadmap/simulator/RandomStream.h"

#include <cmath>

namespace quadmap::simulator
{
namespace
{
/** The finaliser of SplitMix64. It spreads every bit of x over all bits of the result. */
std::uint64_t mixed(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, Purpose purpose, std::uint64_t frame) :
    engine_(mixed(mixed(mixed(seed) ^ static_cast<std::uint64_t>(purpose)) ^ frame))
{
}

double RandomStream::uniform()
{
  return static_cast<double>(engine_() >> 11) * 0x1p-53;  // 53 bits, exactly representable
}

double RandomStream::uniform(double min, double max) { return min + (max - min) * uniform(); }

double RandomStream::gaussian()
{
  if (hasSpare_)
  {
    hasSpare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));  // 1 - u is never 0
  const double angle = 2.0 * M_PI * uniform();
  spare_ = radius * std::sin(angle);
  hasSpare_ = true;
  return radius * std::cos(angle);
}

std::uint64_t RandomStream::below(std::uint64_t n)
{
  return static_cast<std::uint64_t>(uniform() * static_cast<double>(n));
}

}  // namespace quadmap::simulator
