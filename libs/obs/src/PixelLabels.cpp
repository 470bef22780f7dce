#include "quadmap/obs/PixelLabels.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace quadmap
{
namespace
{
using mrpt::obs::TPixelLabelInfo;
using mrpt::obs::TPixelLabelInfoBase;

/** The labels of each pixel, one bit per label, row major. */
struct LabelImage
{
  int width = 0, height = 0;
  std::vector<std::uint64_t> bits;
};

template <unsigned int Bytes>
bool copyLabels(const TPixelLabelInfoBase& from, LabelImage& to)
{
  const auto* info = dynamic_cast<const TPixelLabelInfo<Bytes>*>(&from);
  if (!info) return false;
  const auto& matrix = info->pixelLabels;
  to.width = static_cast<int>(matrix.cols());
  to.height = static_cast<int>(matrix.rows());
  to.bits.assign(matrix.data(), matrix.data() + matrix.size());
  return true;
}

LabelImage labelImageOf(const TPixelLabelInfoBase& labels)
{
  LabelImage image;
  const bool known = copyLabels<1>(labels, image) || copyLabels<2>(labels, image) ||
                     copyLabels<3>(labels, image) || copyLabels<4>(labels, image) ||
                     copyLabels<8>(labels, image);  // these are all sizes that MRPT has
  if (!known) throw std::runtime_error("its pixel labels are of an unknown kind");
  return image;
}

/** Checks the proportions, up to half a pixel by which a size may have been rounded. */
void requireSameProportions(const LabelImage& labels, cv::Size depth)
{
  const auto excess = std::abs(
      std::int64_t{labels.width} * depth.height - std::int64_t{labels.height} * depth.width);
  if (labels.width == 0 || labels.height == 0 || 2 * excess > std::max(depth.width, depth.height))
    throw std::runtime_error(mrpt::format(
        "its %dx%d pixel labels do not fit its %dx%d depth image", labels.width, labels.height,
        depth.width, depth.height));
}

/** Image of 1 where pixels have a label and 0 elsewhere, in the size of the depth image. */
cv::Mat pixelsWith(std::uint64_t bit, const LabelImage& labels, cv::Size depth)
{
  cv::Mat pixels(labels.height, labels.width, CV_8U);
  std::transform(
      labels.bits.begin(), labels.bits.end(), pixels.data,
      [bit](std::uint64_t bits) { return static_cast<std::uint8_t>((bits & bit) != 0); });
  if (pixels.size() != depth) cv::resize(pixels, pixels, depth, 0, 0, cv::INTER_NEAREST);
  return pixels;
}

/** "chair" for "chair_2". A name without a number is returned as it is. */
std::string withoutNumber(const std::string& name)
{
  std::size_t end = name.size();
  while (end > 0 && std::isdigit(static_cast<unsigned char>(name[end - 1]))) --end;
  if (end == name.size()) return name;
  while (end > 0 && std::string("_- #").find(name[end - 1]) != std::string::npos) --end;
  return end == 0 ? name : name.substr(0, end);
}

/** Hash FNV-1a of a name, which is the same in every image, file and run. */
std::uint32_t hashOf(const std::string& name)
{
  std::uint32_t hash = 2166136261U;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash;
}

/** Box and mask of some components of a connected component analysis. It is nothing when they are
 * less than two pixels wide or high. */
std::optional<DetectedObject> objectOf(
    const cv::Mat& componentOf, const cv::Mat& stats, const std::vector<int>& components)
{
  cv::Rect area;
  for (const int c : components)
    area |= cv::Rect(
        stats.at<int>(c, cv::CC_STAT_LEFT), stats.at<int>(c, cv::CC_STAT_TOP),
        stats.at<int>(c, cv::CC_STAT_WIDTH), stats.at<int>(c, cv::CC_STAT_HEIGHT));
  if (area.width < 2 || area.height < 2) return std::nullopt;
  DetectedObject object;
  object.box = {
      static_cast<double>(area.x), static_cast<double>(area.y),
      static_cast<double>(area.x + area.width - 1), static_cast<double>(area.y + area.height - 1)};
  ObjectMask& mask = object.mask.emplace();
  mask.x0 = static_cast<unsigned>(area.x);
  mask.y0 = static_cast<unsigned>(area.y);
  mask.width = static_cast<unsigned>(area.width);
  mask.height = static_cast<unsigned>(area.height);
  std::vector<bool> isPart(static_cast<std::size_t>(stats.rows), false);
  for (const int c : components) isPart[static_cast<std::size_t>(c)] = true;
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x)
      mask.pixels.push_back(isPart[static_cast<std::size_t>(componentOf.at<int>(y, x))]);
  return object;
}

void addObjects(
    const std::string& name,
    const cv::Mat& pixels,
    int minPixels,
    std::uint64_t& maskPixelsLeft,
    std::vector<DetectedObject>& objects)
{
  constexpr int kConnectivity = 8;
  cv::Mat componentOf, stats, centroids;
  const int count =
      cv::connectedComponentsWithStats(pixels, componentOf, stats, centroids, kConnectivity);
  std::vector<int> large;
  for (int c = 1; c < count; ++c)
    if (stats.at<int>(c, cv::CC_STAT_AREA) >= minPixels) large.push_back(c);
  if (large.empty()) return;

  const bool isInstance = withoutNumber(name) != name;
  std::vector<std::vector<int>> groups;
  if (isInstance)
    groups.push_back(large);
  else
    for (const int c : large) groups.push_back({c});
  for (const auto& group : groups)
  {
    auto object = objectOf(componentOf, stats, group);
    if (!object) continue;
    if (objects.size() == CObservationObjects::kMostObjects)
      throw std::runtime_error(mrpt::format(
          "its pixel labels have more than %u separate parts (minLabelPixels leaves out small "
          "ones)",
          CObservationObjects::kMostObjects));
    maskPixelsLeft -= std::min<std::uint64_t>(maskPixelsLeft, object->mask->pixels.size());
    if (maskPixelsLeft == 0)
      throw std::runtime_error(
          "its pixel labels have parts that reach around each other too often");
    object->label = name;
    if (isInstance) object->instanceId = hashOf(name);
    objects.push_back(std::move(*object));
  }
}

}  // namespace

CObservationObjects::Ptr boxesFromPixelLabels(
    const mrpt::obs::CObservation3DRangeScan& scan,
    const LabelTable& labels,
    int minPixels,
    std::set<std::string>& unknown)
{
  if (!scan.hasPixelLabels()) return nullptr;
  auto boxes = CObservationObjects::Create();
  boxes->timestamp = scan.timestamp;
  boxes->sensorLabel = scan.sensorLabel;
  boxes->sensorPose = scan.sensorPose;
  boxes->cameraParams = scan.cameraParams;

  const LabelImage image = labelImageOf(*scan.pixelLabels);
  const cv::Size depth(
      static_cast<int>(scan.cameraParams.ncols), static_cast<int>(scan.cameraParams.nrows));
  requireSameProportions(image, depth);
  std::uint64_t used = 0, maskPixelsLeft = CObservationObjects::kMostMaskPixels;
  for (const std::uint64_t bits : image.bits) used |= bits;
  for (const auto& [index, name] : scan.pixelLabels->pixelLabelNames)
  {
    constexpr unsigned kBits = 64;
    const std::uint64_t bit = index < kBits ? std::uint64_t{1} << index : 0;
    if ((used & bit) == 0) continue;
    if (labels.properties(name).known)
      addObjects(name, pixelsWith(bit, image, depth), minPixels, maskPixelsLeft, boxes->objects);
    else
      unknown.insert(withoutNumber(name));
    used &= ~bit;
  }
  if (used != 0) unknown.insert("labels without a name");
  return boxes;
}

}  // namespace quadmap
