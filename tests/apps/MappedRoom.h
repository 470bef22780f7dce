#pragma once

#include <gtest/gtest.h>

#include <string>

#include "RunProgram.h"

namespace quadmap
{
/** Simulates a room to PATH.rawlog and maps every frame of it into the folder PATH.
 * \param simulation Scene and options of quadmap-simulate. \param mapping Options of quadmap-slam.
 */
inline void mapRoom(
    const std::string& path, const std::string& simulation, const std::string& mapping = "")
{
  const auto simulated = runProgram("quadmap-simulate", simulation + " -o " + path + ".rawlog");
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  const auto mapped =
      runProgram("quadmap-slam", path + ".rawlog --every 1 " + mapping + " -o " + path);
  ASSERT_EQ(mapped.status, 0) << mapped.err;
}

}  // namespace quadmap
