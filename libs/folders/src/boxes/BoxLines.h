#pragma once

#include <memory>
#include <string>

#include "boxes/BoxReader.h"

namespace quadmap
{
/** Files of boxes, NAME.txt of the image NAME, with lines of `class_id class_name score x1 y1 x2
 * y2` [px]. Names may have blanks.
 * \param labels File with names of classes, which is not needed: a note says so. May be empty. */
std::unique_ptr<const BoxReader> openNamedBoxes(
    const std::string& folder, const std::string& labels);

/** Files of boxes as YOLO's save_txt writes them, NAME.txt of the image NAME, with lines of
 * `class_id centre_x centre_y width height`, in shares of the image, and perhaps the score.
 * \param labels File with the names of the classes. When it is empty, classes.txt, obj.names or
 * names.txt in the folder or above it, else the names of COCO.
 * \exception std::runtime_error If the names cannot be read. */
std::unique_ptr<const BoxReader> openYoloBoxes(
    const std::string& folder, const std::string& labels);

/** Whether the first line in any of the folder's files is one of YOLO's. */
bool hasYoloBoxes(const std::string& folder);

/** Boxes of a JSON file in the form of COCO: either whole, with `images`, `annotations` (which may
 * have a `score`) and `categories`; or a list of results, whose `image_id` is the image's name
 * or the number at its end.
 * \param labels Names of the classes of results, counted from 0. When it is empty, the ids are
 * those of COCO itself, from 1 to 90. \exception std::runtime_error If it cannot be read, or is not
 * in this form. */
std::unique_ptr<const BoxReader> openCocoBoxes(const std::string& file, const std::string& labels);

/** The note of boxes whose classes are numbers that no file names. */
std::string noteOfUnnamedClasses(const std::string& place);

/** The note of boxes that have the names of their classes; empty when no other names are given. */
std::string noteOfNamedClasses(const std::string& place, const std::string& labels);

/** Of an image with more boxes than a record may have, the import keeps the surest, but not of as
 * many as would take gigabytes. \exception std::runtime_error Names the place. */
void requireFewBoxes(std::size_t boxes, const std::string& place);

}  // namespace quadmap
