#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>

#include "quadmap/obs/LabelTable.h"
#include "quadmap/slam/SlamConfiguration.h"
#include "quadmap/slam/SlamResult.h"
#include "quadmap/slam/backend/BackEnd.h"
#include "quadmap/slam/pipeline/KeyframeTask.h"

namespace quadmap
{
/** Gives measured keyframes to the back end, and tells how it corrected the odometry. */
class BackEndStage
{
 public:
  /** Perception of a keyframe knows the corrections up to the one this many before it: so it goes
   * on while the back end works on the one before. */
  static constexpr std::size_t kLag = 2;

  /** \param labels Must outlive this object. */
  BackEndStage(const SlamConfiguration& configuration, const LabelTable& labels) :
      backEnd_(createBackEnd(configuration, labels))
  {
  }

  /** \param item Number of the task, from 0 on.
   *  \param result Its map, decisions and keyframes grow; the rest of it is not touched. */
  void add(std::size_t item, KeyframeTask& task, SlamResult& result);

  /** T_map_odom after the item kLag before this one; may be called while the one before is added.
   */
  const mrpt::poses::CPose3D& correctionFor(std::size_t item) const
  {
    return corrections_[item % kLag];
  }

  /** After the last one. */
  void finish(const BackEnd::BoxesOf& boxesOf, SlamResult& result)
  {
    backEnd_->finish(boxesOf, result);
  }

  BackEnd& backEnd() { return *backEnd_; }

 private:
  std::unique_ptr<BackEnd> backEnd_;
  std::array<mrpt::poses::CPose3D, kLag> corrections_;  //!< After the latest items, round and round
  mrpt::poses::CPose3D latest_;                         //!< Correction
  std::optional<mrpt::poses::CPose3DPDFGaussian> leftOutSteps_;  //!< Since the last good keyframe
};

}  // namespace quadmap
