#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace quadmap
{
/** Hands things from one thread to another, and keeps the newest few: what is not taken in time is
 * dropped and counted. */
template <typename T>
class NewestQueue
{
 public:
  /** \param most Largest number of things that wait, >= 1. */
  explicit NewestQueue(std::size_t most) : most_(most) {}

  /** Drops the oldest thing when there are too many. */
  void push(T thing)
  {
    {
      const std::lock_guard lock(mutex_);
      things_.push_back(std::move(thing));
      if (things_.size() > most_)
      {
        things_.pop_front();
        ++dropped_;
      }
    }
    changed_.notify_one();
  }

  /** Says that nothing more comes. */
  void close()
  {
    {
      const std::lock_guard lock(mutex_);
      isClosed_ = true;
    }
    changed_.notify_all();
  }

  /** Waits for the oldest thing there is. \return Nothing when the queue is closed and empty. */
  std::optional<T> pop()
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return isClosed_ || !things_.empty(); });
    if (things_.empty()) return std::nullopt;
    T thing = std::move(things_.front());
    things_.pop_front();
    return thing;
  }

  std::size_t dropped() const
  {
    const std::lock_guard lock(mutex_);
    return dropped_;
  }

 private:
  const std::size_t most_;
  mutable std::mutex mutex_;  //!< Protects all members below
  std::condition_variable changed_;
  std::deque<T> things_;
  std::size_t dropped_ = 0;
  bool isClosed_ = false;
};

}  // namespace quadmap
