#include "pcd/PcdFolder.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "frames/FolderReader.h"
#include "frames/FrameImages.h"
#include "pcd/PcdFile.h"
#include "quadmap/base/ConfigCheck.h"
#include "text/TextLines.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

constexpr double kPcdDepthFactor = 5000;  // of the depth images that are made of the clouds
constexpr double kPcdImagesPerSecond = 30;

/** The line pixel = slope * ratio + offset through many pairs of a ratio and a pixel. */
class PixelLine
{
 public:
  void add(double ratio, double pixel)
  {
    const Eigen::Vector2d row(ratio, 1);
    normal_ += row * row.transpose();
    right_ += row * pixel;
    squares_ += pixel * pixel;
    ++count_;
  }

  Eigen::Vector2d solution() const { return normal_.ldlt().solve(right_); }

  /** Root mean square of what is left [px]. */
  double residual() const
  {
    return std::sqrt(std::max(0.0, squares_ - right_.dot(solution())) / std::max(1, count_));
  }
  int count() const { return count_; }

 private:
  Eigen::Matrix2d normal_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right_ = Eigen::Vector2d::Zero();
  double squares_ = 0;
  int count_ = 0;
};

constexpr int kFewest = 100;              // points that tell of a camera
constexpr double kLargestPixelError = 1;  // root mean square [px]

/** The pinhole camera at whose pixels the points of a cloud are seen. */
mrpt::img::TCamera cameraOf(const PcdCloud& cloud, const std::string& file)
{
  PixelLine columns, rows;
  for (std::size_t v = 0, i = 0; v < cloud.height; ++v)
    for (std::size_t u = 0; u < cloud.width; ++u, ++i)
    {
      const double x = cloud.x[i], y = cloud.y[i], z = cloud.z[i];
      if (!std::isfinite(x) || !std::isfinite(y) || !(z > 0)) continue;
      columns.add(x / z, static_cast<double>(u));
      rows.add(y / z, static_cast<double>(v));
    }
  const Eigen::Vector2d c = columns.solution(), r = rows.solution();
  if (columns.count() < kFewest || !(c[0] > 0) || !(r[0] > 0) ||
      !(columns.residual() < kLargestPixelError) || !(rows.residual() < kLargestPixelError))
    throw std::runtime_error(
        file + ": its points are not those of a camera's image (x right, y down, z forward)");
  mrpt::img::TCamera camera;
  camera.setIntrinsicParamsFromValues(c[0], r[0], c[1], r[1]);
  camera.ncols = static_cast<unsigned>(cloud.width);
  camera.nrows = static_cast<unsigned>(cloud.height);
  return camera;
}

/** A camera and the cloud that it was taken from. */
struct CloudCamera
{
  mrpt::img::TCamera camera;
  std::string file;
};

/** A cloud of another camera, or of another frame, would get wrong places with this one's.
 * \exception std::runtime_error If the points are not at the pixels at which the camera sees them.
 */
void requireSeenBy(const CloudCamera& known, const PcdCloud& cloud, const std::string& file)
{
  const mrpt::img::TCamera& camera = known.camera;
  double squares = 0;  // of the distances from the pixels [px^2]
  int count = 0;
  for (std::size_t v = 0, i = 0; v < cloud.height; ++v)
    for (std::size_t u = 0; u < cloud.width; ++u, ++i)
    {
      const double x = cloud.x[i], y = cloud.y[i], z = cloud.z[i];
      if (!std::isfinite(x) || !std::isfinite(y) || !(z > 0)) continue;
      const double du = camera.fx() * x / z + camera.cx() - static_cast<double>(u),
                   dv = camera.fy() * y / z + camera.cy() - static_cast<double>(v);
      squares += du * du + dv * dv;
      ++count;
    }
  if (count < kFewest || std::sqrt(squares / count) < 2 * kLargestPixelError) return;
  throw std::runtime_error(mrpt::format(
      "%s: its points are not those of the camera of %s, which sees them %.1f px beside their "
      "places",
      file.c_str(), known.file.c_str(), std::sqrt(squares / count)));
}

/** The camera of the first cloud that can be read, as a damaged one need not end the work.
 * \exception std::runtime_error If there is none; says what is wrong with the first one. */
CloudCamera cameraOfFirst(const std::vector<FolderFrame>& frames)
{
  std::string problem;
  for (const auto& frame : frames) try
    {
      return {cameraOf(readPcd(frame.color), frame.color), frame.color};
    }
    catch (const std::exception& e)
    {
      if (problem.empty()) problem = e.what();
    }
  throw std::runtime_error(problem);
}

/** Makes images of clouds. */
class PcdImages : public FrameImageReader
{
 public:
  /** \param camera Whose images the clouds must be; empty when a user answers for that. */
  explicit PcdImages(std::optional<CloudCamera> camera) : camera_(std::move(camera)) {}

  FrameImages read(const FolderFrame& frame) const override
  {
    const PcdCloud cloud = readPcd(frame.color);
    if (camera_) requireSeenBy(*camera_, cloud, frame.color);
    const int rows = static_cast<int>(cloud.height), columns = static_cast<int>(cloud.width);
    FrameImages images{cv::Mat(rows, columns, CV_8UC3), cv::Mat(rows, columns, CV_16UC1)};
    for (int v = 0, i = 0; v < rows; ++v)
      for (int u = 0; u < columns; ++u, ++i)
      {
        const auto k = static_cast<std::size_t>(i);
        const double steps = std::round(kPcdDepthFactor * static_cast<double>(cloud.z[k]));
        const bool isSeen = steps >= 1 && steps <= std::numeric_limits<std::uint16_t>::max();
        images.depth.at<std::uint16_t>(v, u) = isSeen ? static_cast<std::uint16_t>(steps) : 0;
        const std::uint32_t c = cloud.color[k];
        images.color.at<cv::Vec3b>(v, u) = cv::Vec3b(
            static_cast<std::uint8_t>(c), static_cast<std::uint8_t>(c >> 8),
            static_cast<std::uint8_t>(c >> 16));
      }
    return images;
  }

 private:
  std::optional<CloudCamera> camera_;
};

/** A name that is a number with a point is a time [s].
 * \exception std::runtime_error If it is negative or too large. */
std::optional<double> timeOf(const fs::path& file)
{
  const std::string name = file.stem().string();
  const auto time = name.find('.') == std::string::npos ? std::nullopt : parseNumber(name);
  if (time && !(*time >= 0 && *time <= kLatestTime))
    throw std::runtime_error(file.string() + ": the time in its name must be in 0..1e10 s");
  return time;
}

/** What a cloud goes by: the time or, without one, the number at the end of its name. */
double orderOf(const fs::path& file)
{
  if (const auto time = timeOf(file)) return *time;
  const std::string name = file.stem().string();
  const auto digits = name.find_last_not_of("0123456789") + 1;  // npos + 1 is 0
  return parseNumber(name.substr(digits)).value_or(-1);
}

bool isCloud(const fs::path& file) { return file.extension() == ".pcd"; }

/** Adds the clouds in the order of their times or numbers, and of their names where these are
 * equal. Clouds without a time are counted. One whose name cannot be a time is a listProblem. */
void addFrames(FolderContent& content)
{
  std::set<std::pair<double, std::string>> files;
  for (const auto& file : filesIn(content.folder)) try
    {
      if (isCloud(file)) files.emplace(orderOf(file), file.string());
    }
    catch (const std::runtime_error& e)
    {
      noteUnusable(content.listProblems, content.folder, e.what());
    }
  for (const auto& [order, file] : files)
  {
    const double counted = static_cast<double>(content.frames.size()) / kPcdImagesPerSecond;
    content.frames.push_back(
        {timeOf(file).value_or(counted), file, file, fs::path(file).filename().string(), {}});
  }
}

/** Takes the poses of matrices beside the clouds. \return Whether there is any. */
bool takeMatrices(FolderContent& content)
{
  bool any = false;
  for (auto& frame : content.frames)
    for (const char* end : {".txt", ".pose.txt"})
    {
      const fs::path file = fs::path(frame.color).replace_extension(end);
      if (!fs::exists(file)) continue;
      takeMatrixPose(frame, file.string());
      any = true;
    }
  return any;
}

/** Takes the poses of the headers. \return Whether any of them says more than the default. */
bool takeViewpoints(FolderContent& content)
{
  bool any = false;
  for (auto& frame : content.frames)
  {
    try
    {
      frame.T_world_optical = readPcd(frame.color).viewpoint;
    }
    catch (const std::exception&)
    {
      continue;  // who reads the cloud as an image meets the same error and reports it
    }
    any = any || frame.T_world_optical->asVectorVal().asEigen().norm() > 0;
  }
  if (!any)
    for (auto& frame : content.frames) frame.T_world_optical.reset();
  return any;
}
}  // namespace

bool isPcdFolder(const std::string& folder)
{
  const auto files = filesIn(folder);
  return std::any_of(files.begin(), files.end(), isCloud);
}

FolderContent readPcdFolder(const std::string& folder, const FrameFolderOptions& options)
{
  FolderContent content;
  content.folder = folder;
  addFrames(content);
  requireFrames(content, "has no *.pcd");
  content.pairing = "of one cloud";
  if (options.camera.empty())
  {
    const CloudCamera known = cameraOfFirst(content.frames);
    content.camera.color = known.camera;
    content.camera.origin = fs::path(known.file).filename().string();
    content.camera.file = known.file;
    content.images = std::make_shared<PcdImages>(known);
  }
  else
  {
    content.camera = cameraOfFolder(folder, options, "", kPcdDepthFactor);
    content.images = std::make_shared<PcdImages>(std::nullopt);
  }
  content.camera.depth.reset();
  content.camera.depthFactor = kPcdDepthFactor;
  const std::string trajectory = (fs::path(folder) / "groundtruth.txt").string();
  if (takeMatrices(content))
    content.poses = "the files beside the clouds";
  else if (fs::exists(trajectory))
    takePoses(content, trajectory, options.maxPoseGap);
  else if (takeViewpoints(content))
    content.poses = "the headers of the clouds";
  else
    content.notes.push_back(folder + ": no poses in files, groundtruth.txt or headers");
  return content;
}

}  // namespace quadmap
