#include "records/RecordCheck.h"

#include <mrpt/core/format.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

#include "records/MemoryGuard.h"
#include "records/RecordLayouts.h"

namespace quadmap
{
namespace
{
constexpr unsigned kHeadMark = 0x80;       // MRPT writes the length of a class name with this bit
constexpr std::uint8_t kEndMark = 0x88;    // and this byte behind an object
constexpr std::size_t kLongestName = 120;  // of a class, as in MRPT
constexpr int kDeepest = 4;                // frame, observation, pose, matrix; more is an attack
constexpr std::uint32_t kLongestText = 65536;

std::string withoutNamespaces(const std::string& name)
{
  const auto colon = name.rfind(':');
  return colon == std::string::npos ? name : name.substr(colon + 1);
}
}  // namespace

void RecordCheck::require(bool condition, const std::string& what)
{
  if (!condition) throw std::runtime_error(what);
}

RecordCheck::Head RecordCheck::headAfterFirstByte()
{
  Head head;
  head.begin = bytes.size() - 1;
  const unsigned first = *bytes.at(head.begin);
  const std::size_t length = first & ~kHeadMark;
  require((first & kHeadMark) != 0 && length <= kLongestName, "holds something that is no object");
  bytes.copy(length);
  const char* name = reinterpret_cast<const char*>(bytes.at(head.begin + 1));
  head.name = withoutNamespaces(std::string(name, length));
  if (head.name == "nullptr") return head;
  head.versionAt = bytes.size();
  head.version = bytes.number<std::uint8_t>();
  return head;
}

void RecordCheck::endOfObject()
{
  require(bytes.number<std::uint8_t>() == kEndMark, "an object does not end where it should");
}

bool RecordCheck::knows(const std::string& className) { return layouts().count(className) != 0; }

void RecordCheck::content(const Head& head)
{
  const Layout& layout = layouts().at(head.name);
  if (layout.olderAreSafe && head.version < layout.firstVersion) return readByMrpt(head);
  require(
      head.version >= layout.firstVersion && head.version <= layout.lastVersion,
      mrpt::format(
          "%s is of version %d, versions %d to %d can be read", head.name.c_str(), head.version,
          layout.firstVersion, layout.lastVersion));
  require(++depth_ <= kDeepest, "objects are nested in each other too deeply");
  layout.follow(*this, head);
  --depth_;
  endOfObject();
}

void RecordCheck::object()
{
  bytes.copy(1);
  const Head head = headAfterFirstByte();
  if (head.name == "nullptr") return endOfObject();
  if (knows(head.name)) return content(head);
  require(
      mrpt::rtti::findRegisteredClass(head.name) != nullptr, "class " + head.name + " is unknown");
  readByMrpt(head);
}

/** Finds the end of an object whose layout is not known here. */
void RecordCheck::readByMrpt(const Head& head)
{
  const MemoryGuard guard;
  bytes.rereadFrom(head.begin);
  mrpt::serialization::archiveFrom(bytes).ReadObject();
}

int RecordCheck::objectOf(const char* className)
{
  bytes.copy(1);
  const Head head = headAfterFirstByte();
  require(head.name == className, std::string("a ") + className + " is missing");
  content(head);
  return head.version;
}

std::uint32_t RecordCheck::count(std::uint32_t most, const char* what)
{
  const auto n = bytes.number<std::uint32_t>();
  require(n <= most, mrpt::format("states %u %s, more than %u", n, what, most));
  return n;
}

void RecordCheck::text() { bytes.copy(count(kLongestText, "characters of a text")); }

void RecordCheck::matrix()
{
  bytes.copy(1);
  const Head head = headAfterFirstByte();
  require(head.name == "CMatrixF" || head.name == "CMatrix", "a CMatrixF is missing");
  content(head);
}

void RecordCheck::image() { objectOf("CImage"); }

std::uint64_t RecordCheck::pixels(std::uint64_t rows, std::uint64_t columns) const
{
  require(
      (rows == 0 && columns == 0) || (rows > 0 && columns > 0 && rows <= limits.imagePixels &&
                                      columns <= limits.imagePixels / rows),
      mrpt::format(
          "states an image of %llux%llu pixels, more than %llu million",
          static_cast<unsigned long long>(columns), static_cast<unsigned long long>(rows),
          static_cast<unsigned long long>(limits.imagePixels >> 20)));
  return rows * columns;
}

}  // namespace quadmap
