#pragma once

#include <cstddef>

// What the points of a frame can tell, the same for all that is taken from them.

namespace quadmap
{
/** Fewer cells of the depth image, or of a sample of them, tell nothing. */
constexpr std::size_t kFewestCells = 12;

/** What has a normal this near to a surface's is that surface's own [cosine]: at rims and in
 * noise normals are off by up to 32 degrees. */
constexpr double kOwnNormal = 0.85;

/** Fewer points do not tell where a surface or its rim is. */
constexpr std::size_t kFewestOfSurface = 20;

/** As many points give what may err by a few per cent as well as all do. */
constexpr int kSample = 400;

/** Sensors mix the depths of so many neighbouring cells: they err alike, and along edges depth is
 * bled, ragged or missing. */
constexpr int kMixedCells = 3;

/** Share of an object's points that are stray ones, at either end of any direction. */
constexpr double kStrayShare = 0.02;

/** Share of a surface's points that its rim, where depth bleeds, does not have. */
constexpr double kWithoutRim = 0.95;

/** An end of an object is open when more than this share of what makes it up is cut by the image,
 * hidden, or belongs to another thing. */
constexpr double kOpenShare = 0.3;

/** What is off by more standard deviations is not so by chance: of normal errors one in 370 is. */
constexpr double kBeyondChance = 3.0;

/** Ends of things, of their parts and of surfaces are known to this [m]. */
constexpr double kEndSlack = 0.05;

/** What a straight end, of a face or a rim, spreads over along its normal [m]. */
constexpr double kEndWidth = 0.03;

/** What leans by less than these 5 degrees is taken to be upright [rad]: up is known to a degree or
 * two, and noise must neither move sides outwards nor turn headings. */
constexpr double kUpright = 0.087;

/** By this share of their size boxes of a detector are wrong without anything being amiss. */
constexpr double kBoxErrorShare = 0.05;

/** From one point of a sample to the next. \param count Of all points. */
inline std::size_t sampleStep(std::size_t count) { return 1 + count / kSample; }

}  // namespace quadmap
