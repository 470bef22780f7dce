#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace quadmap
{
/** A sequence of pixels that are 0 or 1, kept as runs of equal ones: a mask of a hundred thousand
 * pixels has some hundred runs. A few bytes of a file can state millions of pixels, which take no
 * more time and memory here than those bytes. */
class MaskPixels
{
 public:
  MaskPixels() = default;
  /** Of one number per pixel; all but 0 count as 1. */
  MaskPixels(const std::vector<std::uint8_t>& pixels)
  {
    for (const auto pixel : pixels) push_back(pixel != 0);
  }
  MaskPixels(std::initializer_list<std::uint8_t> pixels) :
      MaskPixels(std::vector<std::uint8_t>(pixels))
  {
  }

  void push_back(bool pixel) { append(1, pixel); }
  /** Adds so many equal pixels. There may be 2^32 - 1 in all. */
  void append(std::uint32_t count, bool pixel)
  {
    if (count == 0) return;
    if (ends_.empty()) ends_.push_back(0);
    const bool isOfLastRun = pixel == (ends_.size() % 2 == 0);
    if (!isOfLastRun) ends_.push_back(ends_.back());
    ends_.back() += count;
  }

  std::size_t size() const { return ends_.empty() ? 0 : ends_.back(); }
  /** In logarithmic time. */
  bool operator[](std::size_t index) const
  {
    return (std::upper_bound(ends_.begin(), ends_.end(), index) - ends_.begin()) % 2 != 0;
  }
  bool hasOnes() const { return ends_.size() > 1; }
  /** One number per pixel. */
  std::vector<std::uint8_t> expanded() const
  {
    std::vector<std::uint8_t> pixels;
    pixels.reserve(size());
    for (std::size_t i = 0; i < ends_.size(); ++i) pixels.resize(ends_[i], i % 2);
    return pixels;
  }

  /** Indices behind the runs. The first run is of zeros, and may be empty. */
  const std::vector<std::uint32_t>& runEnds() const { return ends_; }

  friend bool operator==(const MaskPixels& a, const MaskPixels& b) { return a.ends_ == b.ends_; }

 private:
  std::vector<std::uint32_t> ends_;
};

}  // namespace quadmap
