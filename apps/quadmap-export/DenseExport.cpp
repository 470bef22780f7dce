#include "DenseExport.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "common/ProgressBar.h"
#include "quadmap/dense/ObjectPoints.h"
#include "quadmap/dense/RoomCloud.h"

namespace quadmap
{
std::string writeDenseClouds(
    const std::string& result,
    const std::vector<ObjectRecord>& objects,
    const DenseExport& wanted,
    OutputGroup& output)
{
  std::string text;
  if (!wanted.cloud && !wanted.objectClouds) return text;
  const std::string option = wanted.cloud ? "--cloud" : "--object-clouds";
  requirePcl(option);
  if (!std::filesystem::is_directory(result))
    throw std::runtime_error(result + ": " + option + " needs a folder that quadmap-slam wrote");
  const DenseOptions options = wanted.config ? readDenseOptions(*wanted.config) : DenseOptions();
  if (wanted.cloud)
  {
    cli::ProgressBar bar;
    const DenseCloud cloud = fuseRoom(result, options, [&](double share) { bar(share); });
    if (cloud.empty())
      throw std::runtime_error(result + ": --cloud found no points in its depth images");
    writeCloud(cloud, output.add(*wanted.cloud));
    text += "wrote " + *wanted.cloud + ": " + std::to_string(cloud.size()) + " points\n";
  }
  if (!wanted.objectClouds) return text;
  cli::ProgressBar bar;
  const auto found = findObjectPoints(result, objects, options, [&](double share) { bar(share); });
  const auto isEmpty = [](const auto& one) { return one.cloud.empty(); };
  if (!found.empty() && std::all_of(found.begin(), found.end(), isEmpty))
    throw std::runtime_error(
        result + ": --object-clouds found no points of any of its " +
        std::to_string(objects.size()) + " objects");
  const auto names = writeObjectClouds(found, *wanted.objectClouds, output);
  return text + "wrote the clouds of " + std::to_string(names.size()) + " of " +
         std::to_string(objects.size()) + " objects into " + *wanted.objectClouds + "\n";
}

}  // namespace quadmap
