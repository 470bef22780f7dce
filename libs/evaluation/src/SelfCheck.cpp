#include "quadmap/evaluation/SelfCheck.h"

namespace quadmap
{
namespace
{
std::optional<double> meanOf(
    const std::vector<SelfCheckedObject>& objects, std::optional<double> SelfCheckedObject::*figure)
{
  double sum = 0, count = 0;
  for (const SelfCheckedObject& object : objects)
    if (object.*figure)
    {
      sum += *(object.*figure);
      ++count;
    }
  if (count == 0) return std::nullopt;
  return sum / count;
}
}  // namespace

std::optional<double> SelfCheck::meanOnSurface() const
{
  return meanOf(objects, &SelfCheckedObject::onSurface);
}

std::optional<double> SelfCheck::meanInside() const
{
  return meanOf(objects, &SelfCheckedObject::inside);
}

std::optional<double> SelfCheck::meanBeyond() const
{
  return meanOf(objects, &SelfCheckedObject::beyond);
}

std::optional<double> SelfCheck::meanThrough() const
{
  return meanOf(objects, &SelfCheckedObject::through);
}

}  // namespace quadmap
