#include "quadmap/perception/PerceptionOptions.h"

#include <utility>

#include "quadmap/base/OptionList.h"

namespace quadmap
{
namespace
{
constexpr std::pair<ObservationModels, const char*> kModels[] = {
    {    ObservationModels::Both,     "both"},
    {ObservationModels::Complete, "complete"},
    { ObservationModels::Partial,  "partial"},
};

void describeCloud(PerceptionOptions& o, OptionList& list)
{
  list.number(
      "boxMargin", o.boxMargin, {0, 1}, "",
      "Detector boxes are enlarged by this share of their size.");
  list.number(
      "clusterToleranceShare", o.clusterToleranceShare, {1e-3, 1}, "",
      "Largest gap between parts of one object, as a share of its size.");
  list.number("clusterTolerance", o.clusterTolerance, {1e-3, 1}, "m", "Upper bound of that gap.");
  list.number(
      "clusterToleranceGrowth", o.clusterToleranceGrowth, {0, 1}, "",
      "Lower bound of that gap, as a share of the range, where pixels are as far apart.");
  list.integer(
      "minPoints", o.minPoints, {10, 1000000}, "px of an image 320 px wide",
      "Fewest points that are worth a fit.");
  list.integer(
      "minLabelPixels", o.minLabelPixels, {1, 1000000}, "px of the actual image",
      "Groups of fewer pixels with one of a scan's pixelLabels are no object.");
}

void describeChoice(PerceptionOptions& o, OptionList& list)
{
  list.number(
      "yawMinDominance", o.yawMinDominance, {0, 1}, "",
      "Share of the surface that makes a direction. An even spread gives 0.22.");
  list.number(
      "minCompleteIoU", o.minCompleteIoU, {0, 1}, "",
      "Least IoU of the projected cuboid and the box, of which each edge may move by "
      "edgeTolerance, for a complete measurement.");
  list.number(
      "minDepthCoverage", o.minDepthCoverage, {0, 1}, "",
      "Least share of valid depth in the box for a complete measurement.");
  list.choice(
      "models", o.models, kModels,
      "What is made of a box. complete makes cuboids from depth. partial makes box edges. both "
      "makes whichever fits.");
}

void describeEdges(PerceptionOptions& o, OptionList& list)
{
  constexpr const char* kPixels = "px of an image 640 px wide";
  list.number(
      "borderMargin", o.borderMargin, {0, 1000}, kPixels,
      "Box edges this near to the image border are cut. 0 turns the rule off.");
  list.number(
      "occlusionStrip", o.occlusionStrip, {1, 200}, kPixels,
      "Width of the strip outside an edge in which something may hide the object.");
  list.number(
      "maxHiddenProbability", o.maxHiddenProbability, {0, 1}, "",
      "An edge is not used when the object goes on beyond it with more than this probability. 1 "
      "turns the rule off.");
  list.number(
      "edgeTolerance", o.edgeTolerance, {1e-3, 1000}, kPixels,
      "What a box edge may be off by when boxes are compared with what the depth shows.");
  list.number(
      "edgeSigma", o.edgeSigma, {1e-3, 1000}, kPixels,
      "Fixed part of the standard deviation of a detector's box edge.");
  list.number(
      "edgeSigmaShare", o.edgeSigmaShare, {0, 1}, "",
      "The rest of it, as a share of the box's size across the edge.");
}

}  // namespace

void PerceptionOptions::describe(OptionList& list)
{
  list.about("How one frame and its boxes become measurements.");
  SurfaceOptions::describe(list);
  describeCloud(*this, list);
  describeChoice(*this, list);
  describeEdges(*this, list);
}

}  // namespace quadmap
