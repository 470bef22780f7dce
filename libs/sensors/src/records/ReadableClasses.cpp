#include "records/ReadableClasses.h"

#include <unordered_set>

namespace quadmap
{
bool isReadByMrpt(const std::string& className)
{
  static const std::unordered_set<std::string> classes = {
      // Observations. CObservation3DScene is none of them: it holds meshes.
      "CObservation6DFeatures",
      "CObservationBatteryState",
      "CObservationBeaconRanges",
      "CObservationBearingRange",
      "CObservationCANBusJ1939",
      "CObservationComment",
      "CObservationGPS",
      "CObservationGasSensors",
      "CObservationObjects",
      "CObservationPointCloud",
      "CObservationRFID",
      "CObservationRGBD360",
      "CObservationRange",
      "CObservationRawDAQ",
      "CObservationReflectivity",
      "CObservationRotatingScan",
      "CObservationSkeleton",
      "CObservationStereoImages",
      "CObservationStereoImagesFeatures",
      "CObservationVelodyneScan",
      "CObservationWindSensor",
      "CObservationWirelessPower",
      // Poses with their uncertainty, of actions and of the keyframes of simple maps.
      "CPoint2D",
      "CPoint3D",
      "CPose3DPDFGaussianInf",
      "CPose3DPDFParticles",
      "CPose3DPDFSOG",
      "CPose3DQuat",
      "CPose3DQuatPDFGaussian",
      "CPose3DQuatPDFGaussianInf",
      "CPosePDFGaussian",
      "CPosePDFGaussianInf",
      "CPosePDFParticles",
      "CPosePDFSOG",
      // Parts of these.
      "CMatrixB",
      "CMatrixD",
      "TStereoCamera",
      // Maps, and the point clouds of observations.
      "CColouredPointsMap",
      "COccupancyGridMap2D",
      "CPointsMapXYZI",
      "CQuadricObjectMap",
      "CSimpleMap",
      "CSimplePointsMap",
      "CWeightedPointsMap",
      "TMapGenericParams",
  };
  return classes.count(className) != 0;
}

}  // namespace quadmap
