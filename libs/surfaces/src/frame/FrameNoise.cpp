#include "frame/FrameNoise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace quadmap
{
namespace
{
// Pixels beside each other share their noise, as cameras match windows of them. Windows are at most
// 14 px of an image 640 px wide; pixels so far apart err by themselves.
constexpr double kUncorrelated = 14;
constexpr int kBlock = 8;    // cells: the width of a piece of the image
constexpr int kStep = 2;     // every second cell of a block
constexpr int kEnough = 16;  // of the 32 bends in a block: it is not at a rim
// Half the blocks of an image may be bent or lie at rims: the median of the others is its quartile.
constexpr double kQuantile = 0.25;
// The quartile for furnished rooms and the camera of (4.1). Its steps of disparity and its jitter
// across the image are not in that equation; of blocks of planes the quartile is below the mean.
constexpr double kUsual = 1.1;
constexpr double kUsualBlocks = 20;  // a factor of 1 counts as many blocks
// The furniture of an image changes its factor by a tenth or two: so much more noise is none.
constexpr double kUnclear = 1.2;

/** So many cells apart errors are independent. */
int spacing(const DepthCloud& cloud)
{
  const double cells = kUncorrelated / 640 * cloud.camera().width / cloud.stride();
  return std::max(1, static_cast<int>(std::ceil(cells)));
}

/** The mean bend of some cells, equation (4.2). A plane has none. */
class Bends
{
 public:
  explicit Bends(const DepthCloud& cloud) : cloud_(cloud), apart_(spacing(cloud)) {}

  /** Adds the bend at a cell along a row or a column, if all three depths are there. */
  void add(int c, int r, int dc, int dr)
  {
    dc *= apart_;
    dr *= apart_;
    if (!cloud_.inside(c - dc, r - dr) || !cloud_.inside(c + dc, r + dr)) return;
    const double z = double(cloud_.depth(c, r)), before = double(cloud_.depth(c - dc, r - dr));
    const double after = double(cloud_.depth(c + dc, r + dr));
    if (!(z > 0 && before > 0 && after > 0)) return;
    sum_ += z * z * std::abs(1 / before - 2 / z + 1 / after) / cloud_.noise().sigma(z);
    ++count_;
  }

  int count() const { return count_; }

  /** Standard deviation of a depth over what it is believed to be. */
  double ratio() const { return sum_ / count_ * std::sqrt(M_PI_2 / 6); }

 private:
  const DepthCloud& cloud_;
  int apart_;  // cells
  double sum_ = 0;
  int count_ = 0;
};

}  // namespace

double noiseFactor(const DepthCloud& cloud, double most)
{
  std::vector<double> ratios;
  for (int top = 0; top + kBlock <= cloud.rows(); top += kBlock)
    for (int left = 0; left + kBlock <= cloud.columns(); left += kBlock)
    {
      Bends bends(cloud);
      for (int r = top; r < top + kBlock; r += kStep)
        for (int c = left; c < left + kBlock; c += kStep)
        {
          bends.add(c, r, 1, 0);
          bends.add(c, r, 0, 1);
        }
      if (bends.count() >= kEnough) ratios.push_back(bends.ratio());
    }
  if (ratios.empty()) return 1;
  const double blocks = static_cast<double>(ratios.size());
  const auto quartile = ratios.begin() + static_cast<std::ptrdiff_t>(kQuantile * blocks);
  std::nth_element(ratios.begin(), quartile, ratios.end());
  // An image with less noise does not show that surfaces are more even, hence at least 1.
  const double shown = std::clamp(*quartile / kUsual, 1.0, most);
  const double factor = (blocks * shown + kUsualBlocks) / (blocks + kUsualBlocks);
  return factor < kUnclear ? 1 : factor;
}

}  // namespace quadmap
