#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "records/RecordCheck.h"

namespace quadmap
{
constexpr std::uint64_t kFloat = sizeof(float), kTime = 8;  // of members [bytes]

/** How a class of MRPT 2.5.8 stores itself, for the versions that can be followed. */
struct Layout
{
  int firstVersion, lastVersion;
  /** Older versions hold nothing that a memory limit does not catch, and MRPT may read them. */
  bool olderAreSafe;
  void (*follow)(RecordCheck& check, const RecordCheck::Head& head);
};

/** The known classes by their name without namespaces. */
const std::map<std::string, Layout>& layouts();

void followRangeScan(RecordCheck& check, const RecordCheck::Head& head);

/** A CImage. Where it is a JPEG, its pixels take its place, or none when nobody needs them. */
void followImage(RecordCheck& check, const RecordCheck::Head& head);

}  // namespace quadmap
