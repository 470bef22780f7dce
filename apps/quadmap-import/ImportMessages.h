#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "FolderImport.h"
#include "quadmap/folders/FrameFolder.h"

/** What quadmap-import says of what it found and wrote: one line each. */
namespace quadmap
{
/** Boxes of no image at all have the names of other images.
 *  \exception std::runtime_error If it is so, unless the import is to go on. */
void reportBoxesOfOtherImages(const FrameFolder& folder, bool keepGoing);

/** Half a pair is no frame. */
void reportUnpaired(const FrameFolder& folder);

/** Images without a file of boxes were not seen by the detector, or the files have other names.
 *  \exception std::runtime_error If no image has one, unless the import is to go on. */
void reportMissingDetections(const FolderImportReport& report, bool keepGoing);

/** Of an image with more boxes than one may have, the surest are kept. */
void reportCrowdedImages(const FolderImportReport& report);

/** Frames without a pose are mapped only where the poses around them are known.
 *  \param poses Where the poses are from. */
void reportMissingPoses(const std::string& poses, const FolderImportReport& report);

void tellDropped(const FolderImportReport& report);
void tellNotes(const std::vector<std::string>& notes);

/** \param rawlog Its path.
 *  \param posesAs What its poses are, as the command line says it.
 *  \param out Where to write it. */
void tellWritten(
    const FolderImportReport& report,
    const std::string& rawlog,
    const std::string& posesAs,
    std::ostream& out);

}  // namespace quadmap
