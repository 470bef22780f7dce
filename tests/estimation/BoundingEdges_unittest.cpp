#include <gtest/gtest.h>

#include <cmath>

#include "quadmap/estimation/ObjectView.h"
#include "quadmap/geometry/Projection.h"

// Which edges of a box bound the object (doc/mathematics.md, 11, "Edge").

using namespace quadmap;

namespace
{
const PinholeCamera kCamera{525, 525, 319.5, 239.5, 640, 480};

LabelProperties chair()
{
  LabelProperties p;
  p.name = "chair";
  p.typicalSize = {0.5, 0.5, 0.9};
  p.known = true;
  return p;
}

/** A box in the middle of the image, of something 2 m ahead. */
DetectedObject partial()
{
  DetectedObject d;
  d.measurement.kind = MeasurementKind::Partial;
  d.measurement.seed_sensor = Eigen::Vector3d(2, 0, 0);
  const auto planes = boxEdgePlanes(kCamera, {260, 160, 380, 320});
  d.measurement.edges.emplace();
  for (std::size_t e = 0; e < 4; ++e)
    (*d.measurement.edges)[e].plane_sensor = planes[e].transformed(T_sensor_optical());
  return d;
}

std::size_t edgesOf(const DetectedObject& d, const mrpt::poses::CPose3D& T_map_sensor)
{
  const auto view = viewOf(d, T_map_sensor, chair(), PoseNoise());
  return view ? view->edges.size() : 0;
}

constexpr std::size_t kLeft = 0, kTopEdge = 1, kBottom = 3;
constexpr std::size_t kBackFace = 0, kLeftFace = 2, kTopFace = 4;  // +x, +y, +z
}  // namespace

TEST(BoundingEdges, BesideAHiddenLowerEndTheyBoundOnlyWhatIsSeen)
{
  for (const double pitchDown : {0.0, 0.7})
  {
    const mrpt::poses::CPose3D level(0, 0, 1.5, 0.3, pitchDown, 0);
    DetectedObject d = partial();
    EXPECT_EQ(edgesOf(d, level), 4u);
    (*d.measurement.edges)[kBottom].state = EdgeState::NearImageBorder;
    EXPECT_EQ(edgesOf(d, level), 1u) << "the upper one";
    d = partial();
    (*d.measurement.edges)[kLeft].state = EdgeState::Occluded;
    EXPECT_EQ(edgesOf(d, level), 3u) << "what is hidden beside is no wider above or below";
  }
}

TEST(BoundingEdges, TheLowerEndOfACameraOnItsSideIsASideOfTheImage)
{
  DetectedObject d = partial();
  (*d.measurement.edges)[kLeft].state = EdgeState::Occluded;
  const mrpt::poses::CPose3D leftIsDown(0, 0, 1.5, 0, 0, -M_PI / 2);
  const mrpt::poses::CPose3D leftIsUp(0, 0, 1.5, 0, 0, M_PI / 2);
  EXPECT_EQ(edgesOf(d, leftIsDown), 1u);
  EXPECT_EQ(edgesOf(d, leftIsUp), 3u);
}

TEST(BoundingEdges, AFaceAtTheImagesBorderIsCut)
{
  const mrpt::poses::CPose3D level(0, 0, 1.5, 0, 0, 0);
  for (const auto kind : {FaceKind::Measured, FaceKind::AtLeast})
    for (const auto state : {EdgeState::Usable, EdgeState::NearImageBorder, EdgeState::Occluded})
      for (const double reach : {0.46, 0.2})  // [m] to the left; the left edge is 0.45 m away
      {
        DetectedObject d = partial();
        d.measurement.kind = MeasurementKind::Complete;
        CompleteMeasurement cuboid;
        cuboid.object_sensor = Ellipsoid(
            mrpt::poses::CPose3D(2, 0.5 * (reach - 0.2), 0, 0, 0, 0),
            {0.02, 0.5 * (reach + 0.2), 0.2});
        cuboid.faces.fill({FaceKind::Measured, 0.01});
        cuboid.faces[kLeftFace].kind = kind;
        cuboid.yawDefined = true;
        d.measurement.complete = cuboid;
        const auto planes = boxEdgePlanes(kCamera, {201.4, 160, 380, 320});
        (*d.measurement.edges)[kLeft].plane_sensor = planes[kLeft].transformed(T_sensor_optical());
        (*d.measurement.edges)[kLeft].state = state;
        const auto view = viewOf(d, level, chair(), PoseNoise());
        ASSERT_TRUE(view && view->complete);
        const bool reaches = reach > 0.4;
        EXPECT_EQ(
            view->isCutByImage[kLeftFace],
            reaches && kind == FaceKind::AtLeast && state == EdgeState::NearImageBorder);
        EXPECT_EQ(
            view->faces[kLeftFace].kind == FaceKind::AtLeast,
            kind == FaceKind::AtLeast || (reaches && state != EdgeState::Usable));
        for (std::size_t f = 0; f < kFaces; ++f)
          if (f != kLeftFace)
          {
            EXPECT_FALSE(view->isCutByImage[f]);
          }
      }
}

// A chair whose lower part a table hides is too low for its kind: its upper edge is then said to be
// hidden as well, though depth shows where its top and, from above, its back end.
TEST(BoundingEdges, EndsThatDepthShowsStayMeasuredUnderAHiddenUpperEdge)
{
  for (const auto state : {EdgeState::Usable, EdgeState::NearImageBorder, EdgeState::Occluded})
    for (const double pitchDown : {0.0, 0.5})
    {
      DetectedObject d = partial();
      d.measurement.kind = MeasurementKind::Complete;
      CompleteMeasurement cuboid;
      cuboid.object_sensor =
          Ellipsoid(mrpt::poses::CPose3D(2, 0, 0, 0, -pitchDown, 0), {0.2, 0.2, 0.3});
      cuboid.faces.fill({FaceKind::Measured, 0.01});
      cuboid.yawDefined = true;
      d.measurement.complete = cuboid;
      (*d.measurement.edges)[kTopEdge].state = state;
      const mrpt::poses::CPose3D T_map_sensor(0, 0, 1.5, 0, pitchDown, 0);
      const auto view = viewOf(d, T_map_sensor, chair(), PoseNoise());
      ASSERT_TRUE(view && view->complete);
      const bool isCut = state == EdgeState::NearImageBorder;
      EXPECT_EQ(view->faces[kTopFace].kind, isCut ? FaceKind::AtLeast : FaceKind::Measured);
      const bool looksOver = pitchDown > 0;
      EXPECT_EQ(
          view->faces[kBackFace].kind, isCut && looksOver ? FaceKind::AtLeast : FaceKind::Measured);
    }
}

TEST(BoundingEdges, WithAHiddenLowerEndTheMiddleMayBeMuchLowerThanWhatIsSeen)
{
  const mrpt::poses::CPose3D level(0, 0, 1.5, 0.3, 0.7, 0);
  DetectedObject d = partial();
  const Eigen::Matrix3d all = viewOf(d, level, chair(), PoseNoise())->centerCovariance;
  (*d.measurement.edges)[kBottom].state = EdgeState::Occluded;
  const Eigen::Matrix3d more = viewOf(d, level, chair(), PoseNoise())->centerCovariance - all;
  const double half = 0.5 * chair().typicalSize.z();
  EXPECT_NEAR(more(2, 2), half * half, 1e-9);
  EXPECT_NEAR(more.norm(), half * half, 1e-9) << "up and down alone";
}
