#pragma once

#include <optional>

#include "cuboid/FaceEstimator.h"

namespace quadmap
{
/** Tells whether something that is no part of an object holds it up above its support: detectors
 * draw their box around the panel of a screen, without the stand (doc/mathematics.md, (8.12)). All
 * references must outlive it. */
class HeldUp
{
 public:
  HeldUp(
      const PinholeCamera& camera,
      const FaceEstimator& estimator,
      const LabelProperties& label,
      const PerceptionOptions& options);

  /** Where the object ends, along its -z from the camera [m]. It is where the cloud ends clear of
   * the support, if the box ends there as well; and where the box ends, if that is too soon for
   * this end; unless most of the cloud goes on down to the support. What usually stands on floors
   * is not held up, nor is what something hides. \param faces With the support at the bottom where
   * one is known. \return Nothing of what stands. */
  std::optional<double> bottomOf(const Faces& faces) const;

  /** The bottom of the part above it, as bottomOf() gave it. \param faces Of this part alone. */
  FaceEstimate bottomAt(double position, const Faces& faces) const;

 private:
  double overhang(double bottom, const Faces& faces) const;
  std::optional<double> bottomInBox(double from, const Faces& faces) const;

  const FaceEstimator& estimator_;
  const LabelProperties& label_;
  const PerceptionOptions& options_;
  /** The edge of the box that the bottom looks out over most, about the camera along the axes of
   * the object. Nothing when it tells nothing of the bottom, as from straight above. Over another
   * edge a side may reach out. */
  std::optional<Plane> edge_obj_;
  double edgeSigma_ = 0;  // [m]
};

/** The part of an object above a bottom, as HeldUp::bottomOf() gives it. Its mask, its box and what
 * is known around it stay those of the whole. \param up Unit, optical frame. */
ObjectCloud partAbove(double bottom, const Eigen::Vector3d& up, const ObjectCloud& object);

}  // namespace quadmap
