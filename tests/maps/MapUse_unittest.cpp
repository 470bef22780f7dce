#include <gtest/gtest.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/opengl/CBox.h>
#include <mrpt/opengl/CEllipsoid3D.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CText3D.h>
#include <mrpt/tfest/TMatchingPair.h>

#include <cmath>
#include <filesystem>

#include "../obs/TemporaryFolder.h"
#include "ObjectMapFixture.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
/** Shows one thing fifty times. \return How many of the insertions moved it. */
int estimatesOfFifty(CQuadricObjectMap& map)
{
  const std::vector<TrueObject> world = {cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4)};
  SyntheticCamera camera(3);
  int estimates = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (int i = 0; i < 50; ++i)
  {
    walkAround(map, camera, world, 1);
    const Eigen::Vector3d now = map.objects().at(1).object.center();
    estimates += now != center ? 1 : 0;
    center = now;
  }
  return estimates;
}

}  // namespace

// Queries and editing --------------------------------------------------------------------------

TEST(MapQueries, FindObjects)
{
  const CQuadricObjectMap map = smallMap();
  ASSERT_EQ(map.confirmedObjects().size(), 2u);
  EXPECT_EQ(map.withLabel("tvmonitor").size(), 1u) << "any spelling";
  EXPECT_TRUE(map.withLabel("cat").empty());
  EXPECT_EQ(
      map.inRegion({
                       {-0.5, -0.5, 0},
                       { 0.5,  0.5, 1}
  })
          .size(),
      1u);
  EXPECT_EQ(
      map.inRegion({
                       {-5, -5, 0},
                       { 5,  5, 2}
  })
          .size(),
      2u);
  EXPECT_EQ(map.nearest({1, 1, 1})->label(), "tv");
  EXPECT_EQ(map.nearest({1, 1, 1}, "suitcase")->label(), "suitcase");
  EXPECT_FALSE(map.nearest({0, 0, 0}, "cat"));
  EXPECT_FALSE(map.find(99));
  EXPECT_FALSE(CQuadricObjectMap().nearest({0, 0, 0}));
  EXPECT_NE(map.asString().find("suitcase"), std::string::npos);
}

TEST(MapQueries, FootprintIsTheOutlineCounterClockwise)
{
  const CQuadricObjectMap map = smallMap();
  const auto* object = map.nearest({0, 0, 0.3}, "suitcase");
  const auto outline = map.footprint(object->id);
  ASSERT_EQ(outline.size(), 4u);
  double area = 0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const auto &p = outline[i], &q = outline[(i + 1) % 4];
    area += 0.5 * (p.x * q.y - p.y * q.x);
  }
  const Eigen::Vector3d s = object->object.semiAxes();
  EXPECT_NEAR(area, 4 * s.x() * s.y(), 1e-9) << "positive: counter-clockwise";
  EXPECT_THROW(map.footprint(99), std::out_of_range);
}

TEST(MapQueries, BoundingBoxHoldsTheCuboidsOfConfirmedObjects)
{
  const auto nothing = CQuadricObjectMap().boundingBox();
  EXPECT_EQ(nothing.min, mrpt::math::TPoint3Df());
  EXPECT_EQ(nothing.max, mrpt::math::TPoint3Df());

  CQuadricObjectMap map;
  MapObject object;
  object.object =
      Ellipsoid(mrpt::poses::CPose3D(1, 2, 0.5, M_PI / 4, 0, 0), Eigen::Vector3d(1, 1, 0.5));
  object.covariance *= 1e-6;
  object.labelCounts = {
      {"couch", 9}
  };
  object.completeCount = 9;
  object.existenceLogOdds = 9;
  map.addObject(object);
  object.existenceLogOdds = 0;  // not confirmed
  object.object = Ellipsoid(mrpt::poses::CPose3D(9, 9, 9, 0, 0, 0), Eigen::Vector3d(1, 1, 1));
  map.addObject(object);
  ASSERT_EQ(map.confirmedObjects().size(), 1u);
  const auto box = map.boundingBox();
  const float half = std::sqrt(2.0f);  // of the diagonal of the square
  EXPECT_LT((box.min - mrpt::math::TPoint3Df(1 - half, 2 - half, 0)).norm(), 1e-5f);
  EXPECT_LT((box.max - mrpt::math::TPoint3Df(1 + half, 2 + half, 1)).norm(), 1e-5f);
}

TEST(MapQueries, PointersShowTheLatestEstimate)
{
  CQuadricObjectMap map = smallMap();
  const MapObject* suitcase = map.nearest({0, 0, 0.3}, "suitcase");
  const unsigned before = suitcase->observations();
  SyntheticCamera camera(1);
  walkAround(map, camera, {cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4)}, 6);
  map.consolidate();
  EXPECT_EQ(map.find(suitcase->id), suitcase);
  EXPECT_EQ(suitcase->observations(), before + 6);
}

TEST(MapEditing, AddedObjectIsKeptAsItWasEstimated)
{
  const CQuadricObjectMap source = smallMap();
  CQuadricObjectMap map;
  ASSERT_EQ(source.objects().size(), 2u);
  for (const auto& [id, estimated] : source.objects()) map.addObject(estimated);
  ASSERT_EQ(map.confirmedObjects().size(), 2u) << map.asString();
  map.consolidate();  // estimates anew, from what was put in
  for (const auto& [id, object] : source.objects())
  {
    const MapObject* added = map.nearest(pointOf(object.object.center()));
    EXPECT_EQ(added->labelCounts, object.labelCounts);
    EXPECT_EQ(added->observations(), object.observations());
    EXPECT_EQ(added->orientationDefined, object.orientationDefined);
    const UprightState moved = uprightStateOf(added->object) - uprightStateOf(object.object);
    EXPECT_LT(moved.cwiseAbs().maxCoeff(), 1e-4) << "[m], [rad], [-]: the estimator's last step";
    const UprightCovariance ratio = added->covariance * object.covariance.inverse();
    EXPECT_LT((ratio - UprightCovariance::Identity()).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST(MapEditing, AddedObjectTakesMoreObservations)
{
  const std::vector<TrueObject> world = {cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4)};
  MapObject rough;
  rough.object =
      Ellipsoid(mrpt::poses::CPose3D(0.1, 0, 0.3, 0.4, 0, 0), Eigen::Vector3d(0.35, 0.2, 0.3));
  rough.covariance *= 0.01;
  rough.labelCounts = {
      {"suitcase", 8}
  };
  rough.partialCount = 8;
  CQuadricObjectMap map;
  const ObjectId id = map.addObject(rough);
  EXPECT_FALSE(map.find(id)->confirmed) << "nothing says that it exists";
  SyntheticCamera camera(43);
  walkAround(map, camera, world, 12);
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.find(id)->observations(), 20u);
  expectMapOf(map, world, 0.03);
}

TEST(MapEditing, RefusesObjectsThatDoNotFit)
{
  MapObject good;
  good.labelCounts = {
      {"chair", 3}
  };
  good.partialCount = 3;
  CQuadricObjectMap map;
  EXPECT_EQ(map.find(map.addObject(good))->label(), "chair");
  MapObject tilted = good, flat = good, unseen = good, nameless = good;
  tilted.object = Ellipsoid(mrpt::poses::CPose3D(0, 0, 0, 0, 0.1, 0), Eigen::Vector3d(1, 1, 1));
  flat.covariance(3, 3) = 0;
  unseen.partialCount = 0;
  nameless.labelCounts.clear();
  for (const MapObject& bad : {tilted, flat, unseen, nameless})
    EXPECT_THROW(map.addObject(bad), std::invalid_argument);
  EXPECT_EQ(map.objects().size(), 1u);
}

TEST(MapEditing, MergeRelabelRemove)
{
  CQuadricObjectMap map = smallMap();
  const ObjectId suitcase = map.nearest({0, 0, 0.3}, "suitcase")->id;
  const ObjectId tv = map.nearest({1, 1, 1}, "tv")->id;
  map.relabel(suitcase, "Cabinet");
  EXPECT_EQ(map.find(suitcase)->label(), map.labels().canonical("Cabinet"));
  const unsigned before = map.find(suitcase)->observations() + map.find(tv)->observations();
  map.merge(suitcase, tv);
  EXPECT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.find(suitcase)->observations(), before);
  map.remove(suitcase);
  EXPECT_TRUE(map.isEmpty());
  EXPECT_THROW(map.remove(suitcase), std::out_of_range);
  EXPECT_THROW(map.relabel(suitcase, "x"), std::out_of_range);
  EXPECT_THROW(map.merge(suitcase, tv), std::out_of_range);
}

TEST(MapEditing, RelabelJudgesTheObjectByItsNewLabel)
{
  CQuadricObjectMap map = smallMap();
  const ObjectId tv = map.nearest({1, 1, 1}, "tv")->id;
  ASSERT_TRUE(map.find(tv)->orientationDefined);
  ASSERT_TRUE(map.find(tv)->confirmed);
  map.relabel(tv, "vase");
  EXPECT_FALSE(map.find(tv)->orientationDefined) << "a round thing has no heading";
  map.relabel(tv, "tv");
  EXPECT_TRUE(map.find(tv)->orientationDefined);
  map.insertionOptions.existence.maxCenterSigma = 1e-9;
  map.relabel(tv, "tv");
  EXPECT_FALSE(map.find(tv)->confirmed);
}

TEST(MapEditing, TellsWhichObjectsHaveTheAbsorbedOnes)
{
  CQuadricObjectMap map = smallMap();
  MapObject third = *map.nearest({0, 0, 0.3}, "suitcase");
  const ObjectId a = third.id, b = map.nearest({1, 1, 1}, "tv")->id, c = map.addObject(third);
  map.merge(b, a);
  map.merge(c, b);
  EXPECT_EQ(
      map.heirs(), (std::map<ObjectId, ObjectId>{
                       {a, c},
                       {b, c}
  }));
  map.insertObservation(CObservationObjects(), mrpt::poses::CPose3D());
  EXPECT_TRUE(map.heirs().empty());
}

TEST(MapEditing, AnObjectCannotSwallowItself)
{
  CQuadricObjectMap map = smallMap();
  const ObjectId id = map.objects().begin()->first;
  EXPECT_THROW(map.merge(id, id), std::out_of_range);
  EXPECT_EQ(map.objects().size(), 2u);
}

// Matching -------------------------------------------------------------------------------------

TEST(MapMatching, PairsAMovedMap)
{
  const CQuadricObjectMap here = smallMap();
  CQuadricObjectMap there;
  SyntheticCamera camera(42);
  const mrpt::poses::CPose3D T_here_there(1.0, -0.5, 0, 0.6, 0, 0);
  std::vector<TrueObject> moved = {
      cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4),
      cuboid("tv", {0.9, 0.8, 0.9}, {0.8, 0.1, 0.5}, 0.2)};
  for (auto& o : moved) o.object = o.object.transformed(-T_here_there);
  walkAround(there, camera, moved, 24);

  mrpt::tfest::TMatchingPairList pairs;
  mrpt::maps::TMatchingParams params;
  mrpt::maps::TMatchingExtraResults extra;
  params.maxDistForCorrespondence = 0.2f;
  here.determineMatching3D(&there, T_here_there, pairs, params, extra);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_FLOAT_EQ(extra.correspondencesRatio, 1.0f);
  for (const auto& pair : pairs)
    EXPECT_EQ(here.find(pair.globalIdx)->label(), there.find(pair.localIdx)->label());

  mrpt::maps::TMatchingRatioParams ratio;
  EXPECT_FLOAT_EQ(here.compute3DMatchingRatio(&there, T_here_there, ratio), 1.0f);
  EXPECT_FLOAT_EQ(here.compute3DMatchingRatio(&there, {}, ratio), 0.0f);
  const mrpt::maps::CMultiMetricMap other;
  EXPECT_FLOAT_EQ(here.compute3DMatchingRatio(&other, {}, ratio), 0.0f);
  EXPECT_THROW(here.determineMatching3D(&other, {}, pairs, params, extra), std::invalid_argument);
}

// Drawing and files ----------------------------------------------------------------------------

TEST(MapDrawing, DrawsCuboidEllipsoidAndName)
{
  CQuadricObjectMap map = smallMap();
  mrpt::opengl::CSetOfObjects scene;
  map.getVisualizationInto(scene);
  unsigned boxes = 0, ellipsoids = 0, texts = 0;
  for (const auto& o : scene)
  {
    if (const auto box = std::dynamic_pointer_cast<mrpt::opengl::CBox>(o))
    {
      mrpt::math::TPoint3D lower, upper;
      box->getBoxCorners(lower, upper);
      const auto* object = map.nearest({box->getPoseX(), box->getPoseY(), box->getPoseZ()});
      EXPECT_NEAR(upper.x - lower.x, 2 * object->object.semiAxes().x(), 1e-6);
      ++boxes;
    }
    if (const auto e = std::dynamic_pointer_cast<mrpt::opengl::CEllipsoid3D>(o))
    {
      EXPECT_EQ(e->getCovMatrix()(0, 1), 0) << "off-diagonal terms are drawn wrongly";
      ++ellipsoids;
    }
    if (std::dynamic_pointer_cast<mrpt::opengl::CText3D>(o)) ++texts;
  }
  EXPECT_EQ(boxes, 2u);
  EXPECT_EQ(ellipsoids, 2u);
  EXPECT_EQ(texts, 2u);

  map.renderOptions.labels = map.renderOptions.ellipsoids = false;
  mrpt::opengl::CSetOfObjects plain;
  map.getVisualizationInto(plain);
  EXPECT_EQ(std::distance(plain.begin(), plain.end()), 2);
  map.renderOptions.cuboids = false;
  map.genericMapParams.enableSaveAs3DObject = false;
  mrpt::opengl::CSetOfObjects nothing;
  map.getVisualizationInto(nothing);
  EXPECT_EQ(nothing.begin(), nothing.end());
}

TEST(MapDrawing, UnconfirmedObjectsOnRequest)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(1);
  map.insertObservation(camera.observe({}, {cuboid("suitcase", {2, 0, 0}, {0.4, 0.4, 0.4}, 0)}));
  ASSERT_TRUE(map.confirmedObjects().empty());
  mrpt::opengl::CSetOfObjects hidden, shown;
  map.getVisualizationInto(hidden);
  map.renderOptions.unconfirmed = true;
  map.getVisualizationInto(shown);
  EXPECT_EQ(hidden.begin(), hidden.end());
  EXPECT_NE(shown.begin(), shown.end());
}

TEST(MapFiles, RepresentationReadsBack)
{
  const CQuadricObjectMap map = smallMap();
  const TemporaryFolder folder;
  const std::string prefix = folder.path("map");
  map.saveMetricMapRepresentationToFile(prefix);
  const auto records = readObjectsJson(prefix + ".json");
  ASSERT_EQ(records.size(), 2u);
  for (const auto& r : records)
  {
    const auto* object = map.find(static_cast<ObjectId>(std::stoul(r.id)));
    ASSERT_TRUE(object);
    EXPECT_EQ(r.label, object->label());
    EXPECT_LT((r.object.center() - object->object.center()).norm(), 1e-6);
    EXPECT_EQ(r.observations, object->observations());
  }
  mrpt::opengl::COpenGLScene scene;
  EXPECT_TRUE(scene.loadFromFile(prefix + ".3Dscene"));
  EXPECT_GT(std::filesystem::file_size(prefix + ".txt"), 20u);
  EXPECT_ANY_THROW(map.saveMetricMapRepresentationToFile("/nowhere/map"));
}

TEST(MapUse, ManyMeasurementsAreNotLookedAtForEachNewOne)
{
  CQuadricObjectMap eager, lazy;
  eager.insertionOptions.estimateGrowth = 0;
  lazy.insertionOptions.estimateGrowth = 0.25;
  EXPECT_EQ(estimatesOfFifty(eager), 50);
  EXPECT_EQ(estimatesOfFifty(lazy), 14) << "1, 2, 3, 4, 5, 7, 9, 12, 15, 19, 24, 30, 38, 48";
  eager.consolidate();
  lazy.consolidate();
  const MapObject &a = eager.objects().at(1), &b = lazy.objects().at(1);
  EXPECT_EQ(a.observations(), b.observations());
  EXPECT_LT((a.object.center() - b.object.center()).norm(), 1e-3);
}
