#include <algorithm>
#include <cmath>

#include "InsertionFrame.h"
#include "quadmap/estimation/Existence.h"
#include "quadmap/estimation/LabelPrior.h"
#include "quadmap/geometry/PosePosition.h"

// Whether an object exists: section 13 of doc/mathematics.md.
namespace quadmap
{
namespace
{
/** Should a detector have found the object? It finds what is as large as it saw it before,
 * `usualSize` [px]. For what is smaller than minBoxSize the coarse depth has few cells: whether
 * something hides it is also asked of the map. */
bool shouldBeFound(
    const Ellipsoid& object,
    std::optional<double> usualSize,
    const FrameGeometry& frame,
    const std::vector<Ellipsoid>& confirmed,
    const ExistenceOptions& existence)
{
  if (shouldBeVisible(object, frame, existence, existence.minBoxSize)) return true;
  return usualSize && *usualSize < existence.minBoxSize &&
         shouldBeVisible(object, frame, existence, *usualSize) &&
         !isBehind(object, confirmed, positionOf(frame.T_map_sensor), existence);
}
}  // namespace

/** Notes each object that the frame should have shown and did not. \return Their ids. */
std::set<ObjectId> CQuadricObjectMap::countMisses(
    const Frame& frame, const std::set<ObjectId>& touched)
{
  const auto& existence = insertionOptions.existence;
  const auto& camera = frame.geometry.T_map_sensor;
  std::vector<Ellipsoid> confirmed;
  for (const MapObject* object : confirmedObjects()) confirmed.push_back(object->object);
  std::set<ObjectId> missed;
  for (auto& [id, object] : objects_)
  {
    if (touched.count(id) != 0) continue;
    if (!shouldBeFound(
            object.object, object.looks.usualSize(), frame.geometry, confirmed, existence))
      continue;
    if (isShownByAFreeBox(object, frame)) continue;
    ++object.missCount;
    object.looks.add(
        {positionOf(camera), mrpt::Clock::toDouble(frame.time), false}, object.object.center(),
        existence);
    missed.insert(id);
  }
  return missed;
}

/** The independent looks at an object, once it surely exists. How often false alarms came tells
 * nothing of how well things are found: two of them would vouch for each other. */
LookCounts CQuadricObjectMap::tellingLooks(const Entry& object) const
{
  const auto& existence = insertionOptions.existence;
  if (object.logOdds() <= existence.confirmLogOdds) return {};
  return object.looks.independent(existence);
}

/** The sums of all objects of a label, from which its detection probability is learnt, (13.3). */
std::map<std::string, LookCounts> CQuadricObjectMap::tellingLooksByLabel() const
{
  std::map<std::string, LookCounts> counts;
  for (const auto& [id, object] : objects_) counts[object.label()] += tellingLooks(object);
  return counts;
}

/** The detection probability that the others of its kind tell, (13.3): its own looks count in
 * ExistenceLooks already. */
double CQuadricObjectMap::detectionProbabilityByOthers(
    const Entry& object, const std::map<std::string, LookCounts>& ofLabels) const
{
  const auto& existence = insertionOptions.existence;
  LookCounts others = ofLabels.at(object.label());
  others -= tellingLooks(object);
  return detectionProbability(others, existence.detectionProbability, existence);
}

/** Takes stock of the objects that a frame looked at. */
void CQuadricObjectMap::judge(const std::set<ObjectId>& looked)
{
  const auto& existence = insertionOptions.existence;
  const auto ofLabels = tellingLooksByLabel();
  for (const ObjectId id : looked)
  {
    Entry& object = require(id);
    object.existenceLogOdds =
        object.looks.logOdds(detectionProbabilityByOthers(object, ofLabels), existence);
    weighSize(object);  // the look may have brought another label
    object.confirmed = isConfirmed(object);
  }
}

CQuadricObjectMap::Revisits CQuadricObjectMap::revisits() const
{
  const auto& existence = insertionOptions.existence;
  // A hundred to one. It takes two looks, each of which says up to 90 to one, (13.3): all that one
  // image should have shown is missing when it is blurred.
  constexpr double kSurelyGone = 4.6;
  Revisits revisits;
  const auto ofLabels = tellingLooksByLabel();
  for (const auto& [id, object] : objects_)
    if (const auto after =
            object.looks.afterReturn(detectionProbabilityByOthers(object, ofLabels), existence))
      ++(*after < -kSurelyGone ? revisits.missed : revisits.found);
  return revisits;
}

bool CQuadricObjectMap::isShownByAFreeBox(const MapObject& object, const Frame& frame) const
{
  ShownRule rule;
  rule.minLabelAgreement = insertionOptions.existence.minLabelShare;
  const auto outline = outlineInImage(object, frame.geometry, labels());
  if (!outline) return false;
  for (std::size_t k = 0; k < frame.allBoxes.size(); ++k)
  {
    const bool taken = std::any_of(
        lastDecisions_.begin(), lastDecisions_.end(),
        [&](const Decision& d) { return d.box == k && d.object; });
    if (taken || frame.allLabels[k].empty()) continue;
    if (mayShow(frame.allBoxes[k], frame.allLabels[k], object, *outline, labels(), rule))
      return true;
  }
  return false;
}

/** What the sizes of an object's estimate say. Doubts make it less certain, not less likely. */
void CQuadricObjectMap::weighSize(Entry& object) const
{
  object.sizeLogOdds = sizeEvidence(
      object.object, object.covariance - object.doubts, labels().properties(object.label()),
      insertionOptions.existence, insertionOptions.estimator);
}

/** The list at the end of "Existence". */
bool CQuadricObjectMap::isConfirmed(const Entry& object) const
{
  const auto& existence = insertionOptions.existence;
  const bool many = object.observations() >= static_cast<unsigned>(existence.minObservations);
  const bool manyComplete = object.completeCount >= static_cast<unsigned>(existence.minComplete);
  const bool manyPartial =
      object.observations() >= static_cast<unsigned>(existence.minPartial) &&
      sizeDeviation(object.object, labels().properties(object.label()), ObjectFreedom::Upright) <=
          existence.maxSizeDeviation;
  const UprightState variances = (object.covariance - object.doubts).diagonal();
  const double centerSigma = std::sqrt(variances.head<3>().maxCoeff());
  const double sizeSigma =
      variances.tail<3>().cwiseSqrt().cwiseProduct(object.object.semiAxes()).maxCoeff();
  return object.logOdds() > existence.confirmLogOdds && many && (manyComplete || manyPartial) &&
         labelAgreement(object, object.label(), labels()) >= existence.minLabelShare &&
         centerSigma < existence.maxCenterSigma && sizeSigma < existence.maxSizeSigma;
}

}  // namespace quadmap
