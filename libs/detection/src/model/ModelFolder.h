#pragma once

#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
/** All model files: those of share/quadmap/detectors, then those of detectorFolder(), by name. */
std::vector<std::string> allModelFiles();

/** A file that a model file names, from the model file's folder, from detectorFolder() or, as the
 * names of COCO's classes, from share/quadmap/detectors. */
std::optional<std::string> findModelPart(const std::string& modelFile, const std::string& name);

}  // namespace quadmap
