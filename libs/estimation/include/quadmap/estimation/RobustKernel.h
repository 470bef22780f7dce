#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadmap
{
/** A residual under a robust kernel, as it enters a sum of squares:
 * 1/2 value^2 = weight * cost of the residual, and slope = d(value) / d(residual). */
struct RobustRow
{
  double value = 0, slope = 1;
};

/** Cost of a residual r that may be wrong altogether. Residuals are in standard deviations. */
class RobustKernel
{
 public:
  /** The plain square, 1/2 r^2. */
  static constexpr RobustKernel quadratic()
  {
    return {Kind::Huber, std::numeric_limits<double>::infinity()};
  }
  /** Huber's kernel, doc/mathematics.md, (11.12): a straight line beyond the threshold h > 0. */
  static constexpr RobustKernel huber(double h) { return {Kind::Huber, h}; }
  /** Cauchy's kernel, as in doc/mathematics.md, (11.28) and (19.8): the pull fades with the
   * distance; h > 0. */
  static constexpr RobustKernel cauchy(double h) { return {Kind::Cauchy, h}; }
  /** Geman and McClure's kernel for r > 0, doc/mathematics.md, (11.13), and no cost at all for
   * r <= 0: of an inequality r <= 0 that is wrong altogether now and then. However far it is off,
   * it costs less than h^2; h > 0. */
  static constexpr RobustKernel inequality(double h) { return {Kind::Inequality, h}; }

  double cost(double r) const
  {
    if (isSatisfied(r)) return 0;
    switch (kind_)
    {
      case Kind::Cauchy:
        return 0.5 * h_ * h_ * std::log1p(r * r / (h_ * h_));
      case Kind::Inequality:
        return h_ * h_ / (1 + 1 / inequalitySquare(r));
      default:
        break;
    }
    const double size = std::abs(r);
    return size <= h_ ? 0.5 * r * r : h_ * size - 0.5 * h_ * h_;
  }

  /** Derivative of the cost by r, divided by r: the weight in the normal equations, in [0, 1]. */
  double weight(double r) const
  {
    if (isSatisfied(r)) return 0;
    switch (kind_)
    {
      case Kind::Cauchy:
        return 1 / (1 + r * r / (h_ * h_));
      case Kind::Inequality:
        return std::pow(1 + inequalitySquare(r), -2);
      default:
        break;
    }
    const double size = std::abs(r);
    return size <= h_ ? 1.0 : h_ / size;
  }

  /** sign(r) sqrt(2 cost), doc/mathematics.md, (16.6) and (16.7) with w = 1.
   * \tparam T double or an automatic-differentiation scalar. */
  template <typename T>
  T root(const T& r) const
  {
    using std::log1p;
    using std::sqrt;
    if (kind_ == Kind::Huber)
    {
      if (r > h_) return sqrt(h_ * (2.0 * r - h_));
      if (r < -h_) return -sqrt(h_ * (-2.0 * r - h_));
      return r;
    }
    if (kind_ == Kind::Inequality) return r <= 0.0 ? T(0) : r / sqrt(1.0 + inequalitySquare(r));
    const T u = r * r / (h_ * h_);
    if (u < kNearZero) return r;  // the root of u has no derivative at 0
    const T size = h_ * sqrt(log1p(u));
    return r < 0.0 ? -size : size;
  }

  /** root() times sqrt(w), with its derivative. \param w Weight of the residual, > 0. */
  RobustRow row(double r, double w) const
  {
    const double rootOfWeight = std::sqrt(w);
    if (isSatisfied(r)) return {0, 0};
    const double value = root(r);
    // 1/2 value^2 = cost, and so value * slope = weight(r) * r.
    const double slope = value == r ? 1.0 : weight(r) * r / value;
    return {rootOfWeight * value, rootOfWeight * slope};
  }

 private:
  enum class Kind
  {
    Huber,
    Cauchy,
    Inequality
  };
  static constexpr double kNearZero = 1e-20;  // of r^2 / h^2

  constexpr RobustKernel(Kind kind, double h) : kind_(kind), h_(h) {}
  bool isSatisfied(double r) const { return kind_ == Kind::Inequality && r <= 0; }

  /** r^2 / (2 h^2) of doc/mathematics.md, (11.13). */
  template <typename T>
  T inequalitySquare(const T& r) const
  {
    return r * r / (2 * h_ * h_);
  }

  Kind kind_;
  double h_;  // threshold or scale [sigmas]
};

/** Scale of Cauchy's kernel over all that is known of an object, c of doc/mathematics.md, (19.8)
 * [sigmas]: the chi of its seven numbers exceeds it once in a hundred. */
constexpr double kObjectKernel = 4.3;

}  // namespace quadmap
