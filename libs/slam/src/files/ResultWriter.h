#pragma once

#include <string>
#include <vector>

#include "keyframes/KeyframeSpool.h"
#include "quadmap/base/ModuleTimes.h"
#include "quadmap/base/OutputSet.h"
#include "quadmap/sensors/RawlogSource.h"
#include "quadmap/slam/PoseNodes.h"
#include "quadmap/slam/SlamConfiguration.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** What the report says about the input. */
struct InputDescription
{
  std::string file, objectsFile, sensorLabel;
  std::size_t records = 0;  //!< Number of records that were read
  std::string odometryKind;
  bool interrupted = false;
  std::vector<InputProblem> problems;
};

/** Everything that the files of the output directory are made from. */
struct RunRecord
{
  std::string version;
  const InputDescription& input;
  const SlamConfiguration& configuration;
  const SlamResult& result;
  const KeyframeSpool& spool;
  ModuleTimes& times;
};

/** Writes the files of the output directory (doc/formats.md).
 * \exception std::runtime_error If one cannot be written. */
void writeResult(OutputSet& files, const RunRecord& run);

/** Writes report.json. All that differs between two runs on the same input is under "timing". */
void writeReport(const std::string& path, const std::vector<PoseNode>& nodes, const RunRecord& run);

}  // namespace quadmap
