#pragma once

#include <memory>

namespace quadmap
{
/** Makes a run on a rawlog stop when it has taken some frames. */
template <typename Request>
void stopAfter(Request& request, int frames)
{
  const auto taken = std::make_shared<int>(0);
  request.onProgress = [taken](const auto&...) { ++*taken; };
  request.shouldStop = [taken, frames] { return *taken >= frames; };
}
}  // namespace quadmap
