#include "quadmap/sensors/FrameSource.h"

#include <string_view>
#include <utility>

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

void FrameSource::sendWarningsTo(std::function<void(const std::string&)> receiver)
{
  logging_enable_console_output = false;
  logRegisterCallback(
      [receiver = std::move(receiver)](
          std::string_view text, mrpt::system::VerbosityLevel level, std::string_view, auto)
      {
        if (level == mrpt::system::LVL_WARN) receiver(std::string(text));
      });
}

std::string ofSensor(const std::string& sensorLabel)
{
  return sensorLabel.empty() ? "" : " of a sensor \"" + sensorLabel + "\"";
}

std::string FrameSource::whyNoFrames(const std::string& sensorLabel) const
{
  std::string text =
      "no usable RGB-D images" + ofSensor(sensorLabel) + "; it has " + contentSummary();
  const auto& leftOut = problems();
  if (!leftOut.empty())
    text += "; left out: " + std::to_string(leftOut.size()) + ", the first being " +
            leftOut.front().text();
  return text;
}

void FrameSource::giveBack(const std::vector<RgbdFrame>& frames)
{
  givenBack_.insert(givenBack_.begin(), frames.begin(), frames.end());
}

}  // namespace quadmap
