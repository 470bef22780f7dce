#pragma once

#include "quadmap/surfaces/SurfaceOptions.h"

namespace quadmap
{
/** What may be made of a box; the ablation of doc/benchmarks.md needs either alone. */
enum class ObservationModels
{
  Both,
  Complete,  //!< Cuboids from depth only
  Partial    //!< Box edges only
};

/** How one frame becomes measurements. Section [perception] of the configuration. */
struct PerceptionOptions : public SurfaceOptions
{
  /** Groups of fewer pixels with one of a scan's pixelLabels are no object [px], >= 1: 10 x 10 are
   * too few to measure anything. */
  int minLabelPixels = 100;

  double boxMargin = 0.05;  //!< Detector boxes are enlarged by this share of their size
  /** Gap between parts of one object: a share of its size, at most `clusterTolerance`, and at
   * least `clusterToleranceGrowth` times the range, where the depth camera's pixels are as far
   * apart. */
  double clusterToleranceShare = 0.06;    //!< Of the object's size, from its box and range [-]
  double clusterTolerance = 0.05;         //!< [m], > 0
  double clusterToleranceGrowth = 0.012;  //!< [-], >= 0
  int minPoints = 60;  //!< Fewest points (of an image 320 px wide) worth a fit, >= 10

  ObservationModels models = ObservationModels::Both;  //!< INI: both, complete, partial
  double yawMinDominance = 0.40;   //!< Peak mass that makes a direction; even spread gives 0.22
  double minCompleteIoU = 0.70;    //!< p' of doc/mathematics.md that makes a measurement complete
  double minDepthCoverage = 0.30;  //!< Least share of valid depth in the box for a complete one

  /** Pixels of images 640 px wide; they scale with the width. */
  double borderMargin = 30;   //!< Box edges this near to the border are cut; 0: the rule is off
  double occlusionStrip = 8;  //!< Width of the strip outside an edge that is looked at
  /** An edge is not used when the object goes on beyond it with more than this probability; 1: the
   * rule is off. 0.06: below 2 % of the edges in use are wrong in most simulated rooms
   * (doc/benchmarks.md). */
  double maxHiddenProbability = 0.06;
  /** What a detector's box edge may be off by when boxes are compared with what the depth shows [px
   * of an image 640 px wide], > 0: detectors look at images of one size, whatever the camera's. */
  double edgeTolerance = 6.0;
  /** Standard deviation of a box edge: this [px of an image 640 px wide], > 0, and that share of
   * the box's size across the edge, >= 0. A real detector's edges jitter by about three quarters of
   * it (doc/guide/write-a-scene.md); the rest is for what it gets wrong alike in all images. */
  double edgeSigma = 1.7;
  double edgeSigmaShare = 0.013;

  /** Options in pixels are meant for images 640 px wide, and grow with the image [px]. */
  static double scaledPixels(double pixels, unsigned imageWidth)
  {
    return pixels * imageWidth / 640.0;
  }
  double edgeToleranceIn(unsigned imageWidth) const
  {
    return scaledPixels(edgeTolerance, imageWidth);
  }
  /** \param size Of the box, across the edge [px]. \return [px] */
  double edgeSigmaIn(unsigned imageWidth, double size) const
  {
    return scaledPixels(edgeSigma, imageWidth) + edgeSigmaShare * size;
  }
  double borderMarginIn(unsigned imageWidth) const
  {
    return scaledPixels(borderMargin, imageWidth);
  }

 private:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
