#include "quadmap/sensors/FrameSource.h"

#include "quadmap/base/ErrorText.h"

namespace quadmap
{
std::string InputProblem::text() const
{
  const std::string where = sensor.empty() ? "" : " (" + sensor + ")";
  // Labels come from the file.
  return oneLine(file + ": record " + std::to_string(record) + where + ": " + what);
}

std::optional<RgbdFrame> FrameSource::next()
{
  if (givenBack_.empty()) return read();
  RgbdFrame frame = std::move(givenBack_.front());
  givenBack_.pop_front();
  return frame;
}

void FrameSource::giveBack(const std::vector<RgbdFrame>& frames)
{
  givenBack_.insert(givenBack_.begin(), frames.begin(), frames.end());
}

}  // namespace quadmap
