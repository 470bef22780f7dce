#include "cuboid/UnseenBack.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace quadmap
{
namespace
{
/** How thick a panel usually is, as a screen or a picture [m]. Nothing for what is no panel. */
std::optional<double> thicknessOfPanel(const LabelProperties& label)
{
  constexpr double kThin = 0.25;  // of the shorter side of its front
  const Eigen::Vector3d& size = label.typicalSize;
  const auto [thickness, width] = std::minmax({size.x(), size.y()});
  if (thickness > kThin * std::min(width, size.z())) return {};
  return thickness;
}

}  // namespace

void openUnseenBacks(const FaceEstimator& estimator, const LabelProperties& label, Faces& faces)
{
  const auto thickness = thicknessOfPanel(label);
  for (std::size_t side = 0; side < kTop; ++side)
  {
    FaceEstimate& face = faces[side];
    if (face.worth.kind != FaceKind::AtLeast || face.source != FaceSource::FarEdge || face.isCut)
      continue;
    const auto reach = estimator.reachOfFront(side);
    if (!reach) continue;
    face.position = reach->position;
    if (!reach->lean || !thickness) continue;
    face.position += *thickness * std::cos(*reach->lean);
    face.worth.sigma = std::hypot(face.worth.sigma, label.sizeSpread * *thickness);
  }
}

}  // namespace quadmap
