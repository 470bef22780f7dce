#include "CameraImport.h"

#include <mrpt/core/format.h>

#include <iostream>
#include <stdexcept>

#include "../common/ProgressBar.h"
#include "../common/SeveralOutputs.h"
#include "../common/StatusLine.h"
#include "../common/StopSignals.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/cameras/CameraSource.h"

namespace quadmap
{
namespace
{
/** Most frames that wait to be written: 2 s, 100 MB. A disk may pause for so long. */
constexpr std::size_t kMostWaiting = 60;

/** "12.3 s, 369 frames, 4 lost by the camera". */
std::string stateOf(const CameraSource& camera)
{
  const auto counts = camera.counts();
  const std::string losses = camera.lossSummary();
  return mrpt::format("%.1f s, %zu frames", counts.seconds, counts.frames) +
         (losses.empty() ? "" : ", " + losses);
}

/** Writes all frames. \return Number of those that were written. */
std::size_t writeFrames(
    CameraSource& camera, const CameraImportRequest& request, RawlogWriter& writer)
{
  cli::StatusLine line;
  cli::ProgressBar bar;
  std::size_t read = 0, written = 0;
  while (const auto frame = camera.next())
  {
    if (read++ % request.every == 0)
    {
      writer.write(*frame->scan);
      ++written;
    }
    if (camera.isLive())
      line.show([&camera] { return stateOf(camera); });
    else
      bar(camera.progress());
  }
  if (!camera.isLive() && written > 0) bar(1.0);
  return written;
}
}  // namespace

int importCamera(const CameraImportRequest& request)
{
  CameraOptions options = request.camera;
  options.mostWaiting = kMostWaiting;
  const bool isLive = request.source == kLiveCamera;
  if (isLive)
  {
    cli::onStop = cli::OnStop::Note;
    options.isEnded = [] { return cli::stopSignal != 0; };
  }
  const auto camera = openOpenNi2(request.source, options);
  camera->logging_enable_console_output = false;
  for (const auto& note : camera->notes())
    std::cerr << "quadmap-import: note: " << oneLine(request.source + ": " + note) << "\n";

  std::ostream& messages = cli::messagesBeside(request.output);
  RawlogWriter writer(request.output, request.writing);
  const std::size_t written = writeFrames(*camera, request, writer);
  const auto failure = camera->failure();
  if (written == 0) throw std::runtime_error(failure.value_or(request.source + ": no frame came"));
  if (isLive) cli::onStop = cli::OnStop::Defer;  // closing the file is short
  writer.finish();
  messages << request.output << ": " << written << " frames written (" << stateOf(*camera) << ")\n";
  if (!failure) return 0;
  std::cerr << "quadmap-import: " << *failure << "; " << request.output << " has the " << written
            << " frames before\n";
  return 1;
}

}  // namespace quadmap
