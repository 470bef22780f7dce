#include <algorithm>
#include <cmath>

#include "InsertionFrame.h"
#include "quadmap/estimation/Existence.h"

// Whether an object exists: section 13 of doc/mathematics.md.
namespace quadmap
{
namespace
{
/** Largest deviation of a size from the label's typical one, in spreads; x and y are unordered. */
double sizeDeviation(const Ellipsoid& object, const LabelProperties& label)
{
  const auto ordered = [](Eigen::Vector3d size)
  {
    if (size.x() > size.y()) std::swap(size.x(), size.y());
    return size;
  };
  const Eigen::Array3d ratio =
      ordered(2 * object.semiAxes()).array() / ordered(label.typicalSize).array();
  return ratio.log().abs().maxCoeff() / label.sizeSpread;
}

}  // namespace

/** (13.2) for each object that the frame should have shown and did not. */
void CQuadricObjectMap::countMisses(const Frame& frame, const std::set<ObjectId>& touched)
{
  const auto& existence = insertionOptions.existence;
  for (auto& [id, object] : objects_)
  {
    if (touched.count(id) != 0) continue;
    if (!shouldBeVisible(object.object, frame.geometry, existence)) continue;
    if (isShownByAFreeBox(object, frame)) continue;
    ++object.missCount;
    object.existenceLogOdds = existenceAfterMiss(object.existenceLogOdds, existence);
    object.confirmed = isConfirmed(object);
  }
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

/** The list after (13.2). */
bool CQuadricObjectMap::isConfirmed(const MapObject& object) const
{
  const auto& existence = insertionOptions.existence;
  const bool manyComplete = object.completeCount >= static_cast<unsigned>(existence.minComplete);
  const bool manyPartial = object.observations() >= static_cast<unsigned>(existence.minPartial) &&
                           sizeDeviation(object.object, labels().properties(object.label())) <=
                               existence.maxSizeDeviation;
  const double centerSigma = std::sqrt(object.covariance.diagonal().head<3>().maxCoeff());
  const double sizeSigma = object.covariance.diagonal()
                               .tail<3>()
                               .cwiseSqrt()
                               .cwiseProduct(object.object.semiAxes())
                               .maxCoeff();
  return object.existenceLogOdds > existence.confirmLogOdds && (manyComplete || manyPartial) &&
         labelAgreement(object, object.label(), labels()) >= existence.minLabelShare &&
         centerSigma < existence.maxCenterSigma && sizeSigma < existence.maxSizeSigma;
}

}  // namespace quadmap
