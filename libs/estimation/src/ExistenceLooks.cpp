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
  if (look.seen)
  {
    sumOfRanges_ += (look.camera - center).norm();
    ++hits_;
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
  known.logOdds = std::clamp(
      known.logOdds + counts.seen * evidence.detection() + counts.missed * evidence.miss(),
      -options.maxLogOdds, options.maxLogOdds);
  known.counts += counts;
  known.recent += counts;
  // How well it is seen changes with the place and the light, so that old looks are forgotten.
  const double sum = known.recent.seen + known.recent.missed;
  const double share = std::min(1.0, options.detectionPriorWeight / sum);
  known.recent = {share * known.recent.seen, share * known.recent.missed};
}

std::optional<double> ExistenceLooks::afterReturn(
    double labelProbability, const ExistenceOptions& options) const
{
  Known known = before_;
  double last = visits_.empty() ? 0 : visits_.front().last;
  auto visit = visits_.begin();
  for (; visit != visits_.end() && visit->first <= last + options.independentViewTime; ++visit)
  {
    last = std::max(last, visit->last);
    take(*visit, labelProbability, options, known);
  }
  if (visit == visits_.end() || known.logOdds <= options.confirmLogOdds) return std::nullopt;
  LookCounts after;
  for (; visit != visits_.end(); ++visit) after += independent(*visit, options);
  const ExistenceEvidence evidence(
      detectionProbability(known.recent, labelProbability, options), options.falseAlarmProbability);
  return after.seen * evidence.detection() + after.missed * evidence.miss();
}

double ExistenceLooks::logOdds(double labelProbability, const ExistenceOptions& options) const
{
  Known known = before_;
  for (const Visit& visit : visits_) take(visit, labelProbability, options, known);
  return known.logOdds;
}

}  // namespace quadmap
