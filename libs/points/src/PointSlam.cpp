#include "quadmap/points/PointSlam.h"

#include <utility>

#include "PointSlamImpl.h"

namespace quadmap
{
template <int D>
PointSlam<D>::PointSlam(
    const PointOptions& options,
    bool posesGiven,
    PointVisibility<D> visible,
    double detectionProbability) :
    impl_(std::make_unique<PointSlamImpl<D>>(
        options, posesGiven, std::move(visible), detectionProbability))
{
}

template <int D>
PointSlam<D>::~PointSlam() = default;

template <int D>
void PointSlam<D>::addFrame(
    const PointOdometry<D>& step,
    const std::vector<PointMeasurement<D>>& measurements,
    const PointPose<D>& origin)
{
  impl_->addFrame(step, measurements, origin);
}

template <int D>
void PointSlam<D>::finish()
{
  impl_->finish();
}

template <int D>
PointResult<D> PointSlam<D>::result() const
{
  return impl_->result();
}

template <int D>
const PointPose<D>& PointSlam<D>::pose() const
{
  return impl_->pose();
}

template class PointSlam<2>;
template class PointSlam<3>;

}  // namespace quadmap
