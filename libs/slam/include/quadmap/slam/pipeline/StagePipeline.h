#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace quadmap
{
/** Takes numbered items through stages on several threads. An item is in one stage at a time, and a
 * stage has one item at a time, in their order. What a stage needs of later stages it says, so that
 * results depend on these rules alone and not on timing.
 *
 * To be used from one thread, the caller's, which works on the stages too while it has to wait. */
class StagePipeline
{
 public:
  /** An item is begun when the later stage `stage` is done with the one `lag` before it. */
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

  /** \param threads That work, the caller's included, >= 1; at most one more than stages are begun.
   *  \param capacity Most items under way, >= 1.
   *  \exception std::system_error If the system has no thread left. */
  StagePipeline(std::vector<Stage> stages, std::size_t threads, std::size_t capacity);
  ~StagePipeline();  //!< What has not begun is left undone
  StagePipeline(const StagePipeline&) = delete;
  StagePipeline& operator=(const StagePipeline&) = delete;

  /** Begins the next item; the first is 0. Returns when there is room for one more; with one
   *  thread, when the item is done.
   *  \exception Whatever the work of an item threw: what one thread would have met first. Nothing
   *  later than that is begun then, and there is no going on. */
  void add();

  /** Returns when all items went through all stages. \exception As in add(). */
  void finish();

  /** \return Items that went through all stages; also the number of the next that will. */
  std::size_t finished() const;

 private:
  using Step = std::pair<std::size_t, std::size_t>;  //!< Item and stage; one thread's order
  using Lock = std::unique_lock<std::mutex>;

  void stopWorkers();
  void workUntil(Lock& lock, const std::function<bool()>& reached);
  std::optional<Step> nextStep() const;
  void run(Lock& lock, const Step& step);
  bool isReady(const Step& step) const;
  bool isIdle() const;

  const std::vector<Stage> stages_;
  const std::size_t mostWaiting_;  //!< Items that may be under way when add() returns
  mutable std::mutex mutex_;       //!< Of all below
  std::condition_variable changed_;
  std::size_t added_ = 0;
  std::vector<std::size_t> done_;                               //!< Items, by each stage
  std::vector<bool> busy_;                                      //!< Each stage
  std::optional<std::pair<Step, std::exception_ptr>> failure_;  //!< The first by order of steps
  bool stopping_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace quadmap
