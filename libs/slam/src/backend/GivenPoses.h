#pragma once

#include "BackEnd.h"

namespace quadmap
{
/** Takes poses as given, ground truth for one, and maps the objects from them. */
class GivenPoses : public BackEnd
{
 public:
  mrpt::poses::CPose3D addKeyframe(
      const mrpt::poses::CPose3D& T_odom_robot,
      const std::optional<mrpt::poses::CPose3DPDFGaussian>& step,
      const CObservationObjects* boxes,
      SlamResult& result) override;
  void finish(const BoxesOf& boxesOf, SlamResult& result) override;
};

}  // namespace quadmap
