#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../SampleRawlog.h"

namespace quadmap
{
inline RawlogSourceOptions keepGoing()
{
  RawlogSourceOptions options;
  options.keepGoing = true;
  return options;
}

/** Expects that strict reading fails with one line that has all of `parts`, and that reading with
 * keepGoing gives `framesLeft` frames and lists the same line. */
inline void expectProblem(
    const std::string& file, const std::vector<std::string>& parts, std::size_t framesLeft)
{
  const std::string error = errorOf([&] { readAll(file); });
  for (const auto& part : parts)
    EXPECT_NE(error.find(part), std::string::npos) << "'" << part << "' is not in: " << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;

  RawlogSource source(file, keepGoing());
  EXPECT_EQ(readAll(source).size(), framesLeft);
  ASSERT_FALSE(source.problems().empty());
  EXPECT_EQ(source.problems().front().text(), error);
}
}  // namespace quadmap
