#include <algorithm>

#include "PointSlamImpl.h"

namespace quadmap
{
template <int D>
void PointSlamImpl<D>::addFrame(
    const PointOdometry<D>& step,
    const std::vector<PointMeasurement<D>>& measurements,
    const PointPose<D>& origin)
{
  if (frames_.empty())
    filter_.reset(origin, {}, 0.0 * Eigen::MatrixXd(PoseIncrementMatrix<D>::Identity()));
  else
  {
    PointOdometry<D> motion = step;
    if (posesGiven_) motion.covariance.setZero();
    filter_.predict(motion);
    steps_.push_back(step);
  }
  poses_.push_back(filter_.pose());
  frames_.push_back({measurements, {}});
  Frame& frame = frames_.back();

  if (options_.associationGiven)
    frame.decisions = decideAsGiven(frame);
  else
  {
    Innovations innovations(measurements.size());
    for (std::size_t k = 0; k < measurements.size(); ++k)
      for (std::size_t i = 0; i < inFilter_.size(); ++i)
        innovations[k].push_back(filter_.innovation(i, measurements[k]));
    frame.decisions = decide(frame, inFilter_, innovations);
  }
  joinOrStart(frame);
  if (!options_.associationGiven)
  {
    forgetFleeting();
    mergeOnline();
  }
}

template <int D>
void PointSlamImpl<D>::joinOrStart(Frame& frame)
{
  const std::size_t now = frames_.size() - 1;
  const auto count = [&](Landmark& landmark, const PointMeasurement<D>& z)
  {
    ++landmark.object.observations;
    ++landmark.object.labelCounts[z.label];
    landmark.lastFrame = now;
  };
  for (std::size_t k = 0; k < frame.decisions.size(); ++k)
  {
    const auto& object = frame.decisions[k].object;
    if (!object) continue;
    const auto at = std::find(inFilter_.begin(), inFilter_.end(), *object);
    filter_.update(static_cast<std::size_t>(at - inFilter_.begin()), frame.measurements[k]);
    count(landmarks_[*object], frame.measurements[k]);
  }
  for (std::size_t k = 0; k < frame.decisions.size(); ++k)
  {
    if (!frame.decisions[k].startedObject) continue;
    frame.decisions[k].object = landmarks_.size();
    if (frame.measurements[k].instance && options_.associationGiven)
      landmarkOf_[*frame.measurements[k].instance] = landmarks_.size();
    filter_.add(frame.measurements[k]);
    inFilter_.push_back(landmarks_.size());
    landmarks_.emplace_back();
    landmarks_.back().object.instance = frame.measurements[k].instance;
    count(landmarks_.back(), frame.measurements[k]);
  }
  poses_.back() = filter_.pose();
  for (std::size_t i = 0; i < inFilter_.size(); ++i)
    landmarks_[inFilter_[i]].object.position = filter_.position(i);
}

template <int D>
void PointSlamImpl<D>::forgetFleeting()
{
  const std::size_t now = frames_.size() - 1;
  for (std::size_t i = inFilter_.size(); i-- > 0;)
  {
    Landmark& landmark = landmarks_[inFilter_[i]];
    const unsigned n = landmark.object.observations;
    if (n >= unsigned(options_.matureObservations) ||
        now - landmark.lastFrame < n * std::size_t(options_.forgetAfter))
      continue;
    landmark.alive = false;
    filter_.remove(i);
    inFilter_.erase(inFilter_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

template <int D>
bool PointSlamImpl<D>::isTimeToMerge() const
{
  constexpr std::size_t kPause = 10;  // frames between two tests when no landmark became mature
  const auto& decisions = frames_.back().decisions;
  return frames_.size() - 1 - lastMergeTest_ >= kPause ||
         std::any_of(
             decisions.begin(), decisions.end(),
             [&](const PointDecision& d)
             {
               return d.object && landmarks_[*d.object].object.observations ==
                                      unsigned(options_.matureObservations);
             });
}

template <int D>
Doubles PointSlamImpl<D>::likelyDoublesInFilter() const
{
  Ids ids;
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < inFilter_.size(); ++i)
  {
    if (landmarks_[inFilter_[i]].object.observations < unsigned(options_.matureObservations))
      continue;
    ids.push_back(inFilter_[i]);
    for (int d = 0; d < D; ++d)
      rows.push_back(kPoseIncrement<D> + D * static_cast<Eigen::Index>(i) + d);
  }
  return likelyDoubles(ids, filter_.covariance()(rows, rows));
}

template <int D>
void PointSlamImpl<D>::mergeOnline()
{
  if (!isTimeToMerge()) return;
  lastMergeTest_ = frames_.size() - 1;
  if (!isWorthMerging(likelyDoublesInFilter(), options_.mergeLogOdds)) return;

  double cost = estimate(mature());
  while (mergeDoubles(options_.mergeLogOdds, cost))
  {
  }
  inFilter_.erase(
      std::remove_if(
          inFilter_.begin(), inFilter_.end(),
          [&](std::size_t id) { return !landmarks_[id].alive; }),
      inFilter_.end());
  restartFilter();
}

template <int D>
void PointSlamImpl<D>::restartFilter()
{
  estimate(inFilter_);  // also moves what was seen only once to where the corrected poses saw it
  const PointGraph<D> graph = graphOf(inFilter_);
  Eigen::MatrixXd P;
  graph.marginals(
      options_.huber,
      [&P](std::size_t, const auto& last, const Eigen::MatrixXd& objects)
      {
        const Eigen::Index p = kPoseIncrement<D>, n = objects.rows();
        P.resize(p + n, p + n);
        P << last.pose, last.poseObjects, last.poseObjects.transpose(), objects;
        return false;
      });
  filter_.reset(poses_.back(), graph.objects, P);
}

template class PointSlamImpl<2>;
template class PointSlamImpl<3>;

}  // namespace quadmap
