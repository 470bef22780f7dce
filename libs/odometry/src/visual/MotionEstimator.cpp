#include "MotionEstimator.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "quadmap/estimation/RobustKernel.h"

namespace quadmap
{
namespace
{
constexpr double kMinDepth = 0.1;  // nearer points are not projected [m]

constexpr RobustKernel kKernel = RobustKernel::cauchy(2.0);  // doc/mathematics.md, (15.7)

double worstSigma(const Eigen::Matrix3d& covariance)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues().maxCoeff()));
}

std::optional<Eigen::Vector3d> normalAt(const VisualImage& image, int u, int v, int radius)
{
  if (u < radius || v < radius || u + radius >= image.columns() || v + radius >= image.rows())
    return std::nullopt;
  const float z = image.depth(u, v);
  const float tolerance = 0.02f + 0.04f * z;  // largest step in depth on one surface [m]
  Eigen::Vector3d p[4];
  const int du[] = {radius, -radius, 0, 0}, dv[] = {0, 0, radius, -radius};
  for (int i = 0; i < 4; ++i)
  {
    const float zi = image.depth(u + du[i], v + dv[i]);
    if (zi <= 0 || std::abs(zi - z) > tolerance) return std::nullopt;
    p[i] = image.point(u + du[i], v + dv[i], zi);
  }
  Eigen::Vector3d n = (p[0] - p[1]).cross(p[2] - p[3]);
  if (!(n.norm() > 0)) return std::nullopt;
  n.normalize();
  const Eigen::Vector3d ray = image.point(u, v, 1).normalized();
  constexpr double kMinIncidence = 0.2;  // least cosine: surfaces at a grazing angle are noise
  const double incidence = -n.dot(ray);
  if (std::abs(incidence) < kMinIncidence) return std::nullopt;
  return incidence > 0 ? n : Eigen::Vector3d(-n);
}

}  // namespace

double MotionEstimate::sigmaPosition() const
{
  return worstSigma(covariance.topLeftCorner<3, 3>());
}
double MotionEstimate::sigmaAngle() const
{
  return worstSigma(covariance.bottomRightCorner<3, 3>());
}

std::vector<SurfaceSample> sampleSurface(const VisualImage& image)
{
  constexpr int kAcross = 80;      // [px]
  constexpr double kReach = 0.05;  // distance of the neighbours that give the normal [m]
  constexpr int kMinRadius = 2, kMaxRadius = 8;             // [px]
  const int step = std::max(1, image.columns() / kAcross);  // [px]
  std::vector<SurfaceSample> samples;
  for (int v = step / 2; v < image.rows(); v += step)
    for (int u = step / 2; u < image.columns(); u += step)
    {
      const double z = image.depth(u, v);
      if (z <= 0) continue;
      const int radius = std::clamp(
          static_cast<int>(kReach * std::abs(image.camera().fx) / z), kMinRadius, kMaxRadius);
      if (const auto normal = normalAt(image, u, v, radius))
        samples.push_back({image.point(u, v, z), *normal});
    }
  return samples;
}

/** Normal equations H x = -g of an increment x of exp(x) T. */
struct MotionEstimator::Equations
{
  Matrix6 H = Matrix6::Zero();
  Vector6 g = Vector6::Zero();
  double cost = 0;       // weighted sum of squares
  double residuals = 0;  // sum of weights
  int count = 0;         // number of residuals
  int inliers = 0, overlap = 0, onSurface = 0;

  void add(const Vector6& J, double r, double weight)
  {
    H.selfadjointView<Eigen::Lower>().rankUpdate(J, weight);
    g += weight * r * J;
    cost += weight * r * r;
    residuals += weight;
    ++count;
  }
};

double MotionEstimator::depthVariance(double z) const
{
  const double d = z - 0.4;
  const double sigma = options_.depthSigmaFloor + options_.depthSigmaGrowth * d * d;
  return sigma * sigma;
}

std::optional<Eigen::Isometry3d> MotionEstimator::consensus(
    std::vector<Correspondence>& correspondences,
    const PinholeCamera& camera,
    int minInliers,
    int maxIterations) const
{
  constexpr float kMaxError = 2.0f;  // [px]
  constexpr double kConfidence = 0.999;
  if (static_cast<int>(correspondences.size()) < std::max(6, minInliers)) return std::nullopt;
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (const auto& c : correspondences)
  {
    points.emplace_back(c.point_from.x(), c.point_from.y(), c.point_from.z());
    pixels.emplace_back(c.pixel_to.x(), c.pixel_to.y());
  }
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  cv::Vec3d rotation, translation;
  std::vector<int> inliers;
  // OpenCV starts the random numbers of RANSAC anew with every call.
  const bool found = cv::solvePnPRansac(
      points, pixels, K, cv::noArray(), rotation, translation, false, maxIterations, kMaxError,
      kConfidence, inliers, cv::SOLVEPNP_P3P);
  if (!found || static_cast<int>(inliers.size()) < minInliers) return std::nullopt;
  std::vector<Correspondence> kept;
  for (const int i : inliers) kept.push_back(correspondences[static_cast<std::size_t>(i)]);
  correspondences = std::move(kept);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d r(rotation[0], rotation[1], rotation[2]);
  if (r.norm() > 0) T.linear() = Eigen::AngleAxisd(r.norm(), r.normalized()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(translation[0], translation[1], translation[2]);
  return T.matrix().allFinite() ? std::make_optional(T) : std::nullopt;
}

void MotionEstimator::addCorrespondences(
    const std::vector<Correspondence>& correspondences,
    const PinholeCamera& camera,
    const Eigen::Isometry3d& T_to_from,
    double sigmaPixel,
    Equations& equations) const
{
  constexpr double kInlier = 3.0;  // [sigma]
  for (const auto& c : correspondences)
  {
    const Eigen::Vector3d p = T_to_from * c.point_from;
    if (p.z() < kMinDepth) continue;
    Eigen::Matrix<double, 3, 6> dp;
    dp << Eigen::Matrix3d::Identity(), -crossMatrix(p);
    const Eigen::RowVector3d du(camera.fx / p.z(), 0, -camera.fx * p.x() / (p.z() * p.z()));
    const Eigen::RowVector3d dv(0, camera.fy / p.z(), -camera.fy * p.y() / (p.z() * p.z()));
    const Eigen::Vector2d r = (camera.project(p) - c.pixel_to) / sigmaPixel;
    const double weight = kKernel.weight(r.norm());
    equations.add((du * dp).transpose() / sigmaPixel, r.x(), weight);
    equations.add((dv * dp).transpose() / sigmaPixel, r.y(), weight);
    bool agrees = r.norm() < kInlier;
    if (c.depth_to > 0)
    {
      const double sigma = std::sqrt(depthVariance(c.point_from.z()) + depthVariance(c.depth_to));
      const double rz = (p.z() - c.depth_to) / sigma;
      equations.add(dp.row(2).transpose() / sigma, rz, kKernel.weight(rz));
      agrees = agrees && std::abs(rz) < kInlier;
    }
    if (agrees) ++equations.inliers;
  }
}

void MotionEstimator::addSurface(
    const std::vector<SurfaceSample>& surface,
    const VisualImage& to,
    const Eigen::Isometry3d& T_to_from,
    double gate,
    Equations& equations) const
{
  for (const auto& sample : surface)
  {
    const Eigen::Vector3d p = T_to_from * sample.point;
    if (p.z() < kMinDepth) continue;
    const Eigen::Vector2d pixel = to.camera().project(p);
    if (!to.inside(pixel.x(), pixel.y())) continue;
    const int u = static_cast<int>(std::lround(pixel.x()));
    const int v = static_cast<int>(std::lround(pixel.y()));
    const double z = to.depth(u, v);
    if (z <= 0) continue;
    ++equations.overlap;
    const Eigen::Vector3d n = T_to_from.linear() * sample.normal;
    const double gap = n.dot(p - to.point(u, v, z));  // [m]
    const double sigma = std::sqrt(depthVariance(p.z()) + depthVariance(z));
    if (std::abs(gap) > gate + 3 * sigma) continue;
    ++equations.onSurface;
    Vector6 J;
    J << n, p.cross(n);
    const double r = gap / sigma;
    const double weight = options_.denseWeight * kKernel.weight(r);
    equations.add(J / sigma, r, weight);
  }
}

std::optional<MotionEstimate> MotionEstimator::refine(
    const std::vector<Correspondence>& correspondences,
    const std::vector<SurfaceSample>& surface,
    const VisualImage& to,
    const Eigen::Isometry3d& T_to_from,
    double sigmaPixel) const
{
  constexpr int kMaxIterations = 12;
  constexpr int kMinResiduals = 12;  // twice the six unknowns
  constexpr double kFirstGate = 0.08,
                   kLastGate = 0.02;  // largest distance of matching surfaces [m]
  // doc/mathematics.md, (15.8). Errors of neighbouring corners and surfaces are alike. Over steps
  // of one and two images of simulated homes (random seeds 1 and 5) the squared errors are
  // therefore 4 and 6.4 times what independent errors would give.
  constexpr double kCorrelation = 6;
  constexpr double kSmallStep = 1e-5;  // [m] and [rad]
  MotionEstimate estimate;
  estimate.T_to_from = T_to_from;
  estimate.found = static_cast<int>(correspondences.size());
  double gate = kFirstGate;
  for (int i = 0; i < kMaxIterations; ++i)
  {
    Equations equations;
    addCorrespondences(correspondences, to.camera(), estimate.T_to_from, sigmaPixel, equations);
    if (options_.denseWeight > 0) addSurface(surface, to, estimate.T_to_from, gate, equations);
    const Eigen::LDLT<Matrix6> solver(equations.H.selfadjointView<Eigen::Lower>());
    if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 1e-6) ||
        equations.count < kMinResiduals)
      return std::nullopt;
    const Vector6 step = -solver.solve(equations.g);
    if (!step.allFinite()) return std::nullopt;
    const double variance = equations.cost / std::max(1.0, equations.residuals - 6);
    estimate.covariance = kCorrelation * variance * solver.solve(Matrix6::Identity());
    estimate.inliers = equations.inliers;
    estimate.overlap = equations.overlap;
    estimate.surfaceShare =
        equations.overlap > 0 ? static_cast<double>(equations.onSurface) / equations.overlap : 0;
    if (step.norm() < kSmallStep && gate <= kLastGate) break;
    estimate.T_to_from = smallMotion(step) * estimate.T_to_from;
    gate = std::max(kLastGate, gate / 2);
  }
  return estimate;
}

}  // namespace quadmap
