#pragma once

#include <string>
#include <vector>

#include "quadmap/dense/CuboidProposal.h"

namespace quadmap
{
/** A proposal as a person has judged it. */
struct JudgedProposal
{
  ObjectRecord record;
  bool accept = false;
};

/** What a person would begin with: proposals whose cuboids were fully seen are accepted. */
std::vector<JudgedProposal> judged(const std::vector<CuboidProposal>& proposals);

/** The text of a file of proposals, to be corrected by hand: an INI section `[object ID]` for each,
 * with the keys label, accept, center, size, yaw_deg and orientation_defined, below a comment about
 * the sides that no camera saw. In a label, bytes that an INI file could misread are %XX. */
std::string proposalText(const std::vector<CuboidProposal>& proposals);

/** Reads a file of proposals, in its order. \exception std::runtime_error,std::invalid_argument For
 * a file that cannot be read, an unknown section or key, and a value that makes no sense; the
 * message names file, section and key. */
std::vector<JudgedProposal> readProposals(const std::string& path);

}  // namespace quadmap
