#include "tum/TumFiles.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <utility>

#include "frames/FolderReader.h"
#include "quadmap/base/Words.h"
#include "quadmap/obs/UnusableLines.h"
#include "text/TextLines.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

constexpr double kTumDepthFactor = 5000;
/** Most depth images that may be near one colour image: those of a camera at 2.5 kHz. */
constexpr std::ptrdiff_t kMostCandidates = 100;

/** Images that someone has paired are at most so far apart in time [s]. */
constexpr double kFarthestPair = 1;

struct ListedImage
{
  double time;  // [s]
  std::string file, place;
};

/** The path of an image in a list. \exception std::runtime_error If it leads out of the folder. */
std::string fileIn(const TextLine& line, std::size_t column)
{
  const fs::path file = fs::path(line.words[column]).lexically_normal();
  if (file.is_absolute() || *file.begin() == "..")
    throw std::runtime_error(
        line.place + ": " + quotedWord(line.words[column]) + " must be a path inside the folder");
  return line.words[column];
}

std::vector<std::string> imagesOf(const ListedImage& image) { return {image.file}; }
std::vector<std::string> imagesOf(const FolderFrame& frame) { return {frame.color, frame.depth}; }

/** What the lines of a list have. Those that cannot be used, and those of an image that another one
 * has, become problems of the content. */
template <typename Item>
std::vector<Item> readList(
    const std::string& path, Item (*itemOf)(const TextLine& line), FolderContent& content)
{
  std::vector<Item> items;
  std::map<fs::path, std::string> lines;  // of the images
  std::vector<std::string> unusable;
  for (const auto& line : readTextLines(path, &unusable)) try
    {
      Item item = itemOf(line);
      for (const auto& image : imagesOf(item))
        if (const auto first = lines.find(fs::path(image).lexically_normal()); first != lines.end())
          throw std::runtime_error(
              line.place + ": " + image + " stands in line " + first->second + " as well");
      for (const auto& image : imagesOf(item))
        lines[fs::path(image).lexically_normal()] = line.place.substr(line.place.rfind(':') + 1);
      items.push_back(std::move(item));
    }
    catch (const std::runtime_error& e)
    {
      noteUnusable(unusable, path, e.what());
    }
  content.listProblems.insert(content.listProblems.end(), unusable.begin(), unusable.end());
  return items;
}

/** A line of rgb.txt or depth.txt. */
ListedImage imageIn(const TextLine& line)
{
  requireColumns(line, 2);
  return {timeIn(line, 0), fileIn(line, 1), line.place};
}

/** Adds the frames of images that are near each other in time. */
void associate(
    const std::vector<ListedImage>& colors,
    const std::vector<ListedImage>& depths,
    double maxDelay,
    FolderContent& content)
{
  struct Pair
  {
    double delay;
    std::size_t color, depth;
  };
  std::vector<std::size_t> order(depths.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto earlier = [&](std::size_t a, std::size_t b)
  { return depths[a].time < depths[b].time; };
  std::stable_sort(order.begin(), order.end(), earlier);
  std::vector<Pair> pairs;
  for (std::size_t c = 0; c < colors.size(); ++c)
  {
    const auto before = [&](std::size_t depth, double t) { return depths[depth].time < t; };
    auto d = std::lower_bound(order.begin(), order.end(), colors[c].time - maxDelay, before);
    const auto after = [&](double t, std::size_t depth) { return t < depths[depth].time; };
    const auto end = std::upper_bound(d, order.end(), colors[c].time + maxDelay, after);
    if (end - d > kMostCandidates)
      throw std::runtime_error(mrpt::format(
          "%s: %td depth images are within %g ms of it, expected at most %td",
          colors[c].place.c_str(), end - d, 1e3 * maxDelay, kMostCandidates));
    for (; d != end; ++d) pairs.push_back({std::abs(depths[*d].time - colors[c].time), c, *d});
  }
  const auto closer = [](const Pair& a, const Pair& b) { return a.delay < b.delay; };
  std::stable_sort(pairs.begin(), pairs.end(), closer);

  std::vector<std::size_t> depthOf(colors.size(), depths.size());
  std::vector<bool> used(depths.size(), false);
  for (const auto& pair : pairs)
    if (!used[pair.depth] && depthOf[pair.color] == depths.size())
    {
      used[pair.depth] = true;
      depthOf[pair.color] = pair.depth;
    }
  const auto path = [&](const ListedImage& image)
  { return (fs::path(content.folder) / image.file).string(); };
  for (std::size_t c = 0; c < colors.size(); ++c)
    if (depthOf[c] < depths.size())
    {
      const auto& depth = depths[depthOf[c]];
      content.frames.push_back({depth.time, colors[c].file, depth.file, colors[c].place, {}});
    }
    else
      content.addUnpaired(path(colors[c]));
  for (std::size_t d = 0; d < depths.size(); ++d)
    if (!used[d]) content.addUnpaired(path(depths[d]));
}

/** A line of associations.txt: colour first, or depth first as in ICL-NUIM, which the names of the
 * files tell. */
FolderFrame pairIn(const TextLine& line)
{
  requireColumns(line, 4);
  const auto isDepth = [&](std::size_t column)
  { return line.words[column].find("depth") != std::string::npos; };
  const std::size_t depth = isDepth(1) && !isDepth(3) ? 0 : 2, color = 2 - depth;
  const double time = timeIn(line, depth), apart = std::abs(timeIn(line, color) - time);
  if (apart > kFarthestPair)
    throw std::runtime_error(
        mrpt::format("%s: the times of the two images are %g s apart", line.place.c_str(), apart));
  return {time, fileIn(line, color + 1), fileIn(line, depth + 1), line.place, {}};
}
}  // namespace

void readTumFrames(FolderContent& content, double maxDelay)
{
  const auto in = [&](const std::string& name)
  { return (fs::path(content.folder) / name).string(); };
  auto& frames = content.frames;
  if (fs::exists(in("associations.txt")))
  {
    frames = readList(in("associations.txt"), pairIn, content);
    content.pairing = "as associations.txt says";
  }
  else if (fs::exists(in("rgb.txt")) && fs::exists(in("depth.txt")))
  {
    const auto colors = readList(in("rgb.txt"), imageIn, content),
               depths = readList(in("depth.txt"), imageIn, content);
    associate(colors, depths, maxDelay, content);
    content.pairing = mrpt::format("by time, at most %g ms apart", 1e3 * maxDelay);
  }
  else
    throw std::runtime_error(
        content.folder + ": has neither associations.txt nor rgb.txt and depth.txt");
  requireFrames(content, "lists no colour image with a depth image");
  for (auto& frame : frames)
  {
    frame.color = in(frame.color);
    frame.depth = in(frame.depth);
  }
}

bool isTumFolder(const std::string& folder)
{
  const auto has = [&](const char* name) { return fs::exists(fs::path(folder) / name); };
  return has("associations.txt") || (has("rgb.txt") && has("depth.txt"));
}

FolderContent readTumFolder(const std::string& folder, const FrameFolderOptions& options)
{
  FolderContent content;
  content.folder = folder;
  content.camera = cameraOfFolder(folder, options, "", kTumDepthFactor);
  takeDepthAsRegistered(content);
  readTumFrames(content, options.maxPairDelay);
  const std::string poses = (fs::path(folder) / "groundtruth.txt").string();
  if (fs::exists(poses))
    takePoses(content, poses, options.maxPoseGap);
  else
    content.notes.push_back(folder + ": no groundtruth.txt, hence no poses");
  return content;
}

}  // namespace quadmap
