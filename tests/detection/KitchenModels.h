#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "../obs/TestData.h"

namespace quadmap
{
/** The real networks and the recording of a kitchen; the tests are skipped where they are not. */
class KitchenModels : public ::testing::Test
{
 protected:
  void SetUp() override
  {
    kitchen_ = testData("kitchen_a");
    models_ = testData("detector");
    if (kitchen_.empty() || models_.empty()) GTEST_SKIP() << "recording or networks are not there";
    ::setenv("QUADMAP_MODELS", models_.c_str(), 1);
  }
  void TearDown() override { ::unsetenv("QUADMAP_MODELS"); }

  std::string kitchen_, models_;
};

}  // namespace quadmap
