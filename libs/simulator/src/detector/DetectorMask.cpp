#include "detector/DetectorMask.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace quadmap::simulator
{
namespace
{
constexpr double kWaveLength = 24;   // of the border's errors, a network's grid [px at 640]
constexpr unsigned kMaxLabels = 64;  // number of bits that MRPT has for a pixel

/** A smooth random field of shifts (u, v), bilinear between the nodes of a grid [px]. */
class ShiftField
{
 public:
  ShiftField(const PinholeCamera& camera, double sigma, RandomStream& random) :
      cell_(std::max(2.0, kWaveLength * camera.width / 640.0)),
      columns_(static_cast<std::size_t>(camera.width / cell_) + 2)
  {
    const auto rows = static_cast<std::size_t>(camera.height / cell_) + 2;
    // Interpolation between nodes leaves 4/9 of the variance on average.
    const double atNodes = 1.5 * sigma;
    for (std::size_t i = 0; i < rows * columns_; ++i)
      nodes_.emplace_back(atNodes * random.gaussian(), atNodes * random.gaussian());
  }

  Eigen::Vector2d at(int u, int v) const
  {
    const double x = u / cell_, y = v / cell_;
    const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y);
    const double a = x - static_cast<double>(i), b = y - static_cast<double>(j);
    const Eigen::Vector2d* node = &nodes_[j * columns_ + i];
    return (1 - b) * ((1 - a) * node[0] + a * node[1]) +
           b * ((1 - a) * node[columns_] + a * node[columns_ + 1]);
  }

 private:
  const double cell_;  // [px]
  const std::size_t columns_;
  std::vector<Eigen::Vector2d> nodes_;
};

/** The names that label the pixels of each object, by its index. */
std::map<std::size_t, std::string> namesOf(
    const Detections& found, const Scene& scene, DetectorOutput output)
{
  std::map<std::size_t, std::string> names;
  for (std::size_t i = 0; i < found.boxes.size(); ++i)
  {
    if (!found.truth[i]) continue;
    std::string name = found.boxes[i].label;
    if (output == DetectorOutput::Instances)
    {
      const std::string& label = scene.objects[*found.truth[i]].label;
      const auto before = std::count_if(
          scene.objects.begin(),
          scene.objects.begin() + static_cast<std::ptrdiff_t>(*found.truth[i]),
          [&](const SceneObject& object) { return object.label == label; });
      name += "_" + std::to_string(before + 1);
    }
    names[*found.truth[i]] = name;
  }
  return names;
}

/** The smallest kind of label image that has room for so many labels. */
std::shared_ptr<mrpt::obs::TPixelLabelInfoBase> labelImageFor(std::size_t labels)
{
  if (labels <= 8) return std::make_shared<mrpt::obs::TPixelLabelInfo<1>>();
  if (labels <= 16) return std::make_shared<mrpt::obs::TPixelLabelInfo<2>>();
  if (labels <= 32) return std::make_shared<mrpt::obs::TPixelLabelInfo<4>>();
  return std::make_shared<mrpt::obs::TPixelLabelInfo<8>>();
}

}  // namespace

std::optional<ObjectMask> noisyMask(
    const RenderedFrame& frame,
    std::size_t object,
    const ImageBox& within,
    double sigma,
    RandomStream& random)
{
  const ShiftField shifts(frame.camera, sigma, random);
  const int width = static_cast<int>(frame.camera.width);
  const int height = static_cast<int>(frame.camera.height);
  const int u1 = std::max(0, static_cast<int>(std::lround(within.x1)));
  const int v1 = std::max(0, static_cast<int>(std::lround(within.y1)));
  const int u2 = std::min(width - 1, static_cast<int>(std::lround(within.x2)));
  const int v2 = std::min(height - 1, static_cast<int>(std::lround(within.y2)));
  if (u1 > u2 || v1 > v2) return std::nullopt;

  ObjectMask mask;
  mask.x0 = static_cast<unsigned>(u1);
  mask.y0 = static_cast<unsigned>(v1);
  mask.width = static_cast<unsigned>(u2 - u1 + 1);
  mask.height = static_cast<unsigned>(v2 - v1 + 1);
  for (int v = v1; v <= v2; ++v)
    for (int u = u1; u <= u2; ++u)
    {
      const Eigen::Vector2d shift = shifts.at(u, v);
      const int x = std::clamp(static_cast<int>(std::lround(u + shift.x())), 0, width - 1);
      const int y = std::clamp(static_cast<int>(std::lround(v + shift.y())), 0, height - 1);
      const auto i = static_cast<std::size_t>(y * width + x);
      mask.pixels.push_back(frame.object[i] == static_cast<std::int32_t>(object));
    }
  if (!mask.pixels.hasOnes()) return std::nullopt;
  return mask;
}

void addMasks(
    Detections& found,
    const RenderedFrame& frame,
    const DetectorOptions& options,
    RandomStream& random)
{
  const double sigma = options.maskJitter * frame.camera.width / 640.0;
  const ImageBox everywhere{
      0, 0, static_cast<double>(frame.camera.width), static_cast<double>(frame.camera.height)};
  for (std::size_t i = 0; i < found.boxes.size(); ++i)
  {
    if (!found.truth[i]) continue;
    const bool alone = options.output == DetectorOutput::Masks;
    found.boxes[i].mask =
        noisyMask(frame, *found.truth[i], alone ? found.boxes[i].box : everywhere, sigma, random);
  }
}

void labelPixels(
    const Detections& found,
    const Scene& scene,
    DetectorOutput output,
    mrpt::obs::CObservation3DRangeScan& scan)
{
  const auto names = namesOf(found, scene, output);
  std::map<std::string, std::uint8_t> bitOf;
  for (const auto& [object, name] : names)
    if (bitOf.size() < kMaxLabels) bitOf.emplace(name, static_cast<std::uint8_t>(bitOf.size()));

  scan.pixelLabels = labelImageFor(bitOf.size());
  scan.pixelLabels->setSize(
      static_cast<int>(scan.cameraParams.nrows), static_cast<int>(scan.cameraParams.ncols));
  for (const auto& [name, bit] : bitOf) scan.pixelLabels->setLabelName(bit, name);
  for (std::size_t i = 0; i < found.boxes.size(); ++i)
  {
    const auto& mask = found.boxes[i].mask;
    if (!found.truth[i] || !mask) continue;
    const auto bit = bitOf.find(names.at(*found.truth[i]));
    if (bit == bitOf.end()) continue;
    for (unsigned v = 0; v < mask->height; ++v)
      for (unsigned u = 0; u < mask->width; ++u)
        if (mask->pixels[std::size_t{v} * mask->width + u])
          scan.pixelLabels->setLabel(
              static_cast<int>(mask->y0 + v), static_cast<int>(mask->x0 + u), bit->second);
  }
}

}  // namespace quadmap::simulator
