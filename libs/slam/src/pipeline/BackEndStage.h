#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

#include "KeyframeTask.h"
#include "backend/BackEnd.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/slam/SlamConfiguration.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** Gives measured keyframes to the back end, and says how it corrected the odometry. */
class BackEndStage
{
 public:
  /** Perception of a keyframe knows the correction of the keyframe this many before it. It can
   * therefore go on while the back end works on the keyframe before. */
  static constexpr std::size_t kLag = 2;

  /** \param labels Must outlive this object. */
  BackEndStage(const SlamConfiguration& configuration, const LabelTable& labels) :
      backEnd_(createBackEnd(configuration, labels))
  {
  }

  /** \param item Number of the task, from 0 on.
   *  \param result Its map, decisions and keyframes grow. Nothing else of it changes. */
  void add(std::size_t item, KeyframeTask& task, SlamResult& result);

  /** T_map_odom after the item kLag before this one. It may be called while the item before is
   * added.
   */
  const mrpt::poses::CPose3D& correctionFor(std::size_t item) const
  {
    return corrections_[item % kLag];
  }

  /** Call it after the last keyframe. */
  void finish(
      const BackEnd::BoxesOf& boxesOf, const std::function<bool()>& shouldStop, SlamResult& result)
  {
    backEnd_->finish(boxesOf, result);
    backEnd_->closeLoops(boxesOf, shouldStop, result);
  }

  BackEnd& backEnd() { return *backEnd_; }

 private:
  std::unique_ptr<BackEnd> backEnd_;
  std::array<mrpt::poses::CPose3D, kLag> corrections_;  //!< After the latest items, in a ring
  mrpt::poses::CPose3D latest_;                         //!< Latest correction
  std::optional<mrpt::poses::CPose3DPDFGaussian>
      leftOutSteps_;  //!< Sum of steps since the last good keyframe
};

}  // namespace quadmap
