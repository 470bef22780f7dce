#include "pipeline/StagePipeline.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>

using namespace quadmap;
using Stages = std::vector<StagePipeline::Stage>;

namespace
{
constexpr std::size_t kItems = 200;

/** Waits for a time that differs between items and stages. */
void dawdle(std::size_t item, std::size_t stage)
{
  std::this_thread::sleep_for(std::chrono::microseconds((item * 37 + stage * 61) % 5 * 50));
}

/** Three stages that note what they did. Stage 1 reads what stage 0 left, and stage 0 reads what
 * stage 1 left two items earlier. */
class Recurrence
{
 public:
  explicit Recurrence(std::size_t threads, std::size_t capacity = 4) :
      pipeline_(
          {
              { [this](std::size_t i) { first(i); }, StagePipeline::Feedback{1, 2}},
              {[this](std::size_t i) { second(i); }                              },
              { [this](std::size_t i) { third(i); }                              }
  },
          threads,
          StagePipeline::Capacity{capacity})
  {
  }

  std::vector<unsigned> run()
  {
    for (std::size_t i = 0; i < kItems; ++i) pipeline_.add();
    pipeline_.finish();
    EXPECT_EQ(pipeline_.finished(), kItems);
    return result_;
  }

 private:
  void first(std::size_t i)
  {
    dawdle(i, 0);
    a_[i] = static_cast<unsigned>(i) + (i < 2 ? 0 : 3 * b_[i - 2]);
  }
  void second(std::size_t i)
  {
    dawdle(i, 1);
    b_[i] = 5 * a_[i] + (i < 1 ? 0 : b_[i - 1]);
  }
  void third(std::size_t i)
  {
    dawdle(i, 2);
    result_.push_back(b_[i]);
  }

  std::vector<unsigned> a_ = std::vector<unsigned>(kItems), b_ = a_, result_;
  StagePipeline pipeline_;
};

/** The text of the error of a run in which some steps (item, stage) fail. */
std::string firstError(
    std::size_t threads, const std::vector<std::pair<std::size_t, std::size_t>>& failing)
{
  const auto stage = [&](std::size_t s)
  {
    return [&failing, s](std::size_t item)
    {
      dawdle(item, s);
      for (const auto& f : failing)
        if (f == std::make_pair(item, s))
          throw std::runtime_error(std::to_string(item) + "/" + std::to_string(s));
    };
  };
  StagePipeline pipeline({{stage(0)}, {stage(1)}, {stage(2)}}, threads, {4});
  try
  {
    for (std::size_t i = 0; i < 30; ++i) pipeline.add();
    pipeline.finish();
  }
  catch (const std::runtime_error& e)
  {
    EXPECT_THROW(pipeline.finish(), std::runtime_error) << "it stays failed";
    return e.what();
  }
  return "none";
}
}  // namespace

TEST(StagePipelineThreads, GiveTheSameAsALoop)
{
  std::vector<unsigned> a(kItems), b(kItems);
  for (std::size_t i = 0; i < kItems; ++i)
  {
    a[i] = static_cast<unsigned>(i) + (i < 2 ? 0 : 3 * b[i - 2]);
    b[i] = 5 * a[i] + (i < 1 ? 0 : b[i - 1]);
  }
  for (const std::size_t threads : {1u, 2u, 3u, 8u})
    EXPECT_EQ(Recurrence(threads).run(), b) << threads << " threads";
  EXPECT_EQ(Recurrence(3, 1).run(), b) << "one item at a time";
}

TEST(StagePipelineThreads, TheErrorIsTheOneThatOneThreadMeetsFirst)
{
  for (const std::size_t threads : {1u, 2u, 4u})
  {
    SCOPED_TRACE(threads);
    EXPECT_EQ(firstError(threads, {}), "none");
    EXPECT_EQ(
        firstError(
            threads,
            {
                {7, 1}
    }),
        "7/1");
    EXPECT_EQ(
        firstError(
            threads,
            {
                {8, 0},
                {7, 2},
                {9, 0}
    }),
        "7/2");
    EXPECT_EQ(
        firstError(
            threads,
            {
                {29, 2}
    }),
        "29/2")
        << "the last one of all";
  }
}

TEST(StagePipelineThreads, OneThreadIsTheCallers)
{
  const auto caller = std::this_thread::get_id();
  std::size_t works = 0;
  const auto work = [&](std::size_t)
  {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    ++works;
  };
  StagePipeline pipeline({{work}, {work}}, 1, {4});
  for (std::size_t i = 1; i <= 5; ++i)
  {
    pipeline.add();
    EXPECT_EQ(works, 2 * i) << "nothing is put off";
    EXPECT_EQ(pipeline.finished(), i);
  }
}

TEST(StagePipelineThreads, StagesWorkAtTheSameTime)
{
  // Each stage waits for the other one to be at work: alone, neither would end.
  std::atomic<bool> firstAtWork{false}, secondAtWork{false};
  const auto first = [&](std::size_t item)
  {
    if (item == 0) return;
    firstAtWork = true;
    while (!secondAtWork) std::this_thread::yield();
  };
  const auto second = [&](std::size_t item)
  {
    if (item > 0) return;
    secondAtWork = true;
    while (!firstAtWork) std::this_thread::yield();
  };
  StagePipeline pipeline({{first}, {second}}, 2, {4});
  pipeline.add();
  pipeline.add();
  pipeline.finish();
  EXPECT_EQ(pipeline.finished(), 2u);
}

TEST(StagePipelineThreads, NoMoreItemsThanTheCapacityAreUnderWay)
{
  std::atomic<std::size_t> begun{0}, ended{0}, most{0};
  const auto first = [&](std::size_t) { most = std::max<std::size_t>(most, ++begun - ended); };
  const auto last = [&](std::size_t item)
  {
    dawdle(item, 1);
    ++ended;
  };
  StagePipeline pipeline({{first}, {last}}, 3, {3});
  for (std::size_t i = 0; i < 50; ++i)
  {
    pipeline.add();
    EXPECT_LT(i + 1 - pipeline.finished(), 3u) << "room for one more";
  }
  pipeline.finish();
  EXPECT_LE(most, 3u);
}

TEST(StagePipelineThreads, WhatIsUnderWayIsBoundedByItsBytes)
{
  std::mutex mutex;
  std::size_t held = 0, most = 0, mostItems = 0;
  std::vector<std::size_t> order;
  const std::vector<std::size_t> sizes = {30, 30, 30, 30, 500, 10, 60, 60, 500, 500, 20, 20};
  const auto last = [&](std::size_t item)
  {
    dawdle(item, 1);
    const std::lock_guard<std::mutex> lock(mutex);
    order.push_back(item);
    held -= sizes[item];
  };
  StagePipeline pipeline({{[](std::size_t) {}}, {last}}, 3, {4, 100});
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      EXPECT_LE(held, 100u) << "when item " << i << " begins";
      held += sizes[i];
      most = std::max(most, held);
    }
    pipeline.add(sizes[i]);
    mostItems = std::max(mostItems, i + 1 - pipeline.finished());
  }
  pipeline.finish();
  EXPECT_LE(most, 600u);
  EXPECT_LE(mostItems, 3u);
  std::vector<std::size_t> expected(sizes.size());
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(order, expected);
}

TEST(StagePipelineThreads, EndInTheMiddleLeavesTheRestUndone)
{
  std::atomic<std::size_t> done{0};
  const auto slow = [&](std::size_t)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ++done;
  };
  {
    StagePipeline pipeline({{slow}}, 2, {100});
    for (int i = 0; i < 50; ++i) pipeline.add();
  }
  EXPECT_LT(done, 50u);
}

TEST(StagePipelineThreads, NoMoreAreBegunThanCanWork)
{
  std::mutex mutex;
  std::set<std::thread::id> workers;
  const auto work = [&](std::size_t)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    workers.insert(std::this_thread::get_id());
  };
  StagePipeline pipeline({{work}, {work}}, 5000, {4});
  for (int i = 0; i < 2000; ++i) pipeline.add();
  pipeline.finish();
  EXPECT_LE(workers.size(), 3u);
}

#ifdef QUADMAP_SANITIZED
constexpr bool kSanitized = true;  // these take terabytes of addresses
#else
constexpr bool kSanitized = false;
#endif

namespace
{
/** Ends with status 0 when the system ran out of threads in between and this was an error like
 * others. */
[[noreturn]] void startWithFewThreadsLeft()
{
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  constexpr rlim_t kPage = 4096, kLeft = 200u << 20;  // room for some of the threads [bytes]
  const rlim_t bytes = static_cast<rlim_t>(pages) * kPage + kLeft;
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
  const StagePipeline::Stage idle{[](std::size_t) {}};
  try
  {
    StagePipeline pipeline(Stages(500, idle), 501, {4});
  }
  catch (const std::system_error&)
  {
    std::_Exit(0);
  }
  std::_Exit(1);
}
}  // namespace

TEST(StagePipelineThreads, NoneLeftIsAnErrorAndNotTheEnd)
{
  if (kSanitized) GTEST_SKIP() << "memory cannot be limited";
  EXPECT_EXIT(startWithFewThreadsLeft(), ::testing::ExitedWithCode(0), "");
}
