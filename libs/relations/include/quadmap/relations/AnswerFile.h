#pragma once

#include <string>

#include "quadmap/relations/Questions.h"

namespace quadmap
{
/** An answer in the form of objects.json (doc/formats.md), with `question`, and with `doubtful` and
 * `reasons` of each object. */
std::string answerToJson(const Answer& answer, const std::string& question);

}  // namespace quadmap
