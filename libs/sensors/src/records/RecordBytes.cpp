#include "records/RecordBytes.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <stdexcept>

namespace quadmap
{
namespace
{
/** Memory grows with what was there, in such steps [bytes]. */
constexpr std::uint64_t kPiece = 1u << 20;
/** Most records without images have less [bytes]. */
constexpr std::size_t kSmallRecord = 1024;
}  // namespace

RecordBytes::RecordBytes(mrpt::io::CStream& from, std::uint64_t mostBytes) :
    from_(from), mostBytes_(mostBytes)
{
}

bool RecordBytes::begin()
{
  std::uint8_t first = 0;
  if (from_.Read(&first, 1) != 1) return false;
  bytes_.reserve(kSmallRecord);
  bytes_.assign(1, first);
  return true;
}

void RecordBytes::copy(std::uint64_t n)
{
  if (n > mostBytes_ - std::min<std::uint64_t>(mostBytes_, bytes_.size()))
    throw std::runtime_error(mrpt::format(
        "states a size of more than %llu MB", static_cast<unsigned long long>(mostBytes_ >> 20)));
  while (n > 0)
  {
    const auto piece = static_cast<std::size_t>(std::min(n, kPiece));
    const std::size_t before = bytes_.size();
    bytes_.resize(before + piece);
    if (from_.Read(bytes_.data() + before, piece) != piece)
      throw std::runtime_error("ends before the size that it states");
    n -= piece;
  }
}

void RecordBytes::skip(std::uint64_t n)
{
  const std::size_t kept = bytes_.size();
  while (n > 0)
  {
    const std::uint64_t piece = std::min(n, kPiece);
    copy(piece);
    bytes_.resize(kept);
    n -= piece;
  }
}

void RecordBytes::replaceFrom(std::size_t index, const std::vector<std::uint8_t>& bytes)
{
  bytes_.resize(index);
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

}  // namespace quadmap
