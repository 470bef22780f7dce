// Compiled where PCL was not found.
#include <stdexcept>

#include "PointOperations.h"
#include "quadmap/dense/DenseCloud.h"

namespace quadmap
{
void requirePcl(const std::string& what)
{
  throw std::runtime_error(
      what + ": this program was built without PCL (package libpcl-dev; doc/dependencies.md)");
}

std::vector<std::size_t> pointOperations::withoutOutliers(const Points&, int, double)
{
  requirePcl("outliers");
  return {};
}

std::vector<pointOperations::SurfaceNormal> pointOperations::surfaceNormals(const Points&, int)
{
  requirePcl("normals");
  return {};
}

std::vector<std::vector<std::size_t>> pointOperations::connectedParts(const Points&, double)
{
  requirePcl("connected parts");
  return {};
}

pointOperations::Points pointOperations::ontoSurface(
    const Points&, const std::vector<float>&, double)
{
  requirePcl("surfaces");
  return {};
}

}  // namespace quadmap
