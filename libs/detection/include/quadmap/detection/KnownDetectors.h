#pragma once

#include <string>
#include <vector>

namespace quadmap
{
/** A model that has a model file, be it installed or not. */
struct KnownDetector
{
  std::string name;        //!< Of the model file, without .ini
  std::string licence;     //!< Of its weights
  bool installed = false;  //!< All its files are there and have the checksums that it states
  std::string howToGet;    //!< A command for a shell, or a sentence for models that have no source
  std::string problem;  //!< What is wrong with its model file or another one; empty when nothing is
};

/** The models of share/quadmap/detectors and those of the user's folder, by name. */
std::vector<KnownDetector> knownDetectors();

/** The model file of a known name, or of a path that ends in .ini.
 * \exception std::runtime_error If there is none; the message starts with the name. */
std::string modelFileOf(const std::string& model);

/** The folder of the user's models: $QUADMAP_MODELS or, without it, quadmap/detectors in
 * $XDG_DATA_HOME, which is ~/.local/share by default. It need not exist. */
std::string detectorFolder();

}  // namespace quadmap
