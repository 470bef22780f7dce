#include "quadmap/estimation/ExistenceLooks.h"

#include <algorithm>
#include <cmath>

#include "quadmap/estimation/Existence.h"
#include "quadmap/estimation/ViewRedundancy.h"

namespace quadmap
{
namespace
{
constexpr double kSamePlace = 0.1;       // looks nearer than this share of the reach are one visit
constexpr std::size_t kMaxVisits = 200;  // kept, so that the cost does not grow with the run
}  // namespace

double detectionProbability(
    const LookCounts& counts, double priorMean, const ExistenceOptions& existence)
{
  const double prior = existence.detectionPriorWeight;
  const double p = (prior * priorMean + counts.seen) / (prior + counts.seen + counts.missed);
  // Where a detector sees things hardly more often than it sees nothing, it cannot tell anything.
  constexpr double kBetterThanFalse = 2, kSure = 0.99;
  return std::clamp(p, std::min(kSure, kBetterThanFalse * existence.falseAlarmProbability), kSure);
}

double ExistenceLooks::correlation(
    const Visit& of, const Visit& with, const ExistenceOptions& options)
{
  const double gap = std::max({0.0, of.first - with.last, with.first - of.last});
  return sharedMistakes(of.camera, with.camera, of.reach) *
         std::max(0.0, 1 - gap / options.independentViewTime);
}

void ExistenceLooks::add(
    const Look& look, const Eigen::Vector3d& center, const ExistenceOptions& options)
{
  if (look.boxSize > 0)
  {
    sumOfInverseSizes_ += 1 / look.boxSize;
    ++boxes_;
  }
  const double reach = independentReach(look.camera, center, options);
  const auto isOf = [&](const Visit& v)
  {
    return (v.camera - look.camera).norm() <= kSamePlace * reach &&
           std::max(v.first - look.time, look.time - v.last) < options.independentViewTime;
  };
  const auto known = std::find_if(visits_.rbegin(), visits_.rend(), isOf);
  Visit* visit = known == visits_.rend() ? nullptr : &*known;
  if (!visit)
  {
    visits_.push_back({look.camera, reach, look.time, look.time, 0, 0, 0});
    visit = &visits_.back();
    for (const Visit& other : visits_)
      visit->crowd += other.looks() * correlation(*visit, other, options);
  }
  visit->first = std::min(visit->first, look.time);
  visit->last = std::max(visit->last, look.time);
  ++(look.seen ? visit->seen : visit->missed);
  for (Visit& other : visits_) other.crowd += correlation(other, *visit, options);
  if (visits_.size() <= kMaxVisits) return;
  take(visits_.front(), options.detectionProbability, options, before_);
  visits_.pop_front();
}

/** (13.1): the looks of a visit times the share of each. */
LookCounts ExistenceLooks::independent(const Visit& visit, const ExistenceOptions& options)
{
  const double share = independentShare(visit.crowd - 1, options);
  return {share * visit.seen, share * visit.missed};
}

LookCounts ExistenceLooks::independent(const ExistenceOptions& options) const
{
  LookCounts sum = before_.counts;
  for (const Visit& visit : visits_) sum += independent(visit, options);
  return sum;
}

void ExistenceLooks::take(
    const Visit& visit, double labelProbability, const ExistenceOptions& options, Known& known)
{
  const LookCounts counts = independent(visit, options);
  const ExistenceEvidence evidence(
      detectionProbability(known.recent, labelProbability, options), options.falseAlarmProbability);
  const double said = counts.seen * evidence.detection() + counts.missed * evidence.miss();
  const bool isBack = known.last && visit.first > *known.last + options.independentViewTime;
  if (known.afterReturn)
    *known.afterReturn += said;
  else if (isBack && known.logOdds > options.confirmLogOdds)
    known.afterReturn = said;
  known.last = std::max(known.last.value_or(visit.last), visit.last);
  known.logOdds = std::clamp(known.logOdds + said, -options.maxLogOdds, options.maxLogOdds);
  known.counts += counts;
  known.recent += counts;
  // How well it is seen changes with the place and the light, so that old looks are forgotten.
  const double sum = known.recent.seen + known.recent.missed;
  const double share = std::min(1.0, options.detectionPriorWeight / sum);
  known.recent = {share * known.recent.seen, share * known.recent.missed};
}

ExistenceLooks::Known ExistenceLooks::known(
    double labelProbability, const ExistenceOptions& options) const
{
  Known known = before_;
  for (const Visit& visit : visits_) take(visit, labelProbability, options, known);
  return known;
}

std::optional<double> ExistenceLooks::afterReturn(
    double labelProbability, const ExistenceOptions& options) const
{
  return known(labelProbability, options).afterReturn;
}

std::optional<double> ExistenceLooks::usualSize() const
{
  if (boxes_ == 0) return std::nullopt;
  return boxes_ / sumOfInverseSizes_;
}

double ExistenceLooks::logOdds(double labelProbability, const ExistenceOptions& options) const
{
  return known(labelProbability, options).logOdds;
}

}  // namespace quadmap
