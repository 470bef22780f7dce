#include "boxes/BoxReader.h"

#include <filesystem>
#include <stdexcept>

#include "boxes/BoxLines.h"

namespace quadmap
{
std::unique_ptr<const BoxReader> openBoxes(const std::string& place, const std::string& labels)
{
  namespace fs = std::filesystem;
  if (fs::is_regular_file(place)) return openCocoBoxes(place, labels);
  if (!fs::is_directory(place))
    throw std::runtime_error(place + ": no such folder (of detections)");
  if (hasYoloBoxes(place)) return openYoloBoxes(place, labels);
  return openNamedBoxes(place);
}

}  // namespace quadmap
