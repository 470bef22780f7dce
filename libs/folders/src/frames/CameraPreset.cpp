#include "frames/CameraPreset.h"

#include <mrpt/config/CConfigFile.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <stdexcept>

#include "frames/ResizedCamera.h"
#include "frames/RigidMatrix.h"
#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/OptionList.h"
#include "quadmap/sensors/CheckedReader.h"
#include "quadmap/sensors/DepthUnit.h"

namespace quadmap
{
namespace
{
constexpr const char* kSection = "camera";
constexpr double kMostPixels = 20000;
constexpr Eigen::Index kPoseNumbers = 12;

mrpt::img::TCamera pinhole(const std::array<double, 4>& f, int width, int height)
{
  mrpt::img::TCamera camera;
  camera.setIntrinsicParamsFromValues(f[0], f[1], f[2], f[3]);
  camera.ncols = static_cast<unsigned>(width);
  camera.nrows = static_cast<unsigned>(height);
  return camera;
}

std::string textOf(const Eigen::Matrix4d& T)
{
  std::string text;
  for (Eigen::Index i = 0; i < kPoseNumbers; ++i)
    text += (i == 0 ? "" : " ") + exactText(T(i / 4, i % 4));
  return text;
}

/** \exception std::invalid_argument If the text is no pose. */
Eigen::Matrix4d matrixIn(const std::string& text)
{
  std::vector<std::string> words;
  mrpt::system::tokenize(text, " \t,", words);
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  bool good = words.size() == kPoseNumbers;
  for (Eigen::Index i = 0; good && i < kPoseNumbers; ++i)
  {
    const auto value = parseNumber(words[static_cast<std::size_t>(i)]);
    good = value.has_value();
    if (good) T(i / 4, i % 4) = *value;
  }
  if (!good || !isRigid(T))
    throw std::invalid_argument(
        "T_color_depth=" + text +
        ": must be the first three rows of a rigid transformation, 12 numbers");
  return T;
}

bool isZero(const double* numbers, std::size_t n)
{
  return std::all_of(numbers, numbers + n, [](double x) { return x == 0; });
}
}  // namespace

void CameraPreset::describe(OptionList& list)
{
  list.about("The RGB-D camera of a recording in a folder.");
  list.text(
      "folders", [this] { return folders; }, [this](const std::string& text) { folders = text; },
      "words", "A folder with one of these words in its name has recordings of this camera.");
  list.integer("width", width, {1, kMostPixels}, "px", "Of the colour images.");
  list.integer("height", height, {1, kMostPixels}, "px", "Of the colour images.");
  list.number("fx", color[0], {1e-3, 1e6}, "px", "Focal length of the colour camera.");
  list.number("fy", color[1], {-1e6, 1e6}, "px", "Negative where y points up in the camera.");
  list.number("cx", color[2], {-1e6, 1e6}, "px", "Centre of the colour camera.");
  list.number("cy", color[3], {-1e6, 1e6}, "px", "Centre of the colour camera.");
  const char* const names[] = {"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < distortion.size(); ++i)
    list.number(
        names[i], distortion[i], {-kLargestCoefficient, kLargestCoefficient}, "",
        "Distortion of the lens, as OpenCV defines it. Images and boxes are rectified.");
  list.number(
      "depthFactor", depthFactor, {0, 1 / kSmallestDepthUnit}, "1/m",
      "Depth [m] = pixel value / depthFactor. 0: as usual in the layout of the folder.");
  list.integer("noDepth", noDepth, {0, 65535}, "", "Pixel value without depth, as 0 always is.");
  list.integer(
      "depthWidth", depthWidth, {0, kMostPixels}, "px", "Of the depth images. 0: as of colour.");
  list.integer("depthHeight", depthHeight, {0, kMostPixels}, "px", "As depthWidth.");
  const char* const depthNames[] = {"depthFx", "depthFy", "depthCx", "depthCy"};
  for (std::size_t i = 0; i < depth.size(); ++i)
    list.number(
        depthNames[i], depth[i], {-1e6, 1e6}, "px",
        "The depth camera, when its images are not registered to the colour images.");
  list.text(
      "T_color_depth", [this] { return textOf(T_color_depth); },
      [this](const std::string& text) { T_color_depth = matrixIn(text); }, "12 numbers",
      "Pose of the depth camera in the colour camera: the first three rows of the matrix.");
  list.flag("posesAreOfDepth", posesAreOfDepth, "Poses are those of the depth camera.");
  list.vector(
      "worldUp", worldUp.data(), {-1e3, 1e3}, "",
      "Where up is in the world of the recording's poses. 0 0 0: not known.");
  list.require([this] { return color[0] == 0 || color[1] != 0; }, "fy must not be 0");
  list.require(
      [this] { return isZero(depth.data(), 4) || (depth[0] > 0 && depth[1] != 0); },
      "depthFx must be > 0 and depthFy not 0, or both must be missing");
  list.require(
      [this] { return !isZero(depth.data(), 4) || T_color_depth.isIdentity(0); },
      "T_color_depth needs depthFx and depthFy");
  list.require(
      [this] { return (depthWidth == 0) == (depthHeight == 0); },
      "depthWidth and depthHeight must both be there or both be missing");
  list.require(
      [this]
      { return depthWidth == 0 || !isZero(depth.data(), 4) || isZero(distortion.data(), 5); },
      "depthWidth with a lens that distorts needs depthFx and depthFy");
  list.require(
      [this]
      {
        const auto [columns, rows] = depthSize();
        const auto most = static_cast<double>(RecordLimits().imagePixels);
        return double(width) * height <= most && double(columns) * rows <= most;
      },
      "images may have 16 million pixels");
  list.require(
      [this] { return depthFactor == 0 || isPlausibleDepthUnit(1 / depthFactor); },
      "depthFactor must be 0 or in 1..1e7");
}

CameraPreset CameraPreset::fromFile(const std::string& path)
{
  requireReadableIni(path);
  CameraPreset preset;
  try
  {
    const mrpt::config::CConfigFile config(path);
    rejectUnknownSections(config, "", {kSection});
    preset.loadFromConfigFile(config, kSection);
    if (preset.color[0] == 0) throw std::invalid_argument("[camera] fx is missing");
    const auto has = [&](const char* key) { return config.keyExists(kSection, key); };
    if (!has("cx")) preset.color[2] = 0.5 * (preset.width - 1);
    if (!has("cy")) preset.color[3] = 0.5 * (preset.height - 1);
    const bool hasDepth = preset.depth[0] > 0;
    const auto [width, height] = preset.depthSize();
    if (hasDepth && !has("depthCx")) preset.depth[2] = 0.5 * (width - 1);
    if (hasDepth && !has("depthCy")) preset.depth[3] = 0.5 * (height - 1);
  }
  catch (const std::invalid_argument& e)
  {
    throw std::invalid_argument(path + ": " + e.what());
  }
  return preset;
}

std::pair<int, int> CameraPreset::depthSize() const
{
  return depthWidth > 0 ? std::pair(depthWidth, depthHeight) : std::pair(width, height);
}

std::optional<DepthCamera> CameraPreset::depthCamera() const
{
  const auto [columns, rows] = depthSize();
  if (!isZero(depth.data(), depth.size()))
    return DepthCamera{pinhole(depth, columns, rows), poseOf(T_color_depth)};
  if (columns == width && rows == height) return std::nullopt;
  const auto own = resized(
      pinhole(color, width, height), static_cast<unsigned>(columns), static_cast<unsigned>(rows));
  return DepthCamera{own, {}};
}

FolderCamera CameraPreset::camera(const std::string& origin) const
{
  FolderCamera c;
  c.origin = origin;
  c.color = pinhole(color, width, height);
  std::copy(distortion.begin(), distortion.end(), c.color.dist.begin());
  if (!isZero(distortion.data(), distortion.size()))
    c.color.distortion = mrpt::img::DistortionModel::plumb_bob;
  c.depthFactor = depthFactor;
  c.noDepth = static_cast<std::uint16_t>(noDepth);
  c.depth = depthCamera();
  c.posesAreOfDepth = posesAreOfDepth && c.depth;
  const Eigen::Vector3d up(worldUp[0], worldUp[1], worldUp[2]);
  if (up.norm() > 0) c.worldUp = up.normalized();
  return c;
}

std::vector<std::string> CameraPreset::folderWords() const
{
  std::vector<std::string> words;
  mrpt::system::tokenize(folders, " \t", words);
  return words;
}

}  // namespace quadmap
