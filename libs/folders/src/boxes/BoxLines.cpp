#include "boxes/BoxLines.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "quadmap/base/ShareFiles.h"
#include "quadmap/base/Words.h"
#include "quadmap/folders/ClassNames.h"
#include "text/TextLines.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

constexpr std::size_t kYoloColumns = 5;     // without a score
constexpr std::size_t kOutlineColumns = 7;  // of a triangle, without a score
/** Files with the names of classes, in the order in which they are looked for. */
const std::vector<std::string> kNameFiles = {"classes.txt", "obj.names", "names.txt", "coco.names"};

bool isNumber(const TextLine& line, std::size_t column)
{
  try
  {
    numberIn(line, column);
    return true;
  }
  catch (const std::exception&)
  {
    return false;
  }
}

/** Whether a line has the number of a class and the outline of an object, x1 y1 x2 y2 ... in shares
 * of the image, as YOLO writes them for masks. The number of a track behind a box and its score
 * makes seven columns as well, but is a whole number, which coordinates hardly are. */
bool isOutline(const TextLine& line)
{
  if (line.words.size() < kOutlineColumns) return false;
  for (std::size_t i = 0; i < line.words.size(); ++i)
    if (!isNumber(line, i)) return false;
  for (std::size_t i = 1; i < line.words.size(); ++i)
    if (const double share = numberIn(line, i); !(share >= 0 && share <= 1)) return false;
  const double last = numberIn(line, line.words.size() - 1);
  return line.words.size() > kOutlineColumns || last != std::floor(last);
}

/** The bounds of an outline, in shares of the image. */
ImageBox boundsOfOutline(const TextLine& line)
{
  ImageBox bounds{1, 1, 0, 0};
  for (std::size_t i = 1; i + 1 < line.words.size(); i += 2)
  {
    const double x = numberIn(line, i), y = numberIn(line, i + 1);
    bounds.x1 = std::min(bounds.x1, x);
    bounds.y1 = std::min(bounds.y1, y);
    bounds.x2 = std::max(bounds.x2, x);
    bounds.y2 = std::max(bounds.y2, y);
  }
  return bounds;
}

/** Text files beside each other, one per image. */
class BoxLines : public BoxReader
{
 public:
  explicit BoxLines(std::string folder) : folder_(std::move(folder)) {}

  std::optional<std::vector<DetectedObject>> boxes(
      const FolderFrame& frame, const mrpt::img::TCamera& camera) const override
  {
    const std::string file = fileOf(frame);
    if (!fs::exists(file)) return std::nullopt;
    std::vector<DetectedObject> objects;
    for (const auto& line : readTextLines(file))
    {
      objects.push_back(boxIn(line, camera));
      requireFewBoxes(objects.size(), file);
    }
    return objects;
  }

  std::string fileOf(const FolderFrame& frame) const override
  {
    std::string file;
    for (const auto& name : namesOf(frame))
    {
      file = (fs::path(folder_) / (name + ".txt")).string();
      if (fs::exists(file)) break;
    }
    return file;
  }

  std::vector<std::string> placesOf(const FolderFrame& frame) const override
  {
    std::vector<std::string> places;
    for (const auto& line : readTextLines(fileOf(frame))) places.push_back(line.place);
    return places;
  }

 protected:
  virtual DetectedObject boxIn(const TextLine& line, const mrpt::img::TCamera& camera) const = 0;

  std::string folder_;
};

class NamedBoxes : public BoxLines
{
 public:
  NamedBoxes(const std::string& folder, std::string labels) :
      BoxLines(folder), labels_(std::move(labels))
  {
  }
  std::string description() const override { return folder_ + " (a line per box)"; }
  std::string note() const override { return noteOfNamedClasses(folder_, labels_); }

 private:
  DetectedObject boxIn(const TextLine& line, const mrpt::img::TCamera&) const override
  {
    constexpr std::size_t kColumns = 7, kBehindName = 5;
    if (line.words.size() < kColumns) requireColumns(line, kColumns);
    const double id = numberIn(line, 0);
    if (!(id >= 0 && id == std::floor(id)))
      throw std::runtime_error(
          line.place + ": the number of a class is " + quotedWord(line.words[0]) +
          ", not a whole one");
    const std::size_t end = line.words.size() - kBehindName;
    DetectedObject object;
    object.label = line.words[1];
    for (std::size_t i = 2; i < end; ++i) object.label += " " + line.words[i];
    requireClassName(object.label, line.place);
    if (end == 2 && isNumber(line, 1))
      throw std::runtime_error(
          line.place + ": the name of a class is " + quotedWord(object.label) +
          ", a number; YOLO's lines have 5 columns, or 6 with the score, but no number of a "
          "track");
    object.score = numberIn(line, end);
    object.box = {
        numberIn(line, end + 1), numberIn(line, end + 2), numberIn(line, end + 3),
        numberIn(line, end + 4)};
    return object;
  }

  std::string labels_;
};

class YoloBoxes : public BoxLines
{
 public:
  /** \param namesFile The names of the classes, those of COCO when there is none. */
  YoloBoxes(const std::string& folder, const std::optional<std::string>& namesFile) :
      BoxLines(folder),
      hasOwnNames_(namesFile.has_value()),
      namesFile_(hasOwnNames_ ? *namesFile : findShareFile("detectors/coco.names")),
      names_(readClassNames(namesFile_))
  {
  }
  std::string description() const override
  {
    return folder_ + " (YOLO's save_txt, names of " + namesFile_ + ")";
  }
  std::string note() const override
  {
    return hasOwnNames_ ? std::string() : noteOfUnnamedClasses(folder_);
  }

 private:
  DetectedObject boxIn(const TextLine& line, const mrpt::img::TCamera& camera) const override
  {
    const std::size_t columns = line.words.size();
    const bool hasOutline = isOutline(line);
    if (!hasOutline && columns != kYoloColumns + 1) requireColumns(line, kYoloColumns);
    const double id = numberIn(line, 0);
    if (!(id >= 0 && id < static_cast<double>(names_.size()) && id == std::floor(id)))
      throw std::runtime_error(mrpt::format(
          "%s: class %s is none of the %zu of %s", line.place.c_str(),
          quotedWord(line.words[0]).c_str(), names_.size(), namesFile_.c_str()));
    DetectedObject object;
    object.label = names_[static_cast<std::size_t>(id)];
    const bool hasScore = columns % 2 == 0;  // as class and pairs of coordinates are an odd number
    object.score = hasScore ? numberIn(line, columns - 1) : 1.0;
    if (hasOutline)
    {
      const ImageBox b = boundsOfOutline(line);
      object.box = {
          b.x1 * camera.ncols, b.y1 * camera.nrows, b.x2 * camera.ncols, b.y2 * camera.nrows};
      return object;
    }
    const double x = numberIn(line, 1) * camera.ncols, y = numberIn(line, 2) * camera.nrows,
                 halfWidth = 0.5 * numberIn(line, 3) * camera.ncols,
                 halfHeight = 0.5 * numberIn(line, 4) * camera.nrows;
    object.box = {x - halfWidth, y - halfHeight, x + halfWidth, y + halfHeight};
    return object;
  }

  bool hasOwnNames_;
  std::string namesFile_;
  std::vector<std::string> names_;
};

/** The file with the names of the classes of a folder's boxes, if there is one. */
std::optional<std::string> findNames(const std::string& folder, const std::string& labels)
{
  if (!labels.empty()) return labels;
  for (const fs::path& place : {fs::path(folder), fs::path(folder) / ".."})
    for (const auto& name : kNameFiles)
      if (fs::is_regular_file(place / name)) return (place / name).lexically_normal().string();
  return std::nullopt;
}
}  // namespace

std::string noteOfUnnamedClasses(const std::string& place)
{
  return place + ": no file names the classes, whose numbers are taken for COCO's (--labels FILE)";
}

std::string noteOfNamedClasses(const std::string& place, const std::string& labels)
{
  if (labels.empty()) return {};
  return place + ": names its classes itself; --labels " + labels + " is not used";
}

void requireFewBoxes(std::size_t boxes, const std::string& place)
{
  constexpr std::size_t kMost = 100'000;  // four times what detectors find before suppression
  if (boxes > kMost)
    throw std::runtime_error(mrpt::format(
        "%s: more than %zu boxes in one image, which is absurd", place.c_str(), kMost));
}

bool hasYoloBoxes(const std::string& folder)
{
  std::set<std::string> files;  // in order, so that every run looks at the same one first
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".txt" &&
        std::find(kNameFiles.begin(), kNameFiles.end(), entry.path().filename()) ==
            kNameFiles.end())
      files.insert(entry.path().string());
  for (const auto& file : files)
  {
    const auto lines = readTextLines(file);
    if (lines.empty()) continue;
    const auto columns = lines[0].words.size();
    return ((columns == kYoloColumns || columns == kYoloColumns + 1) && isNumber(lines[0], 1)) ||
           isOutline(lines[0]);
  }
  return false;
}

std::unique_ptr<const BoxReader> openNamedBoxes(
    const std::string& folder, const std::string& labels)
{
  return std::make_unique<NamedBoxes>(folder, labels);
}

std::unique_ptr<const BoxReader> openYoloBoxes(const std::string& folder, const std::string& labels)
{
  return std::make_unique<YoloBoxes>(folder, findNames(folder, labels));
}

}  // namespace quadmap
