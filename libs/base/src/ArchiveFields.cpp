#include "quadmap/base/ArchiveFields.h"

#include <mrpt/poses/CPose3DQuat.h>

#include <cmath>
#include <stdexcept>

namespace quadmap
{
using mrpt::serialization::CArchive;

void throwNotStored(const std::string& what) { throw std::runtime_error("archive: " + what); }

void readBytes(CArchive& in, void* to, std::size_t n)
{
  auto* next = static_cast<std::uint8_t*>(to);
  while (n > 0)
  {
    const std::size_t got = in.ReadBuffer(next, n);  // throws CExceptionEOF when there is nothing
    // MRPT's stream of a compressed file returns (size_t)-1 where its data are damaged.
    requireStored(got > 0 && got <= n, "the data are damaged");
    next += got;
    n -= got;
  }
}

std::uint32_t readCount(CArchive& in, std::uint32_t most, const char* what)
{
  const auto count = readScalar<std::uint32_t>(in);
  requireStored(
      count <= most, std::string("too many ") + what + " (" + std::to_string(count) + ", at most " +
                         std::to_string(most) + ")");
  return count;
}

void writeText(CArchive& out, const std::string& text)
{
  requireStored(text.size() <= kMaxStoredText, "a text is longer than 65536 bytes");
  out.WriteAs<std::uint32_t>(text.size());
  if (!text.empty()) out.WriteBuffer(text.data(), text.size());
}

std::string readText(CArchive& in)
{
  const auto size = readScalar<std::uint32_t>(in);
  requireStored(size <= kMaxStoredText, "a text is longer than 65536 bytes");
  std::string text(size, '\0');
  readBytes(in, text.data(), size);
  return text;
}

void writeVarint(CArchive& out, std::uint32_t value)
{
  for (; value >= 0x80; value >>= 7) out.WriteAs<std::uint8_t>((value & 0x7f) | 0x80);
  out.WriteAs<std::uint8_t>(value);
}

std::uint32_t readVarint(CArchive& in)
{
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 35; shift += 7)
  {
    const auto byte = readScalar<std::uint8_t>(in);
    value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
    if (byte & 0x80) continue;
    requireStored(value <= 0xffffffffu, "a count is out of range");
    return static_cast<std::uint32_t>(value);
  }
  throw std::runtime_error("archive: a count is out of range");
}

void writeVector(CArchive& out, const Eigen::Vector3d& v)
{
  for (int i = 0; i < 3; ++i) out << v[i];
}

Eigen::Vector3d readVector(CArchive& in)
{
  Eigen::Vector3d v;
  for (int i = 0; i < 3; ++i) v[i] = readScalar<double>(in);
  return v;
}

void writePose(CArchive& out, const mrpt::poses::CPose3D& pose)
{
  const mrpt::poses::CPose3DQuat p(pose);
  for (unsigned i = 0; i < 7; ++i)
  {
    requireStored(std::isfinite(p[i]), "a pose is not finite");
    out << p[i];
  }
}

mrpt::poses::CPose3D readPose(CArchive& in)
{
  std::array<double, 7> v;
  for (auto& x : v)
  {
    x = readScalar<double>(in);
    requireStored(std::isfinite(x), "a pose is not finite");
  }
  const double norm = std::hypot(std::hypot(v[3], v[4]), std::hypot(v[5], v[6]));
  requireStored(std::abs(norm - 1.0) < 1e-6, "a quaternion is not of unit length");
  const mrpt::math::CQuaternionDouble q(v[3] / norm, v[4] / norm, v[5] / norm, v[6] / norm);
  return mrpt::poses::CPose3D(q, v[0], v[1], v[2]);
}

}  // namespace quadmap
