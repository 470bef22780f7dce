#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <Eigen/Dense>
#include <cstddef>
#include <optional>
#include <vector>

#include "quadmap/perception/FramePerception.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** What tells where up is. */
enum class UpOrigin
{
  Images,    //!< Nothing: the images are held upright
  Surfaces,  //!< Horizontal and vertical surfaces that images show
  Floor      //!< The floor that images show
};

/** Where up is in the robot's frame of an image. */
struct SeenUp
{
  Eigen::Vector3d up_robot;  //!< Unit
  UpOrigin origin = UpOrigin::Floor;
};

/** Which floors are believed: a ceiling looks like the floor of an image that is upside down. */
enum class BelievedFloors
{
  Below,        //!< Those whose normals are near the guess
  BelowOrAbove  //!< Also those whose normals are near its opposite
};

/** Finds the up direction of single images (doc/mathematics.md, 15, "Up"). */
class UpFinder
{
 public:
  explicit UpFinder(const PerceptionOptions& options);

  /** By the floor, or else by horizontal and vertical surfaces.
   * \param guess Robot's frame, unit. A wall that fills the image may be mistaken for the floor, so
   * directions far from it are not believed.
   * \return Nothing when neither tells it.
   * \exception std::runtime_error When the scan has no depth image, or not that of its camera. */
  std::optional<SeenUp> find(
      const mrpt::obs::CObservation3DRangeScan& scan,
      const Eigen::Vector3d& guess,
      BelievedFloors floors = BelievedFloors::Below) const;

 private:
  PerceptionOptions options_;
  FramePerception perception_;
};

/** The direction that most of some directions agree on. */
struct AgreedDirection
{
  Eigen::Vector3d direction;  //!< Unit
  std::size_t votes = 0;      //!< Number of those that agree

  /** There are enough of them, and they are half of so many. */
  bool isMajorityOf(std::size_t all) const { return votes >= 3 && 2 * votes >= all; }
};

/** Mean of the largest set of directions that agree with one of them: doc/mathematics.md, section
 * 15. It is nothing when there are no directions. */
std::optional<AgreedDirection> agreedDirection(const std::vector<Eigen::Vector3d>& directions);

}  // namespace quadmap
