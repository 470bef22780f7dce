#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/DetectorModel.h"

namespace quadmap
{
/** All model files: those of share/quadmap/detectors, then those of detectorFolder(), by name. */
std::vector<std::string> allModelFiles();

/** A file that a model file names, from the model file's folder, from detectorFolder() or, as the
 * names of COCO's classes, from share/quadmap/detectors. */
std::optional<std::string> findModelPart(const std::string& modelFile, const std::string& name);

/** What is wrong with a file of a model, if its checksum is not the one that the model file states.
 * \param path Of the file. \exception std::runtime_error If it cannot be read. */
std::optional<std::string> damageOf(
    const std::string& path, const ModelPart& part, const std::string& modelFile);

}  // namespace quadmap
