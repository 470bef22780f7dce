#include <mrpt/core/format.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "frames/RigidMatrix.h"
#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/InputFile.h"
#include "quadmap/base/SimilarWords.h"
#include "quadmap/base/Words.h"
#include "quadmap/sensors/DepthUnit.h"
#include "tum/TumFiles.h"

namespace quadmap
{
namespace
{
using mrpt::system::trim;

/** The top level of a YAML file as OpenCV writes it: lines of `key: value`. Indented lines below a
 * key belong to its value. OpenCV's own reader is not used because it never returns for some
 * damaged files, such as one with a line that is indented by mistake. */
class FlatYaml
{
 public:
  explicit FlatYaml(const std::string& path) : path_(path)
  {
    auto file = openModestText(path);
    std::string* value = nullptr;  // value of the last key
    std::size_t number = 0;
    for (std::string line; std::getline(file, line);)
    {
      ++number;
      if (line.find('\0') != std::string::npos)
        reject("has a zero byte (line " + std::to_string(number) + ")");
      if (!line.empty() && line.back() == '\r') line.pop_back();
      line = withoutComment(line);
      const std::string text = trim(line);
      if (text.empty() || line[0] == '%' || text == "---" || text == "...") continue;
      if (line[0] != ' ')
        value = addKey(line, number);
      else if (value)
        *value += " " + text;
      else
        rejectLine(number);
    }
    if (file.bad()) reject("read error");
  }

  [[noreturn]] void reject(const std::string& what) const
  {
    throw std::runtime_error(path_ + ": " + what);
  }

  const std::string* find(const std::string& key) const
  {
    const auto found = values_.find(key);
    return found == values_.end() ? nullptr : &found->second;
  }

  std::vector<std::string> keys() const
  {
    std::vector<std::string> keys;
    for (const auto& [key, value] : values_) keys.push_back(key);
    return keys;
  }

  /** \exception std::runtime_error If a required key is missing or its value is no finite number.
   */
  double number(const std::string& key, std::optional<double> fallback = std::nullopt) const
  {
    const std::string* text = find(key);
    if (!text && fallback) return *fallback;
    if (!text) reject("the key '" + key + "' is missing");
    const auto value = yamlNumber(*text);
    if (!value) reject("'" + key + "' is not a number");
    if (!std::isfinite(*value)) reject("'" + key + "' is not finite");
    return *value;
  }

  /** A number of YAML, which writes `.Nan` and `-.Inf`. */
  static std::optional<double> yamlNumber(std::string text)
  {
    const auto dot = text.find(".");
    if (dot != std::string::npos && dot + 1 < text.size() &&
        std::isalpha(static_cast<unsigned char>(text[dot + 1])))
      text.erase(dot, 1);
    return parseNumber(text);
  }

 private:
  static std::string withoutComment(const std::string& line)
  {
    for (std::size_t i = line.find('#'); i != std::string::npos; i = line.find('#', i + 1))
      if (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t') return line.substr(0, i);
    return line;
  }

  [[noreturn]] void rejectLine(std::size_t number) const
  {
    reject("is not YAML as OpenCV writes it (line " + std::to_string(number) + ")");
  }

  std::string* addKey(const std::string& line, std::size_t number)
  {
    const auto colon = line.find(':');
    const std::string key = trim(line.substr(0, colon));
    if (colon == std::string::npos || key.empty() || line[0] == '\t') rejectLine(number);
    const auto [at, isNew] = values_.emplace(key, trim(line.substr(colon + 1)));
    if (!isNew) reject("the key " + quotedWord(key) + " stands there twice");
    return &at->second;
  }

  std::string path_;
  std::map<std::string, std::string> values_;
};

unsigned pixelsAt(const FlatYaml& file, const std::string& key)
{
  constexpr double kMaxPixels = 20000;
  const double value = file.number(key);
  if (value < 1 || value > kMaxPixels || value != std::floor(value))
    file.reject(mrpt::format(
        "'%s' is %g: must be a whole number in 1..%g", key.c_str(), value, kMaxPixels));
  return static_cast<unsigned>(value);
}

/** The file may have keys for other programs, but one like a key of ours is a slip, and without it
 * a default would be taken. \exception std::runtime_error For such a key, and for terms of the
 * distortion of which images could not be rectified. */
void requireNoSlips(const FlatYaml& file)
{
  const std::vector<std::string> known = {"fx",           "fy",
                                          "cx",           "cy",
                                          "width",        "height",
                                          "k1",           "k2",
                                          "p1",           "p2",
                                          "k3",           "depth_factor",
                                          "world_up",     "T_color_depth",
                                          "depth_raw_fx", "depth_raw_fy",
                                          "depth_raw_cx", "depth_raw_cy"};
  const std::vector<std::string> further = {"k4", "k5", "k6"};  // OpenCV's rational terms
  for (const auto& key : further)
    if (const double value = file.number(key, 0.0); value != 0)
      file.reject(mrpt::format("%s=%g: a lens with this term is not known", key.c_str(), value));
  const auto isOneOf = [](const std::vector<std::string>& keys, const std::string& key)
  { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
  for (const auto& key : file.keys())
  {
    if (isOneOf(known, key) || isOneOf(further, key)) continue;
    auto meant = mostSimilar(key, known);
    if (!meant) meant = mostSimilar(mrpt::system::lowerCase(key), known);
    if (meant)
      file.reject("the key " + quotedWord(key) + " is not known; did you mean '" + *meant + "'?");
  }
}

/** How many numbers an !!opencv-matrix has by its rows and cols; nothing of a list, which states
 * neither, and 0 when they are no numbers. */
std::optional<double> statedSize(const std::string& head)
{
  std::optional<double> stated;
  const auto words = wordsOf(head);
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (words[i] == "rows:" || words[i] == "cols:")
      stated = stated.value_or(1) * FlatYaml::yamlNumber(words[i + 1]).value_or(0);
  return stated;
}

/** The numbers between the brackets of an !!opencv-matrix or a list; nothing without the key.
 * \param what The matrix has so many numbers, in words. */
std::optional<std::vector<double>> matrixAt(
    const FlatYaml& file, const std::string& key, std::size_t size, const std::string& what)
{
  const std::string* text = file.find(key);
  if (!text) return std::nullopt;
  const auto reject = [&]
  { file.reject("'" + key + "' must be a matrix of " + what + " numbers"); };
  const auto open = text->find('['), close = text->find(']');
  std::vector<std::string> words;
  if (open != std::string::npos && close != std::string::npos && open < close)
    mrpt::system::tokenize(text->substr(open + 1, close - open - 1), ", \t", words);
  const auto stated = statedSize(text->substr(0, open));
  if (words.size() != size || (stated && *stated != static_cast<double>(size))) reject();
  std::vector<double> numbers;
  for (const auto& word : words)
  {
    const auto value = FlatYaml::yamlNumber(word);
    if (!value) reject();
    numbers.push_back(*value);
  }
  return numbers;
}

std::optional<Eigen::Vector3d> upAt(const FlatYaml& file)
{
  const auto numbers = matrixAt(file, "world_up", 3, "three");
  if (!numbers) return std::nullopt;
  const Eigen::Vector3d up(numbers->data());
  constexpr double kShortest = 1e-6, kLongest = 1e6;
  if (!up.allFinite() || up.norm() < kShortest || up.norm() > kLongest)
    file.reject("'world_up' must be a finite direction");
  return up.normalized();
}

/** The depth camera of images that are not registered. */
std::optional<DepthCamera> depthCameraAt(const FlatYaml& file, const mrpt::img::TCamera& color)
{
  const auto T = matrixAt(file, "T_color_depth", 16, "16");
  if (!T || !file.find("depth_raw_fx")) return std::nullopt;
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Matrix4d matrix = Eigen::Map<const RowMajor>(T->data());
  if (!isRigid(matrix)) file.reject("'T_color_depth' must be a rigid transformation");
  const double fx = file.number("depth_raw_fx"), fy = file.number("depth_raw_fy");
  if (fx <= 0 || fy == 0) file.reject("'depth_raw_fx' must be > 0, 'depth_raw_fy' not 0");
  DepthCamera depth;
  depth.camera.setIntrinsicParamsFromValues(
      fx, fy, file.number("depth_raw_cx"), file.number("depth_raw_cy"));
  depth.camera.ncols = color.ncols;
  depth.camera.nrows = color.nrows;
  depth.T_color_depth = poseOf(matrix);
  return depth;
}

}  // namespace

FolderCamera readTumCalibration(const std::string& path)
{
  if (!std::filesystem::is_regular_file(path)) throw std::runtime_error(path + ": no such file");
  const FlatYaml file(path);
  requireNoSlips(file);
  FolderCamera calibration;
  calibration.origin = std::filesystem::path(path).filename().string();
  calibration.file = path;
  auto& camera = calibration.color;
  const double fx = file.number("fx"), fy = file.number("fy");
  if (fx <= 0) file.reject(mrpt::format("fx=%g: must be > 0", fx));
  if (fy == 0) file.reject("fy=0: must not be 0");
  camera.setIntrinsicParamsFromValues(fx, fy, file.number("cx"), file.number("cy"));
  camera.ncols = pixelsAt(file, "width");
  camera.nrows = pixelsAt(file, "height");
  calibration.depthFactor = file.number("depth_factor");
  if (calibration.depthFactor <= 0)
    file.reject(mrpt::format("depth_factor=%g: must be > 0", calibration.depthFactor));
  if (!isPlausibleDepthUnit(1 / calibration.depthFactor))
    file.reject(mrpt::format(
        "depth_factor=%g: must be in [%g, %g], as metres = value / depth_factor",
        calibration.depthFactor, 1 / kLargestDepthUnit, 1 / kSmallestDepthUnit));
  const char* const coefficients[] = {
      "k1", "k2", "p1", "p2", "k3"};  // in the order of MRPT's plumb_bob
  for (std::size_t i = 0; i < std::size(coefficients); ++i)
    camera.dist[i] = file.number(coefficients[i], 0.0);
  const bool distorted =
      std::any_of(camera.dist.begin(), camera.dist.end(), [](double k) { return k != 0; });
  camera.distortion =
      distorted ? mrpt::img::DistortionModel::plumb_bob : mrpt::img::DistortionModel::none;
  calibration.depth = depthCameraAt(file, camera);
  calibration.worldUp = upAt(file);
  return calibration;
}

}  // namespace quadmap
