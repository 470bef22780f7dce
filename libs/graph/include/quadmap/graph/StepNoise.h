#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

namespace quadmap
{
/** How many times as large as the odometry claims the standard deviations of its steps are
 * (doc/mathematics.md, "What odometry errs by"). */
struct StepNoise
{
  double position = 1, angle = 1;

  /** The same, with what is below 1 raised to 1. */
  StepNoise atLeastClaimed() const;
};

/** The step with its covariance scaled. */
mrpt::poses::CPose3DPDFGaussian scaled(
    mrpt::poses::CPose3DPDFGaussian step, const StepNoise& noise);

/** How the residuals of steps compare with what is to be expected of them. Both in claimed standard
 * deviations, squared. */
struct StepFit
{
  struct Sums
  {
    double squares = 0;     //!< Of the residuals
    double redundancy = 0;  //!< Their expected sum if the claims are right
  };
  Sums position, angle;

  StepFit& operator+=(const StepFit& other);
};

/** The noise that explains the residuals, doc/mathematics.md, (16.22).
 * \param claimWeight As how many residuals the claim itself counts, > 0. */
StepNoise stepNoiseOf(const StepFit& fit, double claimWeight);

}  // namespace quadmap
