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

#include "quadmap/obs/KeepGreatest.h"

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

/** The smallest rectangle around some components of a connected component analysis. */
cv::Rect areaOf(const cv::Mat& stats, const std::vector<int>& components)
{
  cv::Rect area;
  for (const int c : components)
    area |= cv::Rect(
        stats.at<int>(c, cv::CC_STAT_LEFT), stats.at<int>(c, cv::CC_STAT_TOP),
        stats.at<int>(c, cv::CC_STAT_WIDTH), stats.at<int>(c, cv::CC_STAT_HEIGHT));
  return area;
}

/** Box and mask of some components in an area. */
DetectedObject objectOf(
    const cv::Mat& componentOf, int count, const std::vector<int>& components, const cv::Rect& area)
{
  DetectedObject object;
  object.box = {
      static_cast<double>(area.x), static_cast<double>(area.y),
      static_cast<double>(area.x + area.width - 1), static_cast<double>(area.y + area.height - 1)};
  ObjectMask& mask = object.mask.emplace();
  mask.x0 = static_cast<unsigned>(area.x);
  mask.y0 = static_cast<unsigned>(area.y);
  mask.width = static_cast<unsigned>(area.width);
  mask.height = static_cast<unsigned>(area.height);
  std::vector<bool> isPart(static_cast<std::size_t>(count), false);
  for (const int c : components) isPart[static_cast<std::size_t>(c)] = true;
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x)
      mask.pixels.push_back(isPart[static_cast<std::size_t>(componentOf.at<int>(y, x))]);
  return object;
}

/** The largest objects of an image, in the order in which they are found. */
class LargestObjects
{
 public:
  explicit LargestObjects(int minPixels) : minPixels_(minPixels) {}

  /** Adds what an image of the pixels with one label shows. */
  void add(const std::string& name, const cv::Mat& pixels)
  {
    constexpr int kConnectivity = 8;
    cv::Mat componentOf, stats, centroids;
    const int count =
        cv::connectedComponentsWithStats(pixels, componentOf, stats, centroids, kConnectivity);
    const bool isInstance = withoutNumber(name) != name;
    std::vector<Group> groups = groupsIn(stats, isInstance);
    keepLargest(groups);  // before their masks are made, which are many in an image of noise
    for (const Group& group : groups)
    {
      found_.push_back({objectOf(componentOf, count, group.components, group.area), group.pixels});
      DetectedObject& object = found_.back().object;
      object.label = name;
      if (isInstance) object.instanceId = hashOf(name);
      requireModestMasks(2 * CObservationObjects::kMostMaskPixels);  // half may be left out
    }
    keepLargest(found_);
    requireModestMasks(CObservationObjects::kMostMaskPixels);
  }

  std::size_t leftOut() const { return leftOut_; }

  std::vector<DetectedObject> take()
  {
    std::vector<DetectedObject> objects;
    for (Found& found : found_) objects.push_back(std::move(found.object));
    return objects;
  }

 private:
  /** Components that are one object, the area that they are in, and their number of pixels. */
  struct Group
  {
    std::vector<int> components;
    cv::Rect area;
    std::int64_t pixels = 0;
  };
  struct Found
  {
    DetectedObject object;
    std::int64_t pixels = 0;
  };

  /** Of an instance all components are one object. What is less than two pixels wide or high is
   * none. */
  std::vector<Group> groupsIn(const cv::Mat& stats, bool isInstance) const
  {
    std::vector<Group> groups;
    for (int c = 1; c < stats.rows; ++c)
    {
      const int pixels = stats.at<int>(c, cv::CC_STAT_AREA);
      if (pixels < minPixels_) continue;
      if (groups.empty() || !isInstance) groups.emplace_back();
      groups.back().components.push_back(c);
      groups.back().pixels += pixels;
    }
    for (Group& group : groups) group.area = areaOf(stats, group.components);
    const auto isThin = [](const Group& g) { return g.area.width < 2 || g.area.height < 2; };
    groups.erase(std::remove_if(groups.begin(), groups.end(), isThin), groups.end());
    return groups;
  }

  template <typename Item>
  void keepLargest(std::vector<Item>& items)
  {
    leftOut_ += keepGreatest(
        items, CObservationObjects::kMostObjects, [](const Item& item) { return item.pixels; });
  }

  void requireModestMasks(std::uint64_t most) const
  {
    std::uint64_t sum = 0;
    for (const Found& found : found_) sum += found.object.mask->pixels.size();
    if (sum >= most)
      throw std::runtime_error(
          "its pixel labels have parts that reach around each other too often");
  }

  int minPixels_;
  std::vector<Found> found_;
  std::size_t leftOut_ = 0;
};

}  // namespace

CObservationObjects::Ptr boxesFromPixelLabels(
    const mrpt::obs::CObservation3DRangeScan& scan,
    const LabelTable& labels,
    int minPixels,
    std::set<std::string>& unknown,
    std::size_t* leftOut)
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
  LargestObjects objects(minPixels);
  std::uint64_t used = 0;
  for (const std::uint64_t bits : image.bits) used |= bits;
  for (const auto& [index, name] : scan.pixelLabels->pixelLabelNames)
  {
    constexpr unsigned kBits = 64;
    const std::uint64_t bit = index < kBits ? std::uint64_t{1} << index : 0;
    if ((used & bit) == 0) continue;
    if (labels.properties(name).known)
      objects.add(name, pixelsWith(bit, image, depth));
    else
      unknown.insert(withoutNumber(name));
    used &= ~bit;
  }
  if (used != 0) unknown.insert("labels without a name");
  boxes->objects = objects.take();
  if (leftOut) *leftOut = objects.leftOut();
  return boxes;
}

}  // namespace quadmap
