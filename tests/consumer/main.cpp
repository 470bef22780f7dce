// The object map in a program of your own: insert what a camera saw, ask, save, load.
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <iostream>
#include <stdexcept>

#include "quadmap/geometry/Projection.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/relations/Questions.h"

using mrpt::poses::CPose3D;

namespace
{
void require(bool condition, const char* what)
{
  if (!condition) throw std::runtime_error(what);
}

/** A chair 2 m ahead of a camera that looks along the robot's x axis. In a real program the boxes
 * come from a detector and the measurements from quadmap::FramePerception. */
quadmap::CObservationObjects chairSeenFrom(const CPose3D& T_map_robot)
{
  const quadmap::Ellipsoid chair_map(CPose3D(2.0, 0.3, 0.45, 0, 0, 0), {0.25, 0.25, 0.45});

  quadmap::CObservationObjects observation;
  observation.timestamp = mrpt::Clock::now();
  observation.sensorLabel = "camera";
  observation.cameraParams.setIntrinsicParamsFromValues(525, 525, 319.5, 239.5);
  observation.cameraParams.ncols = 640;
  observation.cameraParams.nrows = 480;
  observation.sensorPose = CPose3D(0, 0, 0.8, 0, 0, 0);  // T_robot_sensor

  const CPose3D T_map_sensor = T_map_robot + observation.sensorPose;
  const auto chair_sensor = chair_map.transformed(CPose3D() - T_map_sensor);
  const auto chair_optical = chair_sensor.transformed(CPose3D() - quadmap::T_sensor_optical());

  quadmap::DetectedObject seen;
  seen.label = "chair";
  const auto camera = quadmap::pinholeFrom(observation.cameraParams);
  seen.box = quadmap::projectCuboidBox(camera, chair_optical).value();
  seen.measurement.kind = quadmap::MeasurementKind::Complete;
  seen.measurement.seed_sensor = chair_sensor.center();
  quadmap::CompleteMeasurement complete;
  complete.object_sensor = chair_sensor;
  complete.faces.fill({quadmap::FaceKind::Measured, 0.02 /* m */});
  complete.yawDefined = true;
  complete.yawSigma = 0.05;  // rad
  complete.yawDominance = 0.9;
  seen.measurement.complete = complete;
  seen.measurement.edges.emplace();
  const auto planes = quadmap::boxEdgePlanes(camera, seen.box);
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    auto& edge = (*seen.measurement.edges)[i];
    edge.plane_sensor = planes[i].transformed(quadmap::T_sensor_optical());
    edge.sigmaAngle = 3.0 / camera.fx;
  }
  observation.objects.push_back(seen);
  return observation;
}

void run(const std::string& file)
{
  quadmap::CQuadricObjectMap map;
  for (int i = 0; i < 10; ++i)
  {
    const CPose3D T_map_robot(-0.1 * i, 0, 0, 0, 0, 0);
    mrpt::poses::CPose3DPDFGaussian uncertain(T_map_robot);
    for (int axis = 0; axis < 3; ++axis)
    {
      uncertain.cov(axis, axis) = 1e-4;          // x, y, z [m^2]
      uncertain.cov(3 + axis, 3 + axis) = 1e-4;  // yaw, pitch, roll [rad^2]
    }
    map.insertObservation(chairSeenFrom(T_map_robot), uncertain);
  }
  map.consolidate();
  require(map.confirmedObjects().size() == 1, "ten views of one chair are one object");

  const quadmap::MapObject* chair = map.nearest({0, 0, 0}, "chair");
  require(chair != nullptr, "there is a chair");
  const Eigen::Vector3d error = chair->object.center() - Eigen::Vector3d(2.0, 0.3, 0.45);
  require(error.norm() < 0.02, "the chair is where it was seen, to the 0.02 m of its faces");
  std::cout << "the chair stands at " << chair->object.center().transpose() << " m\n";

  quadmap::AnswerLimits limits;
  limits.place = Eigen::Vector3d(0, 0, 0);  // of the robot
  const quadmap::Answer answer = quadmap::ask(map, "nearest chair", limits);
  require(answer.found.size() == 1, "the chair is the nearest one");
  std::cout << quadmap::textOf(answer.found.front()) << "\n";

  map.saveToFile(file);
  quadmap::CQuadricObjectMap loaded;
  loaded.loadFromFile(file);
  require(loaded.withLabel("chair").size() == 1, "the chair is in the file");
}
}  // namespace

int main(int argc, char** argv)
try
{
  run(argc > 1 ? argv[1] : "consumer.quadmap");
  return 0;
}
catch (const std::exception& e)
{
  std::cerr << "consumer: " << e.what() << "\n";
  return 1;
}
