#include <mrpt/core/format.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "MapLimits.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/GzipInput.h"
#include "quadmap/base/GzipStream.h"
#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
namespace
{
/** The class of the object an archive starts with, which MRPT writes as one byte with its length
 * and the highest bit set, then the name. Empty when these bytes start no archive. */
std::string classOfArchive(const std::string& head)
{
  constexpr unsigned kMark = 0x80;
  const unsigned first = head.empty() ? 0u : static_cast<unsigned char>(head[0]);
  const std::size_t length = first & ~kMark;
  if ((first & kMark) == 0 || head.size() < length + 1) return {};
  return head.substr(1, length);
}

/** Says in one phrase why a file that was opened is not the archive of a map.
 * \param error What reading it came to. */
std::string whyNoMap(const GzInput& input, const std::exception& error)
{
  const std::string wanted = CLASS_ID(CQuadricObjectMap)->className;
  const std::string found = classOfArchive(input.recordHead());
  if (!found.empty() && found != wanted)
    return "holds " + found + ", not an object map (" + wanted + ")";
  if (!input.failure().empty()) return input.failure();
  if (found.empty()) return "is no object map";
  return "is damaged, or of a newer version than this program knows: " +
         oneLine(rootMessage(error));
}

/** \exception std::exception For bytes that are no map; `input` then knows why. */
void readMap(GzInput& input, CQuadricObjectMap& map)
{
  input.setMostBytes(kMostStoredBytes);
  input.startRecord();
  mrpt::serialization::archiveFrom(input) >> map;
  const std::uint64_t more = input.skipToEnd();  // checks the checksum, too
  if (more > 0) throw std::runtime_error(std::to_string(more) + " bytes follow the map");
}

}  // namespace

void CQuadricObjectMap::saveToFile(const std::string& file) const { writeArchive(file, *this); }

void CQuadricObjectMap::loadFromFile(const std::string& file)
{
  if (!std::filesystem::is_regular_file(file)) throw std::runtime_error(file + ": cannot be read");
  GzInput input(file);
  CQuadricObjectMap map;
  map.labels_ = labels_;  // an archive of version 0 has none
  try
  {
    readMap(input, map);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(file + ": " + whyNoMap(input, e));
  }
  clear();  // tells who observes this map
  genericMapParams = map.genericMapParams;
  insertionOptions = map.insertionOptions;
  likelihoodOptions = map.likelihoodOptions;
  renderOptions = map.renderOptions;
  perceptionOptions = map.perceptionOptions;
  labels_ = map.labels_;
  objects_ = std::move(map.objects_);
  objectOfInstance_ = std::move(map.objectOfInstance_);
  nextId_ = map.nextId_;
}

}  // namespace quadmap
