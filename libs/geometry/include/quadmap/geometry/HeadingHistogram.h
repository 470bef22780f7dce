#pragma once

#include <vector>

namespace quadmap
{
/** The dominant horizontal direction of a set of surface normals, folded modulo 90 degrees
 * (doc/mathematics.md: weighted by how horizontal the normal is, smoothed, sub-bin peak). */
class HeadingHistogram
{
 public:
  HeadingHistogram();

  /** \param heading Direction of the normal's horizontal part [rad]. \param weight >= 0. */
  void add(double heading, double weight);

  /** The highest peak, equation (8.1). */
  struct Peak
  {
    double yaw = 0;        //!< In [0, pi/2) [rad]
    double dominance = 0;  //!< Mass within 10 degrees of the peak / total; even spread gives 0.22
    double mass = 0;       //!< Total weight
    double width = 0;      //!< Standard deviation within 10 degrees of the peak [rad]
  };
  Peak peak() const;

 private:
  struct Entry
  {
    double yaw, weight;
  };
  std::vector<double> bins_;
  std::vector<Entry> entries_;
};

}  // namespace quadmap
