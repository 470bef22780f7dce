/** The hard case of association: a drifting robot among like things, over many seeds.
 *
 *  benchmark_points [SEEDS [TURN_SIGMA]]   sigma of the odometry's turn per step [rad] */
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "../points/PointWorld.h"

namespace
{
using namespace quadmap;

template <int D>
void table(unsigned seeds, const PointWorldOptions& options, bool visibility)
{
  std::printf(
      "%d-D, %s\nseed detections  drift    ATE  known  ratio  objects  true  right  s\n", D,
      visibility ? "visibility known" : "counts only");
  PointScore all;
  double worst = 0, sum = 0, sumKnown = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed)
  {
    const PointWorld<D> world(seed, options);
    const auto start = std::chrono::steady_clock::now();
    PointVisibility<D> visible;
    if (visibility)
      visible = [&](const PointVector<D>& p, std::size_t) { return world.isInView(p); };
    const auto result = world.solve({}, true, visible);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    PointOptions given;
    given.associationGiven = true;
    const auto known = world.solve(given);
    const double ate = trajectoryError<D>(result.poses, world.truth);
    const double ateKnown = trajectoryError<D>(known.poses, world.truth);
    double drift = 0;
    const auto drifted = world.drifted();
    for (std::size_t k = 0; k < drifted.size(); ++k)
      drift = std::max(drift, (drifted[k].t - world.truth[k].t).norm());
    const auto score = scoreOf<D>(result, world);
    all += score;
    worst = std::max(worst, ate / ateKnown);
    sum += ate;
    sumKnown += ateKnown;
    std::printf(
        "%4u %10zu %6.2f %6.4f %6.4f %6.3f %8zu %5zu %6zu %4.1f\n", seed, world.detectionCount(),
        drift, ate, ateKnown, ate / ateKnown, score.estimated, score.truth, score.matched,
        time.count());
  }
  std::printf(
      "all: precision %.4f, recall %.4f, error %.4f of the known, worst %.3f\n\n", all.precision(),
      all.recall(), sum / sumKnown, worst);
}

}  // namespace

int main(int argc, char** argv)
{
  const unsigned seeds = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 20;
  PointWorldOptions options;
  if (argc > 2) options.turnSigma = std::atof(argv[2]);
  table<2>(seeds, options, false);
  table<2>(seeds, options, true);
  table<3>(seeds, options, false);
}
