#include "quadmap/surfaces/PlaneSegmentation.h"

#include <algorithm>
#include <cstdint>

#include "frame/SurfaceRegions.h"

namespace quadmap
{
namespace
{
constexpr int kPlaneStride = SurfaceCells::kStride;
constexpr std::size_t kMaxSamples = 600;  // of a plane: 5 cm apart on a large table
constexpr int kNone = -1, kSeveral = -2;  // stand for a label that is missing or not unique
constexpr int kRimWidth = 2;              // cells; the segmentation leaves out the rim of planes

/** Replaces each value by the `best` of three: itself, and those `step` before and behind it. */
template <typename T, typename Best>
void spread(T* values, std::size_t count, std::size_t step, const Best& best)
{
  const std::vector<T> before(values, values + count);
  for (std::size_t i = step; i < count; ++i) values[i] = best(values[i], before[i - step]);
  for (std::size_t i = step; i < count; ++i) values[i - step] = best(values[i - step], before[i]);
}

}  // namespace

int PlaneSegmentation::planeAt(const DepthCloud& cloud, int c, int r, double tolerance) const
{
  const int pc = std::min(c / kPlaneStride, columns_ - 1);
  const int pr = std::min(r / kPlaneStride, rows_ - 1);
  const int only = around_[static_cast<std::size_t>(pr * columns_ + pc)];
  if (only == kNone) return -1;
  const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
  const auto distanceTo = [&](int label)
  { return std::abs(planes[static_cast<std::size_t>(label)].plane.signedDistance(p)); };
  if (only != kSeveral) return distanceTo(only) < tolerance ? only : -1;
  int best = -1, last = -1;
  double bestDistance = tolerance;
  for (int dr = -kRimWidth; dr <= kRimWidth; dr += kRimWidth)
    for (int dc = -kRimWidth; dc <= kRimWidth; dc += kRimWidth)
    {
      const int cc = pc + dc, rr = pr + dr;
      if (cc < 0 || rr < 0 || cc >= columns_ || rr >= rows_) continue;
      const int label = labels_[static_cast<std::size_t>(rr * columns_ + cc)];
      if (label < 0 || label == last) continue;
      last = label;
      const double distance = distanceTo(label);
      if (distance < bestDistance)
      {
        bestDistance = distance;
        best = label;
      }
    }
  return best;
}

std::vector<double> PlaneSegmentation::sharesWithin(const DepthCloud::CellRange& range) const
{
  std::vector<double> inside(planes.size(), 0.0);
  const int endR = std::min(rows_, range.r1 / kPlaneStride);
  const int endC = std::min(columns_, range.c1 / kPlaneStride);
  for (int r = range.r0 / kPlaneStride; r < endR; ++r)
    for (int c = range.c0 / kPlaneStride; c < endC;)
    {
      const int* row = &labels_[static_cast<std::size_t>(r * columns_)];
      const int first = c, label = row[c];  // of a run
      while (c < endC && row[c] == label) ++c;
      if (label >= 0) inside[static_cast<std::size_t>(label)] += c - first;
    }
  const double cells = static_cast<double>(labels_.size());
  for (std::size_t i = 0; i < planes.size(); ++i)
    inside[i] = planes[i].share > 0 ? inside[i] / (planes[i].share * cells) : 0.0;
  return inside;
}

PlaneSegmentation segmentPlanes(const DepthCloud& cloud, const SurfaceOptions& options)
{
  constexpr double kMinCells = 30;
  const SurfaceCells cells(cloud);
  const double all = static_cast<double>(cells.size());
  const auto regions = surfaceRegions(
      cells, static_cast<std::size_t>(std::max(kMinCells, options.planeMinArea * all)));

  PlaneSegmentation out;
  out.columns_ = cells.columns();
  out.rows_ = cells.rows();
  out.labels_.assign(cells.size(), kNone);
  for (const auto& region : regions)
  {
    ScenePlane plane;
    plane.plane = region.plane;
    plane.centroid = region.centroid;
    plane.share = static_cast<double>(region.cells.size()) / all;
    const std::size_t step = 1 + region.cells.size() / kMaxSamples;
    for (std::size_t k = 0; k < region.cells.size(); k += step)
      plane.samples.push_back(cells[region.cells[k]].point.cast<double>());
    for (const std::size_t i : region.cells) out.labels_[i] = static_cast<int>(out.planes.size());
    out.planes.push_back(std::move(plane));
  }
  out.findRims(cloud, options);
  out.findLabelsAround();
  return out;
}

void PlaneSegmentation::findLabelsAround()
{
  // Lowest and highest label of the cells that planeAt() looks at, first along the rows. As
  // unsigned, no label is above all others.
  const std::size_t width = static_cast<std::size_t>(columns_), all = labels_.size();
  std::vector<std::uint16_t> low(labels_.begin(), labels_.end());
  std::vector<std::int16_t> high(labels_.begin(), labels_.end());
  for (std::size_t row = 0; row < all; row += width)
  {
    spread(&low[row], width, kRimWidth, [](auto a, auto b) { return std::min(a, b); });
    spread(&high[row], width, kRimWidth, [](auto a, auto b) { return std::max(a, b); });
  }
  spread(low.data(), all, kRimWidth * width, [](auto a, auto b) { return std::min(a, b); });
  spread(high.data(), all, kRimWidth * width, [](auto a, auto b) { return std::max(a, b); });
  around_.resize(all);
  for (std::size_t i = 0; i < all; ++i)
    around_[i] = high[i] < 0 ? kNone : high[i] == low[i] ? high[i] : kSeveral;
}

void PlaneSegmentation::findRims(const DepthCloud& cloud, const SurfaceOptions& options)
{
  // The ends of every row and column; the hull's corners are among them.
  struct Span
  {
    int first = -1, last = -1;
  };
  constexpr int kMaxGrowth = 6;  // cells of the cloud; the segmentation stays off depth edges
  const auto grow = [&](ScenePlane& plane, int c, int r, int dc, int dr)
  {
    c *= kPlaneStride;
    r *= kPlaneStride;
    for (int i = 0; i < kMaxGrowth && cloud.inside(c + dc, r + dr) && cloud.valid(c + dc, r + dr);
         ++i, c += dc, r += dr)
    {
      const Eigen::Vector3d p = cloud.point(c + dc, r + dr).cast<double>();
      const double tolerance = options.onPlane(p.z());
      if (std::abs(plane.plane.signedDistance(p)) > tolerance) break;
    }
    if (cloud.valid(c, r)) plane.rim.push_back(cloud.point(c, r).cast<double>());
  };
  const auto scan = [&](int lines, int length, bool alongRows)
  {
    std::vector<Span> spans(planes.size());
    for (int line = 0; line < lines; ++line)
    {
      std::fill(spans.begin(), spans.end(), Span());
      const int* labels = labels_.data() + (alongRows ? line * columns_ : line);
      const int step = alongRows ? 1 : columns_;
      for (int i = 0; i < length;)
      {
        const int first = i, label = labels[i * step];  // of a run
        while (i < length && labels[i * step] == label) ++i;
        if (label < 0) continue;
        Span& span = spans[static_cast<std::size_t>(label)];
        if (span.first < 0) span.first = first;
        span.last = i - 1;
      }
      for (std::size_t k = 0; k < spans.size(); ++k)
      {
        if (spans[k].first < 0) continue;
        if (alongRows)
        {
          grow(planes[k], spans[k].first, line, -1, 0);
          grow(planes[k], spans[k].last, line, 1, 0);
        }
        else
        {
          grow(planes[k], line, spans[k].first, 0, -1);
          grow(planes[k], line, spans[k].last, 0, 1);
        }
      }
    }
  };
  scan(rows_, columns_, true);
  scan(columns_, rows_, false);
}

}  // namespace quadmap
