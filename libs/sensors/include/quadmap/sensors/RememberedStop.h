#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <utility>

namespace quadmap
{
/** The same question, of which a yes is remembered: whoever asks it, or a copy of it, later is told
 * yes, too. A program that is told to stop only once would otherwise go on when the part of it that
 * asked had nothing to stop. */
inline std::function<bool()> rememberedStop(std::function<bool()> shouldStop)
{
  return [told = std::make_shared<std::atomic<bool>>(false), ask = std::move(shouldStop)]
  {
    if (!*told && ask()) *told = true;
    return told->load();
  };
}

}  // namespace quadmap
