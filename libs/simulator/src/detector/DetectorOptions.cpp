#include <utility>

#include "quadmap/base/OptionList.h"
#include "quadmap/simulator/SimulatorOptions.h"

namespace quadmap::simulator
{
namespace
{
constexpr std::pair<DetectorOutput, const char*> kOutputs[] = {
    {    DetectorOutput::Boxes,     "boxes"},
    {    DetectorOutput::Masks,     "masks"},
    {  DetectorOutput::Classes,   "classes"},
    {DetectorOutput::Instances, "instances"},
};

void describeOutput(DetectorOptions& o, OptionList& list)
{
  list.choice(
      "output", o.output, kOutputs,
      "boxes gives boxes. masks gives boxes with masks. classes labels the pixels of the scan by "
      "label. instances labels them by label and number.");
  list.number(
      "maskJitter", o.maskJitter, {0, 50}, "px of an image 640 px wide",
      "Standard deviation of the border of a mask. The default is that of a grid of stride 4.");
  list.flag(
      "instanceIds", o.instanceIds,
      "True gives boxes the number of their object. False alarms have none.");
}

/** Errors that stay while the view stays. */
void describeViews(DetectorOptions& o, OptionList& list)
{
  list.number(
      "viewAngle_deg", o.viewAngle_deg, {1, 180}, "deg",
      "An object looks the same to a network, which errs in the same way, as long as it is seen "
      "from within so much, and from distances within a factor of 1.35.");
  list.number(
      "viewEdges", o.viewEdges, {0, 1}, "",
      "Scale of the errors of edges of a view, which have long tails, as a share of the square "
      "root of width times height of the box.");
  list.number(
      "viewMisses", o.viewMisses, {0, 1}, "", "Share of views in which an object is not found.");
  list.number(
      "viewFlips", o.viewFlips, {0, 1}, "",
      "Share of views with a label that the object is mistaken for.");
  list.number(
      "viewParts", o.viewParts, {0, 1}, "", "Share of views in which only a part is boxed.");
  list.number(
      "viewMergers", o.viewMergers, {0, 1}, "",
      "Share of views in which the box holds a neighbour of the same kind as well.");
}

}  // namespace

std::optional<DetectorOutput> detectorOutputOf(const std::string& name)
{
  for (const auto& [output, known] : kOutputs)
    if (name == known) return output;
  return std::nullopt;
}

void DetectorOptions::describe(OptionList& list)
{
  constexpr const char* kPixels = "px of an image 640 px wide";
  list.about("What a detector finds in the images.");
  describeOutput(*this, list);
  list.number("jitter", jitter, {0, 100}, kPixels, "Standard deviation of each edge of a box.");
  list.number(
      "relativeJitter", relativeJitter, {0, 1}, "",
      "The rest of it, as a share of the square root of width times height of the box.");
  list.number(
      "minVisible", minVisible, {0, 1}, "",
      "Nothing is found below this visible share of the outline.");
  list.number(
      "minSize", minSize, {1, 1000}, kPixels,
      "Smallest square root of width times height of a box that is found.");
  list.number("missRate", missRate, {0, 1}, "", "Share of fully visible objects that are missed.");
  list.number(
      "occludedMissRate", occludedMissRate, {0, 1}, "",
      "Share of objects that are missed when just minVisible of them is left.");
  list.number("falseAlarms", falseAlarms, {0, 10}, "per frame", "Number of boxes around nothing.");
  list.number(
      "flipRate", flipRate, {0, 1}, "",
      "Share of boxes with a label that the object is mistaken for.");
  describeViews(*this, list);
}

}  // namespace quadmap::simulator
