#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>

#include <Eigen/Dense>
#include <cstdint>
#include <string>
#include <type_traits>

namespace quadmap
{
// What the serialization of our classes is made of. MRPT's own readers believe the sizes they read
// (a damaged byte asks for gigabytes) and take half a number for a number; these throw.

/** \exception std::runtime_error "archive: " and `what`. */
[[noreturn]] void throwNotStored(const std::string& what);

/** \exception std::runtime_error "archive: " and `what`, when the condition does not hold. No text
 * is made when it does: this is asked for each byte of some files. */
inline void requireStored(bool condition, const char* what)
{
  if (!condition) throwNotStored(what);
}
inline void requireStored(bool condition, const std::string& what)
{
  if (!condition) throwNotStored(what);
}

/** Reads exactly n bytes. CArchive::ReadBuffer is content with fewer. */
void readBytes(mrpt::serialization::CArchive& in, void* to, std::size_t n);

/** One number, little endian in the stream. */
template <typename T>
T readScalar(mrpt::serialization::CArchive& in)
{
  static_assert(std::is_arithmetic_v<T>);
  T value{};
  readBytes(in, &value, sizeof(T));
#if MRPT_IS_BIG_ENDIAN
  mrpt::reverseBytesInPlace(value);
#endif
  return value;
}

/** One byte; anything but 0 is true. */
inline bool readBool(mrpt::serialization::CArchive& in)
{
  return readScalar<std::uint8_t>(in) != 0;
}

/** Reads how many things follow. \exception std::runtime_error For more than `most`. */
std::uint32_t readCount(mrpt::serialization::CArchive& in, std::uint32_t most, const char* what);

/** An enumeration stored as one byte. \param last Its greatest value. */
template <typename E>
E readEnum(mrpt::serialization::CArchive& in, E last, const char* what)
{
  const auto value = readScalar<std::uint8_t>(in);
  requireStored(value <= static_cast<std::uint8_t>(last), std::string(what) + " is out of range");
  return static_cast<E>(value);
}

/** A text of at most kMaxStoredText bytes: 4 bytes of length, then the bytes. */
constexpr std::size_t kMaxStoredText = 65536;
void writeText(mrpt::serialization::CArchive& out, const std::string& text);
std::string readText(mrpt::serialization::CArchive& in);

/** An unsigned number in as few bytes as it needs, 7 bits each, low bits first. */
void writeVarint(mrpt::serialization::CArchive& out, std::uint32_t value);
std::uint32_t readVarint(mrpt::serialization::CArchive& in);

void writeVector(mrpt::serialization::CArchive& out, const Eigen::Vector3d& v);
Eigen::Vector3d readVector(mrpt::serialization::CArchive& in);

/** x y z [m], then the unit quaternion w x y z. */
void writePose(mrpt::serialization::CArchive& out, const mrpt::poses::CPose3D& pose);
mrpt::poses::CPose3D readPose(mrpt::serialization::CArchive& in);

}  // namespace quadmap
