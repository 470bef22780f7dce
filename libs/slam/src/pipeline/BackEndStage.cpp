#include "BackEndStage.h"

namespace quadmap
{
using mrpt::poses::CPose3D;

void BackEndStage::add(std::size_t item, KeyframeTask& task, SlamResult& result)
{
  auto step = task.step;
  if (leftOutSteps_ && step) step = *leftOutSteps_ + *step;
  if (result.keyframes.empty()) step.reset();
  if (task.problem)
    leftOutSteps_ = step;
  else
  {
    const CPose3D T_map_robot =
        backEnd_->addKeyframe(task.T_odom_robot, step, task.boxes.get(), result);
    latest_ = T_map_robot + (-task.T_odom_robot);
    result.keyframes.push_back(
        {task.frame.record, task.frame.scan->sensorLabel, task.frame.time(), T_map_robot,
         task.T_odom_robot, step});
    for (const auto* object : result.map.confirmedObjects()) ++task.objectsByLabel[object->label()];
    leftOutSteps_.reset();
  }
  corrections_[item % kLag] = latest_;
}

}  // namespace quadmap
