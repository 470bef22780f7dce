#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>

#include "ObjectMapFixture.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
/** One cabinet, seen from all around. */
CQuadricObjectMap mapOfACabinet(SyntheticCamera& camera)
{
  CQuadricObjectMap map;
  walkAround(map, camera, {cuboid("suitcase", {0, 0, 0.28}, {0.78, 0.43, 0.56}, 0.3)}, 40);
  map.consolidate();
  return map;
}

UprightCovariance errorOf(double meters, double radians)
{
  UprightCovariance error = UprightCovariance::Zero();
  error.diagonal().head<3>().setConstant(meters * meters);
  error(3, 3) = radians * radians;
  return error;
}

CQuadricObjectMap storedAndRead(const CQuadricObjectMap& map)
{
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << map;
  stream.Seek(0);
  CQuadricObjectMap read;
  archive >> read;
  return read;
}

const MapObject& onlyObject(const CQuadricObjectMap& map) { return map.objects().begin()->second; }

}  // namespace

TEST(SharedError, IsThereHoweverManyMeasurementsCome)
{
  SyntheticCamera camera(1);
  CQuadricObjectMap map = mapOfACabinet(camera);
  const ObjectId id = onlyObject(map).id;
  const UprightCovariance before = onlyObject(map).covariance, error = errorOf(0.05, 0.02);
  map.setSharedError(id, error);
  EXPECT_LT((onlyObject(map).covariance - before - error).norm(), 1e-12);
  map.setSharedError(id, error);
  EXPECT_LT((onlyObject(map).covariance - before - error).norm(), 1e-12) << "it is set, not added";

  walkAround(map, camera, {cuboid("suitcase", {0, 0, 0.28}, {0.78, 0.43, 0.56}, 0.3)}, 40);
  map.consolidate();
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_GE(onlyObject(map).covariance(0, 0), error(0, 0));
  EXPECT_LT(onlyObject(map).covariance(0, 0), before(0, 0) + error(0, 0));
  EXPECT_THROW(map.setSharedError(99, error), std::out_of_range);
}

TEST(Contradictions, AreClaimedOnceAndOnlyUntilTheNextEstimate)
{
  SyntheticCamera camera(4);
  CQuadricObjectMap map;
  map.insertionOptions.poseNoise = {0.003, 0.002};  // what is wider is so by many sigmas
  const TrueObject cabinet = cuboid("suitcase", {0, 0, 0.28}, {0.78, 0.43, 0.56}, 0.3);
  walkAround(map, camera, {cabinet}, 40);
  // Seen wider now and then, but what was seen may not be all of it.
  TrueObject wider = cabinet;
  wider.object = Ellipsoid(cabinet.object.pose(), {0.52, 0.215, 0.28});
  for (int i = 0; i < 8; ++i)
  {
    const auto T_map_sensor = poseAround(i, 8, {0, 0, 0.5}, 2.5, 1.5);
    auto boxes = camera.observe(T_map_sensor, {wider});
    for (auto& box : boxes.objects)
      for (auto& face : box.measurement.complete.value().faces)
        if (face.kind == FaceKind::Measured) face.kind = FaceKind::AtLeast;
    map.insertObservation(boxes, T_map_sensor);
  }
  map.conclude();
  map.consolidate();  // leaves them out again
  const MapObject before = onlyObject(map);
  ASSERT_TRUE(before.confirmed);
  map.conclude();
  const UprightCovariance more = onlyObject(map).covariance - before.covariance;
  EXPECT_GT(more.trace(), 0);
  EXPECT_GE(more.diagonal().minCoeff(), 0);
  EXPECT_EQ((onlyObject(map).object.center() - before.object.center()).norm(), 0);
  EXPECT_TRUE(onlyObject(map).confirmed);
  map.conclude();
  EXPECT_LT((onlyObject(map).covariance - before.covariance - more).norm(), 1e-15);

  // They take no part in what is confirmed, whoever asks.
  const auto sigmaOf = [](const UprightCovariance& P)
  { return std::sqrt(P.diagonal().head<3>().maxCoeff()); };
  const UprightCovariance claimed = onlyObject(map).covariance;
  ASSERT_GT(sigmaOf(claimed), 1.1 * sigmaOf(before.covariance));
  map.insertionOptions.existence.maxCenterSigma =
      0.5 * (sigmaOf(claimed) + sigmaOf(before.covariance));
  map.setSharedError(before.id, UprightCovariance::Zero());
  EXPECT_TRUE(onlyObject(map).confirmed);

  // A stored map knows no more than it claims.
  CQuadricObjectMap stored = storedAndRead(map);
  stored.consolidate();
  EXPECT_LT((onlyObject(stored).covariance - claimed).norm(), 0.02 * claimed.norm());

  map.consolidate();
  EXPECT_LT((onlyObject(map).covariance - before.covariance).norm(), 1e-6);
}

TEST(Conclusion, LetsGoOfBadMeasurementsUntilTheNextOne)
{
  SyntheticCamera camera(4);
  CQuadricObjectMap map;
  const TrueObject cabinet = cuboid("suitcase", {0, 0, 0.28}, {0.78, 0.43, 0.56}, 0.3);
  TrueObject low = cabinet;  // as when it is taken to stand on something below
  low.object =
      Ellipsoid(mrpt::poses::CPose3D(0, 0, 0.23, 0.3, 0, 0), Eigen::Vector3d(0.39, 0.215, 0.33));
  for (int i = 0; i < 40; ++i)
  {
    const auto T_map_sensor = poseAround(i, 40, {0, 0, 0.5}, 2.5, 1.5);
    map.insertObservation(camera.observe(T_map_sensor, {i % 5 == 0 ? low : cabinet}), T_map_sensor);
  }
  map.consolidate();
  const MapObject before = onlyObject(map);
  ASSERT_TRUE(before.confirmed);
  map.conclude();
  const auto errorOfHeight = [](const MapObject& object)
  { return std::abs(2 * object.object.semiAxes().z() - 0.56); };
  EXPECT_LT(errorOfHeight(onlyObject(map)), 0.8 * errorOfHeight(before));
  EXPECT_TRUE(onlyObject(map).confirmed);

  const auto T_map_sensor = poseAround(0, 40, {0, 0, 0.5}, 2.5, 1.5);
  map.insertObservation(camera.observe(T_map_sensor, {cabinet}), T_map_sensor);
  EXPECT_NEAR(errorOfHeight(onlyObject(map)), errorOfHeight(before), 0.003) << "all is open again";
}

TEST(SharedError, AMapWithANegativeVarianceIsNotRead)
{
  SyntheticCamera camera(3);
  CQuadricObjectMap map = mapOfACabinet(camera);
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << map;
  const double variance = onlyObject(map).covariance(0, 0), negative = -variance;
  std::string bytes(
      static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount());
  const auto at =
      bytes.find(std::string(reinterpret_cast<const char*>(&variance), sizeof variance));
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, sizeof negative, reinterpret_cast<const char*>(&negative), sizeof negative);
  mrpt::io::CMemoryStream changed(bytes.data(), bytes.size());
  auto in = mrpt::serialization::archiveFrom(changed);
  CQuadricObjectMap loaded;
  EXPECT_THROW(in >> loaded, std::exception);
  EXPECT_TRUE(loaded.objects().empty());
}

TEST(SharedError, IsACovariance)
{
  SyntheticCamera camera(4);
  CQuadricObjectMap map = mapOfACabinet(camera);
  const ObjectId id = onlyObject(map).id;
  const UprightCovariance before = onlyObject(map).covariance;
  UprightCovariance lopsided = errorOf(0.1, 0.1), mixed = errorOf(0.1, 0.1), wild = errorOf(1, 1);
  lopsided(0, 1) = 0.001;
  mixed(0, 1) = mixed(1, 0) = 0.02;  // more than both variances allow
  wild(2, 2) = std::nan("");
  for (const auto& wrong : {UprightCovariance(-errorOf(1, 0)), lopsided, mixed, wild})
    EXPECT_THROW(map.setSharedError(id, wrong), std::invalid_argument) << wrong;
  EXPECT_EQ(onlyObject(map).covariance, before);
}

TEST(SharedError, SaysAnewWhetherTheObjectIsConfirmed)
{
  SyntheticCamera camera(5);
  CQuadricObjectMap map = mapOfACabinet(camera);
  const MapObject& object = onlyObject(map);
  ASSERT_TRUE(object.confirmed);
  map.setSharedError(object.id, errorOf(2 * map.insertionOptions.existence.maxCenterSigma, 0));
  EXPECT_FALSE(object.confirmed);
  map.setSharedError(object.id, errorOf(0, 0));
  EXPECT_TRUE(object.confirmed);
}

TEST(SharedError, StaysWithAStoredMap)
{
  SyntheticCamera camera(2);
  CQuadricObjectMap map = mapOfACabinet(camera);
  map.setSharedError(onlyObject(map).id, errorOf(0.05, 0.02));
  CQuadricObjectMap loaded = storedAndRead(map);
  loaded.consolidate();
  const auto &stored = onlyObject(map), &read = onlyObject(loaded);
  EXPECT_LT((uprightStateOf(read.object) - uprightStateOf(stored.object)).norm(), 1e-3);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(std::sqrt(read.covariance(i, i) / stored.covariance(i, i)), 1, 0.05) << i;
}
