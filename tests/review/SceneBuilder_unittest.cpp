#include "quadmap/review/SceneBuilder.h"

#include <gtest/gtest.h>
#include <mrpt/opengl/CEllipsoid3D.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CSetOfTriangles.h>

#include "../obs/TemporaryFolder.h"
#include "SampleScene.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::opengl::COpenGLScene;

namespace
{
std::size_t childrenOf(COpenGLScene& scene, const std::string& group)
{
  const auto found = std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(scene.getByName(group));
  return found ? found->size() : 0;
}

std::size_t pointsOf(COpenGLScene& scene)
{
  const auto cloud =
      std::dynamic_pointer_cast<mrpt::opengl::CPointCloudColoured>(scene.getByName("cloud"));
  return cloud ? cloud->size() : 0;
}

/** A floor cell seen from above and a ceiling cell seen from below. */
Cloud floorAndCeiling()
{
  CloudPoint floor, ceiling;
  floor.position = Eigen::Vector3f(0, 0, 0);
  floor.normal = Eigen::Vector3f(0, 0, 1);
  ceiling.position = Eigen::Vector3f(0, 0, 1.5F);
  ceiling.normal = Eigen::Vector3f(0, 0, -1);
  return {floor, ceiling};
}
}  // namespace

TEST(SceneBuilder, ShowsAllParts)
{
  const SceneContent content = sampleContent();
  const auto scene = SceneBuilder().scene(content);
  EXPECT_EQ(childrenOf(*scene, "objects"), 2 * content.objects.size()) << "ellipsoid and cuboid";
  EXPECT_EQ(childrenOf(*scene, "labels"), content.objects.size());
  EXPECT_EQ(childrenOf(*scene, "truth"), content.truth.size());
  for (const char* part : {"floor", "trajectory", "odometry", "cameras", "cloud"})
    EXPECT_TRUE(scene->getByName(part)) << part;
}

TEST(SceneBuilder, DrawsEllipsoidsWhereTheObjectsAre)
{
  const SceneContent content = sampleContent();
  const auto scene = SceneBuilder().scene(content);
  for (const ObjectRecord& record : content.objects)
  {
    const auto body = std::dynamic_pointer_cast<mrpt::opengl::CEllipsoid3D>(
        scene->getByName(record.label + " " + record.id));
    ASSERT_TRUE(body) << record.label;
    EXPECT_LT(
        (body->getPose().translation() - mrpt::poses::CPose3D(record.object.pose()).translation())
            .norm(),
        1e-9);
    const auto covariance = body->getCovMatrix();
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(std::sqrt(covariance(i, i)), record.object.semiAxes()[i], 1e-9);
  }
}

TEST(SceneBuilder, LeavesOutOdometryThatWasNotCorrected)
{
  SceneContent content = sampleContent();
  content.odometry = content.trajectory;
  EXPECT_FALSE(SceneBuilder().scene(content)->getByName("odometry"));
  EXPECT_TRUE(SceneBuilder().scene(content)->getByName("trajectory"));
}

TEST(SceneBuilder, PicturesHideTheCeilingScenesDoNot)
{
  SceneContent content = sampleContent();
  content.cloud = floorAndCeiling();
  EXPECT_EQ(pointsOf(*SceneBuilder().scene(content)), 2u);
  EXPECT_EQ(pointsOf(*SceneBuilder().picture(content, obliqueCamera(content, 1.6))), 1u);
  EXPECT_EQ(pointsOf(*SceneBuilder().picture(content, cameraFromAbove(content, 1.6))), 1u);
}

TEST(SceneBuilder, LeavesOutWallsFromAbove)
{
  SceneContent content = sampleContent();
  content.cloud = floorAndCeiling();
  CloudPoint wall = content.cloud[0];
  wall.normal = Eigen::Vector3f(0.95F, 0, 0.3F);  // it leans to the eyes that saw it from above
  content.cloud = {wall};
  EXPECT_EQ(pointsOf(*SceneBuilder().picture(content, cameraFromAbove(content, 1.6))), 0u);
}

TEST(SceneBuilder, KeepsFarPointsOut)
{
  SceneContent content = sampleContent();
  content.cloud = floorAndCeiling();
  content.cloud[0].position = Eigen::Vector3f(50, 0, 0);
  EXPECT_EQ(pointsOf(*SceneBuilder().scene(content)), 1u);
}

TEST(SceneBuilder, MakesAnEmptySceneOfNothing)
{
  const auto scene = SceneBuilder().scene({});
  EXPECT_EQ(childrenOf(*scene, "objects"), 0u);
  EXPECT_TRUE(scene->getByName("floor"));
  EXPECT_GT(obliqueCamera({}, 1.6).distance, 0);
}

TEST(SceneBuilder, FloorIsUnderTheObjects)
{
  SceneContent content = sampleContent();
  EXPECT_NEAR(content.floorHeight(), 0.0, 1e-9);
  content.objects.push_back(recordOf("9", "cup", {0, 0, 2, 0, 0, 0}, {0.1, 0.1, 0.1}));
  EXPECT_NEAR(content.floorHeight(), 0.0, 1e-9) << "objects on tables do not lift it";
  EXPECT_EQ(SceneContent().floorHeight(), 0.0);
}

TEST(SceneBuilder, WrittenScenesCanBeReadBack)
{
  const TemporaryFolder folder;
  SceneContent content = sampleContent();
  content.cloud = floorAndCeiling();
  const std::string path = folder.path("scene.3Dscene");
  writeScene(*SceneBuilder().scene(content), path);
  EXPECT_EQ(folder.fileCount(), 1u) << "no temporary file is left";
  COpenGLScene read;
  ASSERT_TRUE(read.loadFromFile(path));
  EXPECT_EQ(childrenOf(read, "objects"), 2 * content.objects.size());
  EXPECT_EQ(childrenOf(read, "labels"), content.objects.size());
  EXPECT_EQ(pointsOf(read), 2u);
}

TEST(SceneBuilder, UnwritableSceneIsReported)
{
  const auto scene = SceneBuilder().scene(sampleContent());
  const std::string error = errorOf([&] { writeScene(*scene, "/nonexistent/scene.3Dscene"); });
  EXPECT_NE(error.find("/nonexistent/scene.3Dscene"), std::string::npos) << error;
}
