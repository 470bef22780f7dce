#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace quadmap
{
/** Takes numbered items through stages on several threads. An item is in one stage at a time, and a
 * stage has one item at a time, in the order of the items. A stage declares what it needs from
 * later stages. The results therefore depend on these rules only, and not on timing.
 *
 * One thread, the caller's, uses the class. It works on the stages too while it has to wait. */
class StagePipeline
{
 public:
  /** A stage begins an item when the later stage `stage` is done with the item `lag` before it. */
  struct Feedback
  {
    std::size_t stage = 0;
    std::size_t lag = 1;  //!< >= 1
  };
  struct Stage
  {
    std::function<void(std::size_t item)> work;
    std::optional<Feedback> feedback = std::nullopt;
  };

  /** How much may be under way. */
  struct Capacity
  {
    std::size_t items = 1;  //!< >= 1
    /** Of all items. One is added first and then waited for, so at most one goes beyond this; the
     * next begins when there is room again. */
    std::size_t bytes = std::numeric_limits<std::size_t>::max();
  };

  /** \param threads Number of threads with the caller's, >= 1. At most one more than stages is
   *  used.
   *  \exception std::system_error If the system has no thread left. */
  StagePipeline(std::vector<Stage> stages, std::size_t threads, const Capacity& capacity);
  ~StagePipeline();  //!< Leaves undone what has not begun
  StagePipeline(const StagePipeline&) = delete;
  StagePipeline& operator=(const StagePipeline&) = delete;

  /** Begins the next item, the first of which is 0. It returns when there is room for one more item
   *  or, with one thread, when the item is done.
   *  \param bytes Memory that the item holds.
   *  \exception Whatever the work of an item threw, and of several what one thread would have met
   *  first. Nothing later is begun then, and the pipeline cannot go on. */
  void add(std::size_t bytes = 0);

  /** Waits until all items went through all stages. \exception As in add(). */
  void finish();

  /** Whether add() would wait for room, or work itself as there is only the caller's thread. */
  bool isFull() const;

  /** Number of items that went through all stages, which is also the next item that will. */
  std::size_t finished() const;

 private:
  using Step = std::pair<std::size_t, std::size_t>;  //!< Item and stage; one thread's order
  using Lock = std::unique_lock<std::mutex>;

  void stopWorkers();
  void workUntil(Lock& lock, const std::function<bool()>& reached);
  std::optional<Step> nextStep() const;
  void run(Lock& lock, const Step& step);
  void complete(std::size_t stage);
  bool isReady(const Step& step) const;
  bool hasRoom() const;
  bool isIdle() const;

  const std::vector<Stage> stages_;
  const std::size_t mostWaiting_;  //!< Items that may be under way when add() returns
  const std::size_t mostBytes_;    //!< Of all items that may be under way when add() returns
  mutable std::mutex mutex_;       //!< Protects all members below
  std::condition_variable changed_;
  std::size_t added_ = 0;
  std::deque<std::size_t> bytes_;  //!< Of each item under way
  std::size_t heldBytes_ = 0;      //!< Of all of them
  std::vector<std::size_t> done_;  //!< Number of items done by each stage
  std::vector<bool> busy_;         //!< Whether each stage works
  std::optional<std::pair<Step, std::exception_ptr>> failure_;  //!< The first by order of steps
  bool stopping_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace quadmap
