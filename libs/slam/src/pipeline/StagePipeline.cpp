#include "StagePipeline.h"

#include <algorithm>

namespace quadmap
{
StagePipeline::StagePipeline(
    std::vector<Stage> stages, std::size_t threads, const Capacity& capacity) :
    stages_(std::move(stages)),
    mostWaiting_(threads > 1 ? capacity.items - 1 : 0),
    mostBytes_(capacity.bytes),
    done_(stages_.size(), 0),
    busy_(stages_.size(), false)
{
  const auto work = [this]
  {
    Lock lock(mutex_);
    workUntil(lock, [this] { return stopping_; });
  };
  // There is work for one thread per stage and for the caller's.
  const std::size_t useful = std::min(threads, stages_.size() + 1);
  try
  {
    for (std::size_t i = 1; i < useful; ++i) workers_.emplace_back(work);
  }
  catch (...)
  {
    stopWorkers();
    throw;
  }
}

StagePipeline::~StagePipeline() { stopWorkers(); }

void StagePipeline::stopWorkers()
{
  {
    const Lock lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (auto& worker : workers_) worker.join();
}

void StagePipeline::add(std::size_t bytes)
{
  Lock lock(mutex_);
  ++added_;
  bytes_.push_back(bytes);
  heldBytes_ += bytes;
  changed_.notify_all();
  workUntil(lock, [this] { return failure_ ? isIdle() : hasRoom(); });
  if (failure_) std::rethrow_exception(failure_->second);
}

void StagePipeline::finish()
{
  Lock lock(mutex_);
  workUntil(lock, [this] { return isIdle(); });
  if (failure_) std::rethrow_exception(failure_->second);
}

bool StagePipeline::hasRoom() const
{
  return added_ - done_.back() <= mostWaiting_ && heldBytes_ <= mostBytes_;
}

bool StagePipeline::isFull() const
{
  const Lock lock(mutex_);
  return added_ - done_.back() >= mostWaiting_ || heldBytes_ > mostBytes_;
}

std::size_t StagePipeline::finished() const
{
  const Lock lock(mutex_);
  return done_.back();
}

void StagePipeline::workUntil(Lock& lock, const std::function<bool()>& reached)
{
  while (!reached())
    if (const auto step = nextStep())
      run(lock, *step);
    else
      changed_.wait(lock);
}

std::optional<StagePipeline::Step> StagePipeline::nextStep() const
{
  std::optional<Step> next;
  for (std::size_t stage = 0; stage < stages_.size(); ++stage)
    if (const Step step{done_[stage], stage}; isReady(step) && (!next || step < *next)) next = step;
  return next;
}

bool StagePipeline::isReady(const Step& step) const
{
  const auto& [item, stage] = step;
  if (item >= added_ || busy_[stage] || (failure_ && step >= failure_->first)) return false;
  if (stage > 0 && done_[stage - 1] <= item) return false;
  const auto& feedback = stages_[stage].feedback;
  return !feedback || item < feedback->lag || done_[feedback->stage] > item - feedback->lag;
}

void StagePipeline::run(Lock& lock, const Step& step)
{
  const auto& [item, stage] = step;
  busy_[stage] = true;
  lock.unlock();
  std::exception_ptr error;
  try
  {
    stages_[stage].work(item);
  }
  catch (...)
  {
    error = std::current_exception();
  }
  lock.lock();
  busy_[stage] = false;
  if (!error)
    complete(stage);
  else if (!failure_ || step < failure_->first)
    failure_.emplace(step, error);
  changed_.notify_all();
}

void StagePipeline::complete(std::size_t stage)
{
  ++done_[stage];
  if (stage + 1 < stages_.size()) return;
  heldBytes_ -= bytes_.front();
  bytes_.pop_front();
}

bool StagePipeline::isIdle() const
{
  return std::none_of(busy_.begin(), busy_.end(), [](bool b) { return b; }) && !nextStep();
}

}  // namespace quadmap
