#pragma once

#include <gtest/gtest.h>

#include <string>

#include "../folders/SampleRecording.h"
#include "RunProgram.h"

namespace quadmap
{
/** A good recording to spoil, and a folder for what is written. */
class QuadmapImport : public ::testing::Test
{
 protected:
  /** Arguments with IN for the recording and OUT for the output folder. */
  ProgramResult run(const std::string& arguments)
  {
    return runProgram(
        "quadmap-import",
        replaced(replaced(arguments, "IN", recording_.folder()), "OUT", out_.folder().string()));
  }

  SampleRecording recording_;
  TemporaryFolder out_;
};

inline void expectImportFailure(const ProgramResult& result, const std::string& part)
{
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(isOneLine(result.err)) << result.err;
  EXPECT_EQ(result.err.find("quadmap-import: "), 0u) << result.err;
  EXPECT_NE(result.err.find(part), kNotFound) << "'" << part << "' is not in: " << result.err;
}
}  // namespace quadmap
