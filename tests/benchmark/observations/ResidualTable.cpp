#include "ResidualTable.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "quadmap/estimation/ResidualRow.h"
#include "quadmap/estimation/ViewResiduals.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/maps/ObjectEstimator.h"

namespace quadmap::observations
{
namespace
{
constexpr double kOutlier = 3.0;  // [sigma]

/** Residuals of one type of factor, in sigmas. */
struct Factor
{
  std::vector<double> residuals;
  bool isInequality = false;  //!< Only positive residuals say something
};

/** All residuals of a run by type of factor, in the order of the names. */
class Residuals
{
 public:
  Residuals(bool perLabel, std::ostream* raw) : perLabel_(perLabel), raw_(raw)
  {
    if (raw_)
      *raw_ << "seed frame object label factor face residual_m sigma_m range_m azimuth_deg "
               "elevation_deg visible\n";
  }

  void setBox(const ObservedFrame& frame, const TrueObject& truth)
  {
    frame_ = &frame;
    truth_ = &truth;
    fromObject_ = truth.object_sensor.rotation().transpose() * -truth.object_sensor.center();
  }

  /** \param residual, sigma In the same unit. \param face Of the true object; -1: of none. */
  void add(
      const std::string& factor,
      double residual,
      double sigma,
      bool isInequality = false,
      int face = -1)
  {
    insert(factor, residual / sigma, isInequality);
    if (perLabel_) insert(factor + " / " + truth_->label, residual / sigma, isInequality);
    if (raw_)
      *raw_ << mrpt::format(
          "%u %u %s %s %s %d %.5f %.5f %.3f %.1f %.1f %.2f\n", static_cast<unsigned>(frame_->seed),
          static_cast<unsigned>(frame_->index), withoutBlanks(truth_->name).c_str(),
          withoutBlanks(truth_->label).c_str(), withoutBlanks(factor).c_str(), face, residual,
          sigma, fromObject_.norm(), degrees(std::atan2(fromObject_.y(), fromObject_.x())),
          degrees(std::asin(fromObject_.z() / fromObject_.norm())), truth_->visible.visibleShare);
  }

  void print(std::ostream& out) const
  {
    out << mrpt::format(
        "%-40s %6s %8s %9s %9s %8s %10s\n", "factor (in sigmas)", "count", "bias", "variance",
        "of all", "by MAD", ">3 sigma");
    for (const auto& [name, factor] : factors_) out << row(name, factor);
  }

  /** Counts and sums, so that the rows of several runs can be added up. */
  Rows rows() const
  {
    Rows out;
    for (const auto& [name, factor] : factors_)
    {
      out.push_back({
          name,
          {{"count", static_cast<double>(factor.residuals.size())}, {"beyond", beyond(factor)}}
      });
      if (factor.isInequality) continue;
      const Moments inside = momentsWithin(factor.residuals, kOutlier);
      out.back().second["inside"] = inside.count;
      out.back().second["sum"] = inside.mean * inside.count;
      out.back().second["squares"] = (inside.variance + inside.mean * inside.mean) * inside.count;
    }
    return out;
  }

 private:
  static double degrees(double radians) { return radians * 180 / M_PI; }

  static std::string withoutBlanks(std::string text)
  {
    std::replace(text.begin(), text.end(), ' ', '_');
    return text;
  }

  void insert(const std::string& name, double normalised, bool isInequality)
  {
    Factor& factor = factors_[name];
    factor.isInequality = isInequality;
    factor.residuals.push_back(normalised);
  }

  static double beyond(const Factor& factor)
  {
    return static_cast<double>(std::count_if(
        factor.residuals.begin(), factor.residuals.end(),
        [&](double x) { return (factor.isInequality ? x : std::abs(x)) > kOutlier; }));
  }

  static std::string row(const std::string& name, const Factor& factor)
  {
    const auto& r = factor.residuals;
    const Moments all = momentsWithin(r, std::numeric_limits<double>::infinity());
    const std::string head = mrpt::format("%-40s %6zu", name.c_str(), r.size());
    const std::string tail = mrpt::format(" %8.2f %%\n", 100 * beyond(factor) / all.count);
    if (factor.isInequality) return head + mrpt::format("%37s", "(violated)") + tail;
    // A normal distribution cut at 3 sigma keeps this share of its variance.
    constexpr double kKept = 0.9733;
    const Moments inside = momentsWithin(r, kOutlier);
    const double robust = madSigma(r);
    return head +
           mrpt::format(
               " %8.2f %9.2f %9.2f %8.2f", inside.mean, inside.variance / kKept, all.variance,
               robust * robust) +
           tail;
  }

  struct Moments
  {
    double count = 0, mean = 0, variance = 0;
  };
  static Moments momentsWithin(const std::vector<double>& values, double bound)
  {
    Moments out;
    double squares = 0;
    for (const double x : values)
    {
      if (std::abs(x) > bound) continue;
      ++out.count;
      out.mean += x;
      squares += x * x;
    }
    if (out.count == 0) return out;
    out.mean /= out.count;
    out.variance = squares / out.count - out.mean * out.mean;
    return out;
  }

  bool perLabel_;
  std::ostream* raw_;
  std::map<std::string, Factor> factors_;
  const ObservedFrame* frame_ = nullptr;
  const TrueObject* truth_ = nullptr;
  Eigen::Vector3d fromObject_ = Eigen::Vector3d::Zero();  // to the camera, in the object's axes [m]
};

/** How a face stands to the camera decides how it is measured. */
std::string faceFactor(const ObjectView& view, std::size_t face)
{
  constexpr double kFrontal = 0.25;  // cosine
  if (view.faces[face].kind == FaceKind::Support) return "face: support below";
  const Eigen::Vector3d n = view.faceNormal(face);
  const Eigen::Vector3d onFace =
      view.center + n * view.halfSizes[static_cast<Eigen::Index>(face / 2)];
  const double towards = n.dot(view.camera - onFace) / (view.camera - onFace).norm();
  const std::string part = face == 4 ? "top" : face == 5 ? "bottom" : "side";
  const std::string how = towards > kFrontal    ? " towards the camera"
                          : towards < -kFrontal ? " turned away"
                                                : " at its outline";
  return (view.faces[face].kind == FaceKind::AtLeast ? "at least: " : "face: ") + part + how;
}

/** Face 0..5 (+x, -x, ...) of an object that looks out along a direction. */
int faceAlong(const Ellipsoid& object, const Eigen::Vector3d& normal)
{
  const Eigen::Vector3d along = object.rotation().transpose() * normal;
  Eigen::Index axis = 0;
  along.cwiseAbs().maxCoeff(&axis);
  return 2 * static_cast<int>(axis) + (along[axis] < 0 ? 1 : 0);
}

void addComplete(
    const ObjectView& view, const TrueObject& truth, const Ellipsoid& object, Residuals& out)
{
  for (std::size_t f = 0; f < kFaces; ++f)
  {
    const auto& face = view.faces[f];
    if (face.kind == FaceKind::Unknown) continue;
    const Plane inwards{-view.faceNormal(f), view.faceOffset(f)};
    out.add(
        faceFactor(view, f), tangencyResidual(inwards, object, view.faceExponent), face.sigma,
        face.kind == FaceKind::AtLeast, faceAlong(object, view.faceNormal(f)));
  }
  if (view.yawDefined && truth.orientationDefined)
  {
    const double yaw = uprightStateOf(object)[3];
    out.add("yaw", nearestEquivalentYaw(view.yaw, yaw) - yaw, view.yawSigma);
  }
}

/** The position of a partial measurement, along the line of sight and to its sides. */
void addSeed(const ObjectView& view, const Ellipsoid& object, Residuals& out)
{
  const Eigen::Vector3d off = view.center - object.center();
  const Eigen::Vector3d along = (view.center - view.camera).normalized();
  const Eigen::Vector3d side = along.cross(Eigen::Vector3d::UnitZ()).normalized();
  const auto add = [&](const char* name, const Eigen::Vector3d& n)
  { out.add(name, n.dot(off), std::sqrt(n.dot(view.centerCovariance * n))); };
  add("seed: along the ray", along);
  add("seed: sideways", side);
  add("seed: upwards", side.cross(along));
}

void addEdges(const ObjectView& view, const Ellipsoid& object, double q, Residuals& out)
{
  const EstimatorOptions estimator;
  for (const auto& edge : view.edges)
    out.add(
        view.complete ? "box edge of a complete one" : "box edge of a partial one",
        -tangencyResidual(edge.plane, object, q), edgeSigma(view, edge, estimator));
}

void addFrame(const ObservedFrame& frame, const LabelTable& labels, Residuals& out)
{
  const PoseNoise noPoseNoise{0, 0};
  for (std::size_t b = 0; b < frame.boxes.objects.size(); ++b)
  {
    const auto& detected = frame.boxes.objects[b];
    const auto& truth = frame.truth[b];
    if (!truth) continue;
    const auto view =
        viewOf(detected, frame.T_map_sensor, labels.properties(detected.label), noPoseNoise);
    if (!view) continue;
    out.setBox(frame, *truth);
    const Ellipsoid object = truth->object_sensor.transformed(frame.T_map_sensor);
    if (view->complete)
      addComplete(*view, *truth, object, out);
    else
      addSeed(*view, object, out);
    addEdges(*view, object, labels.properties(truth->label).shapeExponent, out);
  }
}

}  // namespace

Rows printResidualTable(const RunOptions& run, bool perLabel, std::ostream& out, std::ostream* raw)
{
  const auto labels = LabelTable::installed();
  Residuals residuals(perLabel, raw);
  runScene(
      run, PerceptionOptions(), labels,
      [&](const ObservedFrame& frame) { addFrame(frame, labels, residuals); });
  residuals.print(out);
  return residuals.rows();
}

}  // namespace quadmap::observations
