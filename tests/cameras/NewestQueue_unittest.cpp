#include "NewestQueue.h"

#include <gtest/gtest.h>

#include <thread>

using namespace quadmap;

TEST(NewestQueue, KeepsTheNewestAndCountsTheOthers)
{
  NewestQueue<int> queue(3);
  for (int i = 0; i < 10; ++i) queue.push(i);
  queue.close();
  EXPECT_EQ(queue.dropped(), 7u);
  for (int i = 7; i < 10; ++i) EXPECT_EQ(queue.pop(), i);
  EXPECT_FALSE(queue.pop());
}

TEST(NewestQueue, WaitsForWhatComes)
{
  NewestQueue<int> queue(1000);
  std::thread writer(
      [&queue]
      {
        for (int i = 0; i < 1000; ++i) queue.push(i);
        queue.close();
      });
  int expected = 0;
  while (const auto thing = queue.pop()) EXPECT_EQ(*thing, expected++);
  EXPECT_EQ(expected, 1000);
  writer.join();
}
