#pragma once

#include <mrpt/graphs/TNodeID.h>

#include <string>
#include <vector>

namespace quadmap
{
/** A comment of a pose graph: when the robot was at a node. */
struct NodeTime
{
  mrpt::graphs::TNodeID node = 0;
  double time = 0;    //!< [s]
  std::string place;  //!< FILE:LINE, for messages
};

/** Checks the lines of a pose graph. MRPT's reader passes over lines it does not know, and takes
 * any number and any edge.
 * \return The times, which are comments for MRPT.
 * \exception std::runtime_error For an unknown entry, a number that cannot be right, a node that is
 * given twice, an edge to a node that is not there, and two nodes with one time. The message names
 * file and line. */
std::vector<NodeTime> checkGraphText(const std::string& text, const std::string& path);

}  // namespace quadmap
