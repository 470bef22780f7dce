#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "../../obs/TemporaryFolder.h"
#include "quadmap/base/GzipInput.h"
#include "quadmap/base/GzipStream.h"
#include "quadmap/sensors/CheckedReader.h"

namespace quadmap
{
inline std::string bytesOf(const mrpt::serialization::CSerializable& object)
{
  const auto bytes = archiveBytes(object);
  return {bytes.begin(), bytes.end()};
}

/** Reads the first object of a file with these bytes. */
inline mrpt::serialization::CSerializable::Ptr read(
    const std::string& bytes, const RecordLimits& limits = {})
{
  const TemporaryFolder folder;
  GzInput file(folder.write("x", bytes));
  CheckedReader reader(file, limits);
  return reader.next();
}

inline std::string with(const std::string& whole, const std::string& part, const std::string& other)
{
  const auto at = whole.find(part);
  EXPECT_NE(at, std::string::npos);
  return whole.substr(0, at) + other + whole.substr(at + part.size());
}

inline std::string number(std::uint32_t value)
{
  std::string bytes(4, '\0');
  for (int i = 0; i < 4; ++i)
    bytes[static_cast<std::size_t>(i)] = static_cast<char>(value >> (8 * i));
  return bytes;
}

/** How MRPT begins an object. */
inline std::string named(const std::string& className)
{
  return static_cast<char>(0x80 | className.size()) + className;
}

}  // namespace quadmap
