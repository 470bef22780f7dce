#pragma once

#include <memory>

namespace quadmap
{
/** Makes a run on a rawlog stop when it has taken so many frames. Its onProgress counts them. */
template <typename Request>
void stopAfter(Request& request, int frames)
{
  const auto taken = std::make_shared<int>(0);
  request.onProgress = [taken](const auto&...) { ++*taken; };
  request.shouldStop = [taken, frames] { return *taken >= frames; };
}

/** Makes a run on a rawlog stop after so many frames, when it asks for the n-th time from then on.
 * It is told so once. */
template <typename Request>
void stopOnceAfter(Request& request, int frames, int n)
{
  const auto taken = std::make_shared<int>(0), asked = std::make_shared<int>(0);
  request.onProgress = [taken](const auto&...) { ++*taken; };
  request.shouldStop = [=] { return *taken >= frames && ++*asked == n; };
}
}  // namespace quadmap
