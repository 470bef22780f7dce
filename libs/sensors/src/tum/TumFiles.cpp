#include "tum/TumFiles.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** One line of a text file, cut at blanks. */
struct Line
{
  std::string place;  // "file:12"
  std::vector<std::string> words;
};

/** Three hours of images at 30 Hz. In memory a line takes many times its length. */
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 24;

/** All lines that are neither empty nor comments. */
std::vector<Line> readLines(const std::string& path, std::size_t columns)
{
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot open");
  requireModestText(path, kMostBytes);
  std::vector<Line> lines;
  std::size_t number = 0;
  for (std::string text; std::getline(file, text);)
  {
    ++number;
    std::istringstream words(text.substr(0, text.find('#')));
    Line line{path + ":" + std::to_string(number), {}};
    for (std::string word; words >> word;) line.words.push_back(word);
    if (line.words.empty()) continue;
    if (line.words.size() != columns)
      throw std::runtime_error(mrpt::format(
          "%s: expected %zu columns, got %zu", line.place.c_str(), columns, line.words.size()));
    lines.push_back(std::move(line));
  }
  if (file.bad()) throw std::runtime_error(path + ": read error");
  return lines;
}

/** The number in a column. It may be NaN or infinite; the caller decides whether it can be used. */
double numberIn(const Line& line, std::size_t column)
{
  const std::string& word = line.words[column];
  double value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || stop != word.data() + word.size())
    throw std::runtime_error(line.place + ": '" + word + "' is not a number");
  return value;
}

double timeIn(const Line& line, std::size_t column)
{
  const double time = numberIn(line, column);
  if (!std::isfinite(time) || time < 0)
    throw std::runtime_error(line.place + ": the time " + line.words[column] + " must be >= 0 s");
  return time;
}

struct ListedImage
{
  double time;  // [s]
  std::string file, place;
};

std::vector<ListedImage> readImageList(const std::string& path)
{
  std::vector<ListedImage> images;
  for (const auto& line : readLines(path, 2))
    images.push_back({timeIn(line, 0), line.words[1], line.place});
  return images;
}

std::vector<TumFrame> associate(
    const std::vector<ListedImage>& colors, const std::vector<ListedImage>& depths, double maxDelay)
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
    const auto before = [&](std::size_t d, double t) { return depths[d].time < t; };
    auto d = std::lower_bound(order.begin(), order.end(), colors[c].time - maxDelay, before);
    for (; d != order.end() && depths[*d].time <= colors[c].time + maxDelay; ++d)
      pairs.push_back({std::abs(depths[*d].time - colors[c].time), c, *d});
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
  std::vector<TumFrame> frames;
  for (std::size_t c = 0; c < colors.size(); ++c)
    if (depthOf[c] < depths.size())
    {
      const auto& depth = depths[depthOf[c]];
      frames.push_back({depth.time, colors[c].file, depth.file, colors[c].place});
    }
  return frames;
}

}  // namespace

std::vector<TumFrame> readTumFrames(const std::string& folder, double maxDelay)
{
  const auto in = [&](const std::string& name) { return (fs::path(folder) / name).string(); };
  std::vector<TumFrame> frames;
  if (fs::exists(in("associations.txt")))
    for (const auto& line : readLines(in("associations.txt"), 4))
    {
      timeIn(line, 0);
      frames.push_back({timeIn(line, 2), line.words[1], line.words[3], line.place});
    }
  else if (fs::exists(in("rgb.txt")) && fs::exists(in("depth.txt")))
    frames = associate(readImageList(in("rgb.txt")), readImageList(in("depth.txt")), maxDelay);
  else
    throw std::runtime_error(folder + ": has neither associations.txt nor rgb.txt and depth.txt");
  if (frames.empty())
    throw std::runtime_error(folder + ": lists no colour image with a depth image");
  for (auto& frame : frames)
  {
    frame.color = in(frame.color);
    frame.depth = in(frame.depth);
  }
  return frames;
}

std::vector<DetectedObject> readDetections(const std::string& path)
{
  std::vector<DetectedObject> objects;
  for (const auto& line : readLines(path, 7))
  {
    numberIn(line, 0);
    DetectedObject object;
    object.label = line.words[1];
    object.score = numberIn(line, 2);
    object.box = {numberIn(line, 3), numberIn(line, 4), numberIn(line, 5), numberIn(line, 6)};
    objects.push_back(std::move(object));
  }
  if (objects.size() > CObservationObjects::kMostObjects)
    throw std::runtime_error(mrpt::format(
        "%s: %zu boxes in one image, at most %u can be used", path.c_str(), objects.size(),
        CObservationObjects::kMostObjects));
  return objects;
}

}  // namespace quadmap
