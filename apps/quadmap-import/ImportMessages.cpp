#include "ImportMessages.h"

#include <iostream>
#include <stdexcept>

#include "quadmap/base/ErrorText.h"

namespace quadmap
{
void reportBoxesOfOtherImages(const FrameFolder& folder, bool keepGoing)
{
  if (!folder.boxesAreOfOtherImages()) return;
  const std::string text = folder.detections() + ": none of its boxes is of an image of " +
                           folder.folder() + ", as the names or numbers of the images differ";
  if (!keepGoing) throw std::runtime_error(text);
  std::cerr << "quadmap-import: warning: " << oneLine(text) << "\n";
}

void reportUnpaired(const FrameFolder& folder)
{
  if (folder.unpaired() > 0)
    std::cerr << "quadmap-import: warning: left out: " << folder.unpaired()
              << " images without a partner (colour or depth), the first is "
              << oneLine(folder.firstUnpaired()) << "\n";
}

void reportMissingDetections(const FolderImportReport& report, bool keepGoing)
{
  if (report.withoutDetections == 0) return;
  const std::string text = std::to_string(report.withoutDetections) + " of " +
                           std::to_string(report.frames) +
                           " images have no result of the detector; that of the first would be " +
                           report.firstWithoutDetections;
  if (report.withoutDetections == report.frames && !keepGoing) throw std::runtime_error(text);
  std::cerr << "quadmap-import: warning: " << oneLine(text) << "\n";
}

void reportCrowdedImages(const FolderImportReport& report)
{
  if (report.crowdedImages == 0) return;
  std::cerr << "quadmap-import: warning: " << report.crowdedImages << " of " << report.frames
            << " images have more than " << CObservationObjects::kMostObjects
            << " boxes, of which those with the highest scores are kept; the first is "
            << oneLine(report.firstCrowded) << "\n";
}

void reportMissingPoses(const std::string& poses, const FolderImportReport& report)
{
  if (report.poses < report.frames)
    std::cerr << "quadmap-import: warning: " << report.frames - report.poses << " of "
              << report.frames << " frames have no pose in " << oneLine(poses) << "\n";
}

void tellDropped(const FolderImportReport& report)
{
  for (const auto& what : report.dropped)
    std::cerr << "quadmap-import: dropped: " << oneLine(what) << "\n";
}

void tellNotes(const std::vector<std::string>& notes)
{
  for (const auto& note : notes) std::cerr << "quadmap-import: note: " << oneLine(note) << "\n";
}

void tellWritten(
    const FolderImportReport& report,
    const std::string& rawlog,
    const std::string& posesAs,
    std::ostream& out)
{
  out << rawlog << ": " << report.frames << " frames, " << report.poses << " poses as " << posesAs
      << ", " << report.boxes << " boxes";
  if (!report.dropped.empty()) out << " (" << report.dropped.size() << " things dropped)";
  out << "\n";
}

}  // namespace quadmap
