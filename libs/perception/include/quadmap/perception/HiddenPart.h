#pragma once

#include <array>
#include <vector>

namespace quadmap
{
/** What speaks for and against that an object goes on beyond an edge of its box. */
struct HiddenEvidence
{
  double nearer = 0;     //!< Share of the edge along which something nearer stands outside it
  double length_px = 1;  //!< Of the edge [px of an image 640 wide]
  double size_px = 1;    //!< Of the box, across the edge [px of an image 640 wide]
  /** Share of the object's outermost cells at the image border that the edge runs into: an edge of
   * the object that slants goes on out there. */
  double endAtBorder = 0;
  /** How far the cuboid, which stands on its support, reaches beyond the edge [px of an image 640
   * wide], and how well it fits the box [IoU]; 0 without a cuboid. */
  double cuboidBeyond_px = 0, cuboidFit = 0;
  /** From the end of the object's cloud outwards to the edge [px of an image 640 wide]: a cloud
   * that goes on outside takes the cuboid with it. */
  double cloudShort_px = 0;
  bool anyContact = false;  //!< Any edge of the box is at the border or has something nearer
  /** Share of the box with depth, when nothing is known that the object stands on: its lower end
   * may be out of sight. */
  double coverageUnsupported = 0;
  /** Standard deviations by which the visible part is lower than such things usually are; 0 when it
   * is not or nobody knows. */
  double tooLow = 0;
};

/** Which side of the object a box edge bounds; the image may lie on its side or upside down. */
enum class ObjectSide
{
  Top,
  Bottom,
  Lateral
};

/** One term of the sum of doc/mathematics.md, (9.2). */
struct HiddenTerm
{
  const char* name;  //!< A short form of that in the table after (9.2)
  double evidence;   //!< e_j
  double weight;     //!< w_j
};

/** The terms that count for a side, the constant first. */
std::vector<HiddenTerm> hiddenTerms(ObjectSide side, const HiddenEvidence& evidence);

/** Probability that the object goes on beyond an edge, hidden by something nearer or cut off by
 * the image, doc/mathematics.md, (9.2). */
double hiddenProbability(ObjectSide side, const HiddenEvidence& evidence);

/** What an edge of a box is judged by. */
struct EdgeEvidence
{
  ObjectSide side = ObjectSide::Lateral;
  HiddenEvidence hidden;
  bool isRefused = false;  //!< For another reason: near the border, or before a foot out of sight
};
using BoxEvidence = std::array<EdgeEvidence, 4>;  //!< In the order of BoxEdge

}  // namespace quadmap
