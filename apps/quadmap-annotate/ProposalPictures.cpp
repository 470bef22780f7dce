#include "ProposalPictures.h"

#include <filesystem>

#include "quadmap/base/OutputGroup.h"
#include "quadmap/review/SceneBuilder.h"
#include "quadmap/review/SceneRenderer.h"

namespace quadmap
{
namespace
{
/** The cuboid as black lines, with the points about it. */
SceneContent contentOf(const ObjectRecord& proposal, const DenseCloud& room, double cellSize)
{
  constexpr float kMargin = 0.15F;  // around the object [m]
  SceneContent content;
  content.truth = {proposal};
  content.cloudCellSize = cellSize;
  const Eigen::Vector3f center = proposal.object.center().cast<float>();
  const float radius = static_cast<float>(proposal.object.semiAxes().norm()) + kMargin;
  for (const DensePoint& point : room)
    if ((point.position - center).norm() < radius)
      content.cloud.push_back({point.position, point.normal, point.rgb});
  return content;
}

RenderCamera cameraOf(const ObjectRecord& proposal, double aspect)
{
  RenderCamera camera;
  camera.azimuth = proposal.object.pose().yaw() + 0.6;
  camera.elevation = 0.6;
  const auto corners = proposal.object.cuboidCorners();
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < corners.cols(); ++i) points.emplace_back(corners.col(i));
  return framed(camera, points, aspect, 0.15);
}

}  // namespace

void writeProposalPictures(
    const std::vector<ObjectRecord>& proposals,
    const DenseCloud& room,
    double cellSize,
    const std::string& folder,
    OutputGroup& group)
{
  OutputSet& files = group.addFolder(folder, "proposals");
  const PictureSize size{800, 600};
  SceneOptions look;
  look.cloudPaleness = 0;
  look.insideThinning = 1;
  look.pictureLineRadius = 0.004;
  const SceneBuilder builder(look);
  SceneRenderer renderer(size);
  for (const ObjectRecord& proposal : proposals)
  {
    const SceneContent content = contentOf(proposal, room, cellSize);
    const RenderCamera camera = cameraOf(proposal, size.aspect());
    writePicture(
        renderer.render(*builder.picture(content, camera, size), camera),
        files.add(fileNameOf(proposal, ".png")));
  }
  removeFormerFiles(files, ".png");
}

}  // namespace quadmap
