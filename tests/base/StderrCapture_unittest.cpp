#include "quadmap/base/StderrCapture.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <thread>
#include <vector>

using namespace quadmap;

TEST(StderrCapture, ThreadsKeepEachTheirOwn)
{
  struct stat before, after;
  ASSERT_EQ(::fstat(STDERR_FILENO, &before), 0);
  std::atomic<int> wrong{0};
  const auto capture = [&wrong](char letter)
  {
    for (int i = 0; i < 100; ++i)
    {
      const StderrCapture captured;
      std::fputc(letter, stderr);
      std::this_thread::yield();
      if (captured.text() != std::string(1, letter)) ++wrong;
    }
  };
  std::vector<std::thread> threads;
  for (const char letter : {'a', 'b', 'c'}) threads.emplace_back(capture, letter);
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  ASSERT_EQ(::fstat(STDERR_FILENO, &after), 0);
  EXPECT_EQ(after.st_ino, before.st_ino) << "the terminal is there again";
}
