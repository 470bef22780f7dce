#include "boxes/BoxReader.h"

#include <filesystem>
#include <stdexcept>

#include "boxes/BoxLines.h"

namespace quadmap
{
std::vector<std::string> namesOf(const FolderFrame& frame)
{
  const std::filesystem::path name = std::filesystem::path(frame.color).stem();
  if (name.extension() != ".color") return {name.string()};
  return {name.string(), name.stem().string()};
}

std::unique_ptr<const BoxReader> openBoxes(const std::string& place, const std::string& labels)
{
  namespace fs = std::filesystem;
  if (fs::is_regular_file(place)) return openCocoBoxes(place, labels);
  if (!fs::is_directory(place))
    throw std::runtime_error(place + ": no such folder (of detections)");
  if (hasYoloBoxes(place)) return openYoloBoxes(place, labels);
  return openNamedBoxes(place, labels);
}

}  // namespace quadmap
