#pragma once

namespace quadmap
{
/** What speaks for and against that an object goes on beyond an edge of its box. */
struct HiddenEvidence
{
  double nearer = 0;  //!< Share of the edge along which something nearer stands outside it
  /** The same times the share of the object's outermost cells that it touches: what hides the end
   * of an object does so where the object seems to end */
  double touching = 0;
  /** `touching` of the two edges that meet this one, the larger: an object whose lower end is
   * hidden may be wider down there. */
  double touchingBeside = 0;
  double opposite = 0;  //!< `nearer` of the opposite edge: then what is hidden is over there
  /** Share of the object's outermost cells beside which, along the edge, something nearer stands.
   */
  double endBeside = 0;
  /** Share of the object's outermost cells at the image border that the edge runs into: an edge of
   * the object that slants goes on out there. */
  double endAtBorder = 0;
  double nearerInside = 0;  //!< Share of the box near the edge that something nearer fills
  /** How far the cuboid, which stands on its support, reaches beyond the edge: in pixels of an
   * image 640 wide, and as a share of the box; 0 without a cuboid. */
  double cuboidBeyond_px = 0, cuboidBeyondShare = 0;
  double depth = 0;         //!< Of the object [m]: from afar, contacts are harder to see
  bool cutBeside = false;   //!< One of the two edges that meet this one is at the image border
  bool anyContact = false;  //!< Any edge of the box is at the border or has something nearer
  /** Standard deviations by which the visible part is smaller than such things usually are; 0 when
   * it is not or nobody knows. */
  double tooLow = 0, tooNarrow = 0;
  double topTooLow = 0;  //!< The same, of the height of the upper edge above the support
  /** Height of the lowest visible point above the support over that of the highest one, in [0, 1]:
   * things stand on something. */
  double floating = 0;
};

/** Which side of the object a box edge bounds; the image may lie on its side or upside down. */
enum class ObjectSide
{
  Top,
  Bottom,
  Lateral
};

/** Probability that the object goes on beyond an edge, hidden by something nearer or cut off by
 * the image (doc/mathematics.md, "Edges"). */
double hiddenProbability(ObjectSide side, const HiddenEvidence& evidence);

}  // namespace quadmap
