// A grid and the objects of a room in one CMultiMetricMap.
//   grid-and-objects MAP.ini IN.rawlog OUT      writes OUT.gridmap and OUT.quadmap
#include <mrpt/config/CConfigFile.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/serialization/CArchive.h>

#include <iostream>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/sensors/RawlogSource.h"

using mrpt::poses::CPose3D;

namespace
{
constexpr double kLowest = 0.1, kHighest = 1.2;  // what a robot would run into [m]

mrpt::maps::CMultiMetricMap emptyMaps(const std::string& ini)
{
  mrpt::maps::TSetOfMetricMapInitializers definitions;
  definitions.loadFromConfigFile(mrpt::config::CConfigFile(ini), "map");
  mrpt::maps::CMultiMetricMap maps;
  maps.setListOfMaps(definitions);
  return maps;
}

/** The depth image as a level laser below it would see it, for the grid. */
mrpt::obs::CObservation2DRangeScan levelScan(
    mrpt::obs::CObservation3DRangeScan scan, const CPose3D& T_map_sensor)
{
  scan.sensorPose = CPose3D(0, 0, T_map_sensor.z(), 0, T_map_sensor.pitch(), T_map_sensor.roll());
  mrpt::obs::T3DPointsTo2DScanParams params;
  params.sensorLabel = "level";
  params.z_min = kLowest;
  params.z_max = kHighest;
  params.use_origin_sensor_pose = true;
  mrpt::obs::CObservation2DRangeScan level;
  scan.convertTo2DScan(level, params);
  return level;
}

void run(const std::string& ini, const std::string& rawlog, const std::string& out)
{
  quadmap::registerMapClasses();  // before the INI file names the class
  auto maps = emptyMaps(ini);
  quadmap::RawlogSource source(rawlog, {});
  while (const auto frame = source.next())
  {
    if (!frame->T_odom_robot || !frame->objects) continue;
    const CPose3D T_map_sensor = *frame->T_odom_robot + frame->scan->sensorPose;
    maps.insertObservation(
        levelScan(*frame->scan, T_map_sensor),
        CPose3D(T_map_sensor.x(), T_map_sensor.y(), 0, T_map_sensor.yaw(), 0, 0));
    maps.insertObservation(*frame->scan, *frame->T_odom_robot);
    maps.insertObservation(*frame->objects, *frame->T_odom_robot);
  }
  const auto grid = maps.mapByClass<mrpt::maps::COccupancyGridMap2D>();
  const auto objects = maps.mapByClass<quadmap::CQuadricObjectMap>();
  objects->consolidate();

  mrpt::io::CFileGZOutputStream file(out + ".gridmap");
  mrpt::serialization::archiveFrom(file) << *grid;
  objects->saveToFile(out + ".quadmap");
  std::cout << objects->asString() << "\n";
}
}  // namespace

int main(int argc, char** argv)
try
{
  if (argc != 4) throw std::runtime_error("usage: grid-and-objects MAP.ini IN.rawlog OUT");
  run(argv[1], argv[2], argv[3]);
  return 0;
}
catch (const std::exception& e)
{
  std::cerr << "grid-and-objects: " << e.what() << "\n";
  return 1;
}
