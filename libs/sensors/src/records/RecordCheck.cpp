#include "records/RecordCheck.h"

#include <mrpt/core/format.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <new>
#include <optional>
#include <stdexcept>

#include "quadmap/sensors/MemoryGuard.h"
#include "records/ReadableClasses.h"
#include "records/RecordLayouts.h"
#include "records/RecordStream.h"

namespace quadmap
{
namespace
{
constexpr std::uint8_t kEndMark = 0x88;    // MRPT writes it behind an object
constexpr std::size_t kLongestName = 120;  // of a class, as in MRPT
constexpr int kDeepest = 4;                // frame, observation, pose, matrix; more is an attack
constexpr std::uint32_t kLongestText = 65536;

std::string withoutNamespaces(const std::string& name)
{
  const auto colon = name.rfind(':');
  return colon == std::string::npos ? name : name.substr(colon + 1);
}

void requireRead(const std::string& className)
{
  RecordCheck::require(
      RecordCheck::reads(className), [&] { return "class " + className + " is unknown"; });
}
}  // namespace

RecordCheck::Head RecordCheck::headAfterFirstByte()
{
  const std::size_t begin = bytes.size() - 1;
  const unsigned first = *bytes.at(begin);
  const std::size_t length = first & ~kHeadMark;
  require((first & kHeadMark) != 0 && length <= kLongestName, "holds something that is no object");
  bytes.copy(length);
  return headAfterName(begin);
}

RecordCheck::Head RecordCheck::headAfterName(std::size_t begin)
{
  Head head;
  head.begin = begin;
  head.name = classNamed(writtenNameAt(begin + 1, bytes.size() - begin - 1));
  if (head.name == "nullptr") return head;
  head.versionAt = bytes.size();
  head.version = bytes.number<std::uint8_t>();
  return head;
}

std::string RecordCheck::classNamed(const std::string& writtenName)
{
  const auto* known = mrpt::rtti::findRegisteredClass(writtenName);
  return withoutNamespaces(known ? known->className : writtenName);
}

std::string RecordCheck::writtenNameAt(std::size_t begin, std::size_t length)
{
  const std::string bytesOfName(reinterpret_cast<const char*>(bytes.at(begin)), length);
  return bytesOfName.c_str();
}

void RecordCheck::endOfObject()
{
  require(bytes.number<std::uint8_t>() == kEndMark, "an object does not end where it should");
}

bool RecordCheck::knows(const std::string& className) { return layouts().count(className) != 0; }

bool RecordCheck::reads(const std::string& className)
{
  return isReadByMrpt(className) || knows(className);
}

bool RecordCheck::mayTry(const std::string& className)
{
  return knows(className) || className == "CObservationObjects";
}

void RecordCheck::content(const Head& head)
{
  const Layout& layout = layouts().at(head.name);
  if (layout.olderAreSafe && head.version < layout.firstVersion) return void(readUnknown(head));
  require(
      head.version >= layout.firstVersion && head.version <= layout.lastVersion,
      [&]
      {
        return mrpt::format(
            "%s is of version %d, versions %d to %d can be read", head.name.c_str(), head.version,
            layout.firstVersion, layout.lastVersion);
      });
  require(++depth_ <= kDeepest, "objects are nested in each other too deeply");
  layout.follow(*this, head);
  --depth_;
  endOfObject();
}

void RecordCheck::contentAfterName(std::size_t begin)
{
  const std::string written = writtenNameAt(begin + 1, bytes.size() - begin - 1);
  const std::string name = classNamed(written);
  if (knows(name)) return content(headAfterName(begin));
  // MRPT itself refuses what it does not know, and reads other texts like the names of classes.
  if (mrpt::rtti::findRegisteredClass(written)) requireRead(name);
}

void RecordCheck::object()
{
  bytes.copy(1);
  const Head head = headAfterFirstByte();
  if (head.name == "nullptr") return endOfObject();
  if (knows(head.name)) return content(head);
  readUnknown(head);  // to find its end
}

mrpt::serialization::CSerializable::Ptr RecordCheck::readByMrpt(std::size_t begin)
{
  RecordStream stream(*this, begin);
  try
  {
    return mrpt::serialization::archiveFrom(stream).ReadObject();
  }
  catch (...)
  {
    stream.rethrowRefusal();
    throw;
  }
}

mrpt::serialization::CSerializable::Ptr RecordCheck::readUnknown(const Head& head)
{
  requireRead(head.name);
  require(!refusesUnknown, "is of a class whose layout is not known");
  std::optional<MemoryGuard> guard;
  if (unknownDepth_++ == 0) guard.emplace();
  try
  {
    auto object = readByMrpt(head.begin);
    --unknownDepth_;
    return object;
  }
  catch (const std::bad_alloc&)
  {
    throw std::runtime_error("states sizes that take too much memory");
  }
}

int RecordCheck::objectOf(const char* className)
{
  bytes.copy(1);
  const Head head = headAfterFirstByte();
  require(head.name == className, [&] { return std::string("a ") + className + " is missing"; });
  content(head);
  return head.version;
}

std::uint32_t RecordCheck::count(std::uint32_t most, const char* what)
{
  const auto n = bytes.number<std::uint32_t>();
  require(n <= most, [&] { return mrpt::format("states %u %s, more than %u", n, what, most); });
  return n;
}

bool RecordCheck::flag()
{
  const bool isSet = bytes.number<std::uint8_t>() != 0;
  *bytes.at(bytes.size() - 1) = isSet;
  return isSet;
}

void RecordCheck::text() { bytes.copy(count(kLongestText, "characters of a text")); }

void RecordCheck::matrix()
{
  bytes.copy(1);
  const Head head = headAfterFirstByte();
  require(head.name == "CMatrixF" || head.name == "CMatrix", "a CMatrixF is missing");
  content(head);
}

void RecordCheck::image()
{
  needsPixels = true;
  objectOf("CImage");
  needsPixels = false;
}

std::uint64_t RecordCheck::pixels(std::uint64_t rows, std::uint64_t columns) const
{
  require((rows == 0) == (columns == 0), "states an image without rows, or without columns");
  require(
      rows == 0 || (rows <= limits.imagePixels && columns <= limits.imagePixels / rows),
      [&]
      {
        return mrpt::format(
            "states an image of %llux%llu pixels, more than %llu million",
            static_cast<unsigned long long>(columns), static_cast<unsigned long long>(rows),
            static_cast<unsigned long long>(limits.imagePixels >> 20));
      });
  require(
      std::max(rows, columns) <= kLongestImageSide,
      [&]
      {
        return mrpt::format(
            "states an image of %llux%llu pixels, more than %llu in a row or a column",
            static_cast<unsigned long long>(columns), static_cast<unsigned long long>(rows),
            static_cast<unsigned long long>(kLongestImageSide));
      });
  return rows * columns;
}

}  // namespace quadmap
