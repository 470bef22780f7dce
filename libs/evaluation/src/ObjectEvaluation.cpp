#include "quadmap/evaluation/ObjectEvaluation.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "quadmap/estimation/Assignment.h"
#include "quadmap/geometry/Overlap.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
namespace
{
std::string plainSpelling(const std::string& label)
{
  std::string folded;
  for (const char c : label)
    folded += c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto first = folded.find_first_not_of(' ');
  const auto last = folded.find_last_not_of(' ');
  return first == std::string::npos ? std::string() : folded.substr(first, last - first + 1);
}

/** Shape when the yaw means nothing. The estimate's z is compared with the truth's axis nearest to
 * it, and the two other axes in the better order. */
double shapeIoUKeepingVertical(const Ellipsoid& truth, const Ellipsoid& estimated)
{
  Eigen::Index vertical = 2;
  (truth.rotation().transpose() * estimated.rotation().col(2)).cwiseAbs().maxCoeff(&vertical);
  const Eigen::Vector3d& t = truth.semiAxes();
  const Eigen::Vector3d upright(t[(vertical + 1) % 3], t[(vertical + 2) % 3], t[vertical]);
  const Eigen::Vector3d turned(upright.y(), upright.x(), upright.z());
  return std::max(
      alignedIoU(upright, estimated.semiAxes()), alignedIoU(turned, estimated.semiAxes()));
}

/** The assignment takes cubic time: seconds for so many, hours for 20,000. */
constexpr std::size_t kMostObjects = 1000;

void requireFew(std::size_t objects, const char* which)
{
  if (objects > kMostObjects)
    throw TooManyObjects(
        std::to_string(objects) + " " + which + " objects, at most " +
        std::to_string(kMostObjects) + " can be compared");
}

/** Index of the estimated object of each true one, or estimated.size() for none. */
std::vector<std::size_t> assign(
    const std::vector<ObjectRecord>& truth,
    const std::vector<ObjectRecord>& estimated,
    const ObjectEvaluationOptions& options)
{
  if (truth.empty()) return {};
  requireFew(truth.size(), "true");
  requireFew(estimated.size(), "estimated");
  // After the estimated objects there are columns for "missed". They cost more than all possible
  // pairs together, so that the assignment has as many pairs as possible.
  const double missedCost =
      1.0 + options.maxCenterDistance * static_cast<double>(truth.size() + estimated.size());
  const double impossibleCost = 10 * missedCost;
  const auto rows = static_cast<Eigen::Index>(truth.size());
  const auto columns = static_cast<Eigen::Index>(estimated.size());
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(rows, columns + rows, missedCost);
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (std::size_t j = 0; j < estimated.size(); ++j)
    {
      const double distance = (truth[i].object.center() - estimated[j].object.center()).norm();
      const bool possible =
          distance <= options.maxCenterDistance &&
          options.canonicalLabel(truth[i].label) == options.canonicalLabel(estimated[j].label);
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          possible ? distance : impossibleCost;
    }
  auto columnOfRow = optimalAssignment(cost);
  for (auto& column : columnOfRow) column = std::min(column, estimated.size());
  return columnOfRow;
}

/** (20.8) of the errors of an estimate. The world is that of the estimate, where z is up: in that
 * of the truth up may be anywhere. */
void compareWithCovariance(
    const Ellipsoid& truth, const ObjectRecord& estimated, ObjectComparison& result)
{
  if (!estimated.covariance) return;
  const Eigen::Matrix3d S = estimated.covariance->topLeftCorner<3, 3>();
  const Eigen::Vector3d error = estimated.object.center() - truth.center();
  const Eigen::LLT<Eigen::Matrix3d> llt(S);
  if (llt.info() != Eigen::Success) return;
  result.centerNees = error.dot(llt.solve(error));
  result.heightNees = error.z() * error.z() / S(2, 2);
  const double yawVariance = (*estimated.covariance)(3, 3);
  if (result.angle && yawVariance > 0)
  {
    // Objects of the map stand upright: what a relabeling leaves between them is a turn of the yaw.
    const double yaw =
        std::atan2(estimated.object.rotation()(1, 0), estimated.object.rotation()(0, 0));
    const double trueYaw = std::atan2(truth.rotation()(1, 0), truth.rotation()(0, 0));
    const double turn = std::remainder(yaw - trueYaw, M_PI / 2);
    result.yawNees = turn * turn / yawVariance;
  }
}

/** Mean of a figure over the matches that have it. */
template <typename Figure>
std::optional<double> meanOf(const std::vector<ObjectMatch>& matches, const Figure& figure)
{
  double sum = 0;
  int count = 0;
  for (const auto& match : matches)
    if (const std::optional<double> value = figure(match.comparison))
    {
      sum += *value;
      ++count;
    }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::optional<double> ratio(std::size_t part, std::size_t whole)
{
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}
}  // namespace

LabelSpelling installedLabelSpelling()
{
  try
  {
    return [table = LabelTable::installed()](const std::string& label)
    { return plainSpelling(table.canonical(label)); };
  }
  catch (const std::runtime_error&)
  {
    return plainSpelling;
  }
}

ObjectComparison compareObjects(const ObjectRecord& truth, const ObjectRecord& estimated)
{
  const Ellipsoid &t = truth.object, &e = estimated.object;
  ObjectComparison result;
  result.centerDistance = (t.center() - e.center()).norm();
  result.iou3d = cuboidIoU(t, e);
  if (truth.orientationDefined && estimated.orientationDefined)
  {
    const auto nearest = symmetricRotationDistance(t.rotation(), e.rotation());
    result.angle = nearest.angle;
    // Column i of R_e P is axis j of the estimate, P(j, i) = +-1.
    const Eigen::Vector3d relabeled = nearest.relabeling.transpose().cwiseAbs() * e.semiAxes();
    result.shapeIoU = alignedIoU(t.semiAxes(), relabeled);
  }
  else
    result.shapeIoU = shapeIoUKeepingVertical(t, e);
  return result;
}

std::optional<double> ObjectEvaluation::precision() const
{
  return ratio(matches.size(), estimatedCount());
}
std::optional<double> ObjectEvaluation::recall() const
{
  return ratio(matches.size(), truthCount());
}
std::optional<double> ObjectEvaluation::f1() const
{
  return ratio(2 * matches.size(), truthCount() + estimatedCount());
}
std::optional<double> ObjectEvaluation::meanCenterDistance() const
{
  return meanOf(matches, [](const ObjectComparison& c) { return std::optional(c.centerDistance); });
}
std::optional<double> ObjectEvaluation::meanAngle() const
{
  return meanOf(matches, [](const ObjectComparison& c) { return c.angle; });
}
std::optional<double> ObjectEvaluation::meanShapeIoU() const
{
  return meanOf(matches, [](const ObjectComparison& c) { return std::optional(c.shapeIoU); });
}
std::optional<double> ObjectEvaluation::meanIoU3d() const
{
  return meanOf(matches, [](const ObjectComparison& c) { return std::optional(c.iou3d); });
}

std::optional<double> ObjectEvaluation::meanCenterNees() const
{
  return meanOf(matches, [](const ObjectComparison& c) { return c.centerNees; });
}
std::optional<double> ObjectEvaluation::meanHeightNees() const
{
  return meanOf(matches, [](const ObjectComparison& c) { return c.heightNees; });
}
std::optional<double> ObjectEvaluation::meanYawNees() const
{
  return meanOf(matches, [](const ObjectComparison& c) { return c.yawNees; });
}

ObjectEvaluation evaluateObjects(
    const std::vector<ObjectRecord>& truth,
    const std::vector<ObjectRecord>& estimated,
    const mrpt::poses::CPose3D& T_truth_estimated,
    const ObjectEvaluationOptions& options)
{
  std::vector<ObjectRecord> inTruth = estimated;
  for (auto& record : inTruth)
  {
    record.object = record.object.transformed(T_truth_estimated);
    record.covariance.reset();
  }

  const auto estimatedOfTruth = assign(truth, inTruth, options);
  ObjectEvaluation result;
  std::vector<bool> taken(inTruth.size(), false);
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const std::size_t j = estimatedOfTruth[i];
    if (j < inTruth.size())
    {
      taken[j] = true;
      auto comparison = compareObjects(truth[i], inTruth[j]);
      compareWithCovariance(
          truth[i].object.transformed(-T_truth_estimated), estimated[j], comparison);
      result.matches.push_back({truth[i], inTruth[j], comparison});
    }
    else if (truth[i].framesVisible && *truth[i].framesVisible < options.minFramesVisible)
      result.uncounted.push_back(truth[i]);
    else
      result.missed.push_back(truth[i]);
  }
  for (std::size_t j = 0; j < inTruth.size(); ++j)
    if (!taken[j]) result.spurious.push_back(inTruth[j]);
  return result;
}

}  // namespace quadmap
