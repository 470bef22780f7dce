#include "FolderSummary.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <exception>

#include "quadmap/base/ErrorText.h"

namespace quadmap
{
namespace
{
void writeCamera(const FrameFolder& folder, std::ostream& out)
{
  const auto& c = folder.camera();
  out << mrpt::format(
      "  camera: %s, %ux%u, fx %g, fy %g, cx %g, cy %g", c.origin.c_str(), c.color.ncols,
      c.color.nrows, c.color.fx(), c.color.fy(), c.color.cx(), c.color.cy());
  if (c.isDistorted()) out << "; distorted, hence rectified";
  if (c.depth) out << "; depth is registered to colour by the import";
  const auto& r = folder.rectifiedCamera();
  if (r.ncols != c.color.ncols)
    out << mrpt::format("; colour is scaled to %ux%u", r.ncols, r.nrows);
  out << "\n";
}

void writeDetections(const FrameFolder& folder, std::ostream& out)
{
  if (!folder.hasDetections())
  {
    out << "  detections: none\n";
    return;
  }
  std::size_t boxes = 0, without = 0, unreadable = 0;
  for (std::size_t i = 0; i < folder.frames().size(); ++i) try
    {
      const auto found = folder.boxes(i);
      boxes += found ? found->objects.size() : 0;
      without += found ? 0 : 1;
    }
    catch (const std::exception&)
    {
      ++unreadable;  // the check says why
    }
  out << "  detections: " << oneLine(folder.detections()) << ", " << boxes << " boxes";
  if (without > 0) out << "; missing for " << without << " images";
  if (unreadable > 0) out << "; unreadable for " << unreadable << " images";
  out << "\n";
}
}  // namespace

void writeSummary(const FrameFolder& folder, const std::string& up, std::ostream& out)
{
  const auto& frames = folder.frames();
  out << oneLine(folder.folder()) << " (" << folder.kind() << ")\n  frames: " << frames.size()
      << mrpt::format(" in %g s", frames.back().time - frames.front().time) << ", colour and depth "
      << folder.pairing();
  if (folder.unpaired() > 0) out << "; " << folder.unpaired() << " images without a partner";
  out << "\n";
  writeCamera(folder, out);
  out << "  poses: ";
  if (folder.poses().empty())
    out << "none\n";
  else
    out << folder.posesCount() << " of " << frames.size() << " frames, of " << folder.poses()
        << "\n";
  out << "  up: " << up << "\n";
  writeDetections(folder, out);
}

void writeProblems(const FolderProblems& problems, std::ostream& out)
{
  constexpr std::size_t kExamples = 3;
  if (problems.empty()) out << "no problem found\n";
  for (const auto& [kind, texts] : problems)
  {
    out << kind << " (" << texts.size() << ")\n";
    for (std::size_t i = 0; i < std::min(texts.size(), kExamples); ++i)
      out << "  " << oneLine(texts[i]) << "\n";
    if (texts.size() > kExamples) out << "  ...\n";
  }
}

}  // namespace quadmap
