#include "quadmap/slam/SlamOptions.h"

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <utility>

#include "quadmap/base/NamedValues.h"
#include "quadmap/base/OptionList.h"
#include "quadmap/detection/KnownDetectors.h"

namespace quadmap
{
namespace
{
constexpr std::pair<SlamMethod, const char*> kMethods[] = {
    {    SlamMethod::Rgbd,     "rgbd"},
    { SlamMethod::Quadric,  "quadric"},
    {   SlamMethod::Point,    "point"},
    {SlamMethod::Odometry, "odometry"}
};

const std::string kGraph = "graph:";  // followed by the name of the file

constexpr unsigned kUsefulThreads = 4;      // the input, and the three stages of a keyframe
constexpr unsigned kThreadsOfDetector = 1;  // one more stage

constexpr std::pair<AssociationSource, const char*> kAssociations[] = {
    {AssociationSource::Estimated, "estimated"},
    {    AssociationSource::Given,     "given"}
};

/** \exception std::invalid_argument If there is no such model file. */
void requireModel(const std::string& name)
try
{
  if (!name.empty()) modelFileOf(name);
}
catch (const std::runtime_error& e)
{
  throw std::invalid_argument("detector=" + std::string(e.what()));
}

}  // namespace

SlamMethod slamMethodFrom(const std::string& name) { return valueNamed(kMethods, "method", name); }
std::string nameOf(SlamMethod method) { return nameIn(kMethods, method); }

void SlamOptions::setOdometry(const std::string& name)
{
  const bool isGraph = name.rfind(kGraph, 0) == 0 && name.size() > kGraph.size();
  odometry = isGraph ? PoseSource::Graph : poseSourceFrom(name);
  odometryGraph = isGraph ? name.substr(kGraph.size()) : "";
}

std::string SlamOptions::odometryName() const
{
  return odometry == PoseSource::Graph ? kGraph + odometryGraph : nameOf(odometry);
}

void SlamOptions::setThreads(int number)
{
  if (number < 0 || number > kMostThreads)
    throw std::invalid_argument(
        "threads=" + std::to_string(number) + ": must be between 0 and " +
        std::to_string(kMostThreads));
  threads = number;
}

std::size_t SlamOptions::workingThreads() const
{
  if (threads > 0) return static_cast<std::size_t>(threads);
  const unsigned useful = kUsefulThreads + (findsBoxes() ? kThreadsOfDetector : 0);
  return std::clamp(std::thread::hardware_concurrency(), 1u, useful);
}

AssociationSource associationSourceFrom(const std::string& name)
{
  return valueNamed(kAssociations, "association", name);
}
std::string nameOf(AssociationSource source) { return nameIn(kAssociations, source); }

void SlamOptions::describe(OptionList& list)
{
  list.about(
      "What is made of the input. --method, --odometry, --association, --detector and --threads on "
      "the command line come before this section.");
  list.choice(
      "method", method, kMethods,
      "rgbd makes objects from boxes and depth. quadric makes them from box edges alone, as "
      "QuadricSLAM, for comparison. point makes them from the centres of the measurements alone, "
      "for comparison. odometry makes the trajectory alone.");
  list.text(
      "odometry", [this] { return odometryName(); },
      [this](const std::string& name) { setOdometry(name); },
      "auto, rawlog, visual, ground-truth, graph:FILE",
      "Where poses come from. rawlog is its odometry. visual is visual odometry from the images. "
      "ground-truth is its \"ground_truth\" poses. graph:FILE is the nodes of a pose graph. auto "
      "is "
      "the rawlog's odometry or, without any, visual odometry. Images of one moment need none.");
  list.text(
      "detector", [this] { return detector; },
      [this](const std::string& name)
      {
        requireModel(name);
        detector = name;
      },
      "a name, a file, nothing",
      "The model that finds the boxes of the keyframes, by name or as a model file (.ini); "
      "quadmap-detect --list prints the names. Boxes of the input are then ignored. Without one "
      "the "
      "input has the boxes.");
  list.integer(
      "threads", threads, {0, kMostThreads}, "",
      "Threads that work, as with --threads. 0 takes as many as useful. The results are the same "
      "with any number.");
  list.choice(
      "association", association, kAssociations,
      "Which object a box shows. estimated decides from labels, positions and sizes. given takes "
      "the instance ids of the boxes and leaves out the boxes without one.");
}

void InputOptions::describe(OptionList& list)
{
  list.about("How the records of a rawlog are paired.");
  list.number(
      "maxBoxDelay", maxBoxDelay, {0, 10}, "s",
      "Boxes belong to an image when their times differ by no more than this.");
  list.number(
      "maxOdometryGap", maxOdometryGap, {1e-3, 3600}, "s",
      "Poses are interpolated over no longer time than this.");
  list.flag(
      "imagesAnywhere", imagesAnywhere,
      "Whether a rawlog may name images that lie outside its own image folder. Results hold copies "
      "of the images, and a rawlog from somebody else could name any file of yours.");
  list.integer(
      "maxImageMegapixels", maxImageMegapixels, {1, 256}, "1048576 pixels",
      "Larger images are refused before memory is taken for them. A run holds several at a time: "
      "with 16 it stays below 1 GB whatever a damaged file states.");
}

}  // namespace quadmap
