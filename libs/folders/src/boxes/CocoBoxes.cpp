#include <mrpt/core/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "boxes/BoxLines.h"
#include "boxes/CocoImages.h"
#include "quadmap/base/Json.h"
#include "quadmap/base/ShareFiles.h"
#include "quadmap/folders/ClassNames.h"

namespace quadmap
{
namespace
{
/** The value of a key. \exception std::runtime_error If it is missing or of another type. */
template <typename T>
T valueOf(const Json& object, const char* key, const std::string& place)
{
  try
  {
    return object.at(key).get<T>();
  }
  catch (const nlohmann::json::exception&)
  {
    throw std::runtime_error(place + ": '" + key + "' is missing or of another type");
  }
}

/** \exception std::runtime_error If the key is missing, or has no whole number. */
long long wholeNumberOf(const Json& object, const char* key, const std::string& place)
{
  const auto number = wholeNumber(valueOf<Json>(object, key, place));
  if (!number) throw std::runtime_error(place + ": '" + key + "' must be a whole number");
  return *number;
}

/** The name of an image; of a number, its digits. */
std::string nameOf(const Json& imageId, const std::string& place)
{
  if (imageId.is_string()) return imageId.get<std::string>();
  if (const auto number = wholeNumber(imageId)) return std::to_string(*number);
  throw std::runtime_error(place + ": 'image_id' must be a name or a whole number");
}

/** The digits at the end of a name without leading zeros; empty when there are none. */
std::string numberAtEnd(const std::string& name)
{
  const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto begin = std::find_if_not(name.rbegin(), name.rend(), isDigit).base();
  const std::string digits(begin, name.end());
  if (digits.empty()) return digits;
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size() - 1));
}

/** The names of results by their `category_id`. */
class ResultNames
{
 public:
  explicit ResultNames(const std::string& labels) :
      isCoco_(labels.empty()),
      file_(isCoco_ ? findShareFile("detectors/coco.names") : labels),
      names_(readClassNames(file_))
  {
  }

  /** \exception std::runtime_error If no class has this number. */
  const std::string& of(long long id, const std::string& place) const
  {
    const long long index = isCoco_ ? indexOfCoco(id) : id;
    if (index < 0 || index >= static_cast<long long>(names_.size()))
      throw std::runtime_error(mrpt::format(
          "%s: class %lld is none of the %zu of %s", place.c_str(), id, names_.size(),
          file_.c_str()));
    return names_[static_cast<std::size_t>(index)];
  }

 private:
  /** COCO counts its classes from 1 and has left out those that its images do not show. */
  static long long indexOfCoco(long long id)
  {
    constexpr int kLeftOut[] = {12, 26, 29, 30, 45, 66, 68, 69, 71, 83};
    if (id < 1 || std::find(std::begin(kLeftOut), std::end(kLeftOut), id) != std::end(kLeftOut))
      return -1;
    return id - 1 -
           std::count_if(std::begin(kLeftOut), std::end(kLeftOut), [id](int k) { return k < id; });
  }

  bool isCoco_;
  std::string file_;
  std::vector<std::string> names_;
};

class CocoBoxes : public BoxReader
{
 public:
  CocoBoxes(std::string file, std::string labels) :
      file_(std::move(file)), labels_(std::move(labels)), images_(file_)
  {
    const Json json = readJson(file_);
    if (json.is_array())
      readResults(json);
    else if (json.is_object())
      readDataset(json);
    else
      throw std::runtime_error(file_ + ": is neither a list of results nor a data set of COCO");
  }

  std::optional<std::vector<DetectedObject>> boxes(
      const FolderFrame& frame, const mrpt::img::TCamera& camera) const override
  {
    if (const auto* found = images_.find(frame.color, namesFor(frame)))
    {
      requireSize(*found, camera);
      return found->boxes;
    }
    // Results do not say at which images the detector looked in vain.
    if (isResults_) return std::vector<DetectedObject>();
    return std::nullopt;
  }

  bool isOfOtherImages(const std::vector<FolderFrame>& frames) const override
  {
    const auto isHere = [this](const auto& frame)
    { return images_.has(frame.color, namesFor(frame)); };
    return !images_.empty() && std::none_of(frames.begin(), frames.end(), isHere);
  }

  std::string fileOf(const FolderFrame& frame) const override
  {
    return file_ + ": image " + namesOf(frame).front();
  }
  std::string description() const override { return file_ + " (COCO's JSON)"; }
  std::string note() const override
  {
    if (!isResults_) return noteOfNamedClasses(file_, labels_);
    return labels_.empty() ? noteOfUnnamedClasses(file_) : std::string();
  }

 private:
  std::vector<std::string> namesFor(const FolderFrame& frame) const
  {
    auto names = namesOf(frame);
    if (isResults_) names.push_back(numberAtEnd(names.back()));
    return names;
  }

  /** \exception std::runtime_error If the image had another size when its boxes were found. */
  void requireSize(const CocoImages::Image& image, const mrpt::img::TCamera& camera) const
  {
    if (!image.size || *image.size == std::pair<double, double>(camera.ncols, camera.nrows)) return;
    throw std::runtime_error(mrpt::format(
        "%s: image %s has %gx%g pixels there, and %ux%u in the recording: its boxes do not fit",
        file_.c_str(), image.written.c_str(), image.size->first, image.size->second, camera.ncols,
        camera.nrows));
  }

  void readResults(const Json& results)
  {
    isResults_ = true;
    const ResultNames names(labels_);
    for (std::size_t i = 0; i < results.size(); ++i)
    {
      const std::string place = mrpt::format("%s: result %zu", file_.c_str(), i);
      const auto& label = names.of(wholeNumberOf(results[i], "category_id", place), place);
      add(nameOf(valueOf<Json>(results[i], "image_id", place), place), results[i], label, place);
    }
  }

  void readDataset(const Json& json)
  {
    std::map<long long, std::string> images, names;
    for (const auto& image : valueOf<Json>(json, "images", file_))
    {
      const std::string place = file_ + ": an image";
      const auto name = valueOf<std::string>(image, "file_name", place);
      images[wholeNumberOf(image, "id", place)] = name;
      CocoImages::Image& added = images_.of(name);
      if (image.contains("width") && image.contains("height"))
        added.size.emplace(
            valueOf<double>(image, "width", place), valueOf<double>(image, "height", place));
    }
    const std::string place = file_ + ": a category";
    for (const auto& category : valueOf<Json>(json, "categories", file_))
    {
      auto name = valueOf<std::string>(category, "name", place);
      requireClassName(name, place);
      names[wholeNumberOf(category, "id", place)] = std::move(name);
    }
    std::size_t number = 0;
    for (const auto& annotation : valueOf<Json>(json, "annotations", file_))
    {
      const std::string place = mrpt::format("%s: annotation %zu", file_.c_str(), number++);
      const auto image = images.find(wholeNumberOf(annotation, "image_id", place));
      const auto label = names.find(wholeNumberOf(annotation, "category_id", place));
      if (image == images.end() || label == names.end())
        throw std::runtime_error(place + ": is of an image or a category that is not there");
      add(image->second, annotation, label->second, place);
    }
  }

  /** Adds a box, which COCO states by its upper left corner and its size. */
  void add(
      const std::string& image,
      const Json& json,
      const std::string& label,
      const std::string& place)
  {
    const auto box = valueOf<std::vector<double>>(json, "bbox", place);
    if (box.size() != 4) throw std::runtime_error(place + ": 'bbox' must have 4 numbers");
    DetectedObject object;
    object.label = label;
    if (json.contains("score")) object.score = valueOf<double>(json, "score", place);
    object.box = {box[0], box[1], box[0] + box[2], box[1] + box[3]};
    auto& objects = images_.of(image).boxes;
    objects.push_back(std::move(object));
    requireFewBoxes(objects.size(), file_ + ": " + image);
  }

  std::string file_;
  std::string labels_;  // of results; a data set has names itself, and a note says so
  bool isResults_ = false;
  CocoImages images_;
};
}  // namespace

std::unique_ptr<const BoxReader> openCocoBoxes(const std::string& file, const std::string& labels)
{
  return std::make_unique<CocoBoxes>(file, labels);
}

}  // namespace quadmap
