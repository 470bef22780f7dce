#include "merging/PairedMaps.h"

#include <algorithm>
#include <set>

#include "quadmap/estimation/Assignment.h"
#include "quadmap/estimation/ObjectRules.h"

namespace quadmap
{
namespace
{
constexpr double kGate = 16.27;  // chi^2 of three degrees of freedom, 99.9 %

ShiftAndYaw placeOf(const mrpt::poses::CPose3D& T) { return {T.x(), T.y(), T.z(), T.yaw()}; }

mrpt::poses::CPose3D poseOf(const ShiftAndYaw& T) { return {T[0], T[1], T[2], T[3], 0, 0}; }

class Pairing
{
 public:
  Pairing(
      const MergedMap& own,
      const MergedMap& other,
      const GoneRules& rules,
      const EstimatorOptions& estimator,
      const MapMergeOptions& options) :
      own_(own), other_(other), rules_(rules), estimator_(estimator), options_(options)
  {
  }

  std::optional<PairedMaps> run()
  {
    const auto match = matchOlderFirst();
    if (!match) return std::nullopt;
    PairedMaps both;
    both.match = *match;
    for (const auto& [there, here] : match->pairs) both.together.emplace_back(here, there);
    both.joint.T_own_other = placeOf(match->T_map_local);
    settle(both);
    addDoubtful(both);
    both.joint = estimate(both);
    both.match.T_map_local = poseOf(both.joint.T_own_other);
    return both;
  }

 private:
  /** The other map in the own one. The newer map is looked for in the older one, whichever is the
   * own one, so that the answer is the same. */
  std::optional<ConstellationMatch> matchOlderFirst() const
  {
    if (other_.age() >= own_.age())
      return matchConstellation(other_.confirmed(), own_.confirmed(), rules_.labels, options_);
    auto match = matchConstellation(own_.confirmed(), other_.confirmed(), rules_.labels, options_);
    if (!match) return std::nullopt;
    match->T_map_local = -match->T_map_local;
    for (auto& [local, map] : match->pairs) std::swap(local, map);
    return match;
  }

  JointEstimate estimate(const PairedMaps& both) const
  {
    std::vector<KnownPair> pairs;
    for (const auto& [here, there] : both.together)
    {
      const MergedMap::Object &a = own_.at(here), &b = other_.at(there);
      const auto label = pooled(a.object, b.object, rules_.existence).label();
      pairs.push_back({knownOf(a), knownOf(b), rules_.labels.properties(label)});
    }
    return estimateJointly(pairs, both.joint.T_own_other, estimator_);
  }

  /** What a map knows, as far as the other one does not err alike: doc/mathematics.md, (25.5). */
  KnownState knownOf(const MergedMap::Object& o) const
  {
    KnownState known{uprightStateOf(o.object.object), o.known, o.object.orientationDefined};
    known.known.L /= 1 + options_.errorCorrelation;
    known.known.xi /= 1 + options_.errorCorrelation;
    return known;
  }

  /** Estimates the place from the objects that stayed, and which stayed from the place, in turn. */
  void settle(PairedMaps& both) const
  {
    constexpr int kMaxRounds = 10;
    IdPairs all = both.together;
    std::sort(all.begin(), all.end());
    for (int round = 0; round < kMaxRounds; ++round)
    {
      both.joint = estimate(both);
      IdPairs together, displaced;
      for (const auto& pair : all)
        (hasStayed(pair, both.joint) ? together : displaced).push_back(pair);
      const bool isSettled = together == both.together;
      if (together.size() < static_cast<std::size_t>(options_.minPairs)) return;
      both.together = together;
      both.displaced = displaced;
      if (isSettled) return;
    }
  }

  /** doc/mathematics.md, (25.7). */
  bool hasStayed(const std::pair<ObjectId, ObjectId>& pair, const JointEstimate& joint) const
  {
    const StateShift shift(joint.T_own_other);
    const MapObject &a = own_.at(pair.first).object, &b = other_.at(pair.second).object;
    const UprightState y = uprightStateOf(b.object);
    const Eigen::Vector3d d = (uprightStateOf(a.object) - shift.state(y)).head<3>();
    const auto J = byShiftAndYaw(shift, y);
    const UprightCovariance S = a.covariance + shift.D * b.covariance * shift.D.transpose() +
                                J * joint.covariance * J.transpose();
    const Eigen::Matrix3d all = S.topLeftCorner<3, 3>() + options_.staySigma * options_.staySigma *
                                                              Eigen::Matrix3d::Identity();
    return d.dot(all.ldlt().solve(d)) <= kGate;
  }

  /** Pairs what one map reports with what the other one is not sure of. Things that neither is sure
   * of stay unpaired: maps of one place make the same mistakes. */
  void addDoubtful(PairedMaps& both) const
  {
    std::set<ObjectId> ownTaken, otherTaken;
    for (const IdPairs* pairs : {&both.together, &both.displaced})
      for (const auto& [here, there] : *pairs)
      {
        ownTaken.insert(here);
        otherTaken.insert(there);
      }
    std::vector<const MapObject*> own;
    std::vector<MapObject> other;  // in the own frame
    for (const auto& o : own_.objects)
      if (ownTaken.count(o.object.id) == 0) own.push_back(&o.object);
    for (const auto& o : other_.objects)
    {
      if (otherTaken.count(o.object.id) != 0) continue;
      other.push_back(o.object);
      other.back().object = o.object.object.transformed(poseOf(both.joint.T_own_other));
    }
    const auto rows = static_cast<Eigen::Index>(own.size());
    const auto columns = static_cast<Eigen::Index>(other.size());
    constexpr double kNone = 1e6;  // more than any distance [m]
    Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(rows, columns + rows, kNone);
    for (std::size_t i = 0; i < own.size(); ++i)
      for (std::size_t j = 0; j < other.size(); ++j)
        if (own[i]->confirmed != other[j].confirmed &&
            areOneObject(*own[i], other[j], rules_.labels, rules_.merging))
          cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
              (own[i]->object.center() - other[j].object.center()).norm();
    const auto columnOf = optimalAssignment(cost);
    for (std::size_t i = 0; i < columnOf.size(); ++i)
      if (cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(columnOf[i])) < kNone)
        both.together.emplace_back(own[i]->id, other[columnOf[i]].id);
  }

  const MergedMap &own_, &other_;
  const GoneRules& rules_;
  const EstimatorOptions& estimator_;
  const MapMergeOptions& options_;
};

}  // namespace

MapObject pooled(const MapObject& own, const MapObject& other, const ExistenceOptions& existence)
{
  MapObject both = own;
  for (const auto& [label, count] : other.labelCounts) both.labelCounts[label] += count;
  both.completeCount += other.completeCount;
  both.partialCount += other.partialCount;
  both.missCount += other.missCount;
  both.existenceLogOdds = std::clamp(
      own.existenceLogOdds + other.existenceLogOdds, -existence.maxLogOdds, existence.maxLogOdds);
  both.firstSeen = std::min(own.firstSeen, other.firstSeen);
  both.lastSeen = std::max(own.lastSeen, other.lastSeen);
  return both;
}

std::optional<PairedMaps> pairMaps(
    const MergedMap& own,
    const MergedMap& other,
    const GoneRules& rules,
    const EstimatorOptions& estimator,
    const MapMergeOptions& options)
{
  return Pairing(own, other, rules, estimator, options).run();
}

}  // namespace quadmap
