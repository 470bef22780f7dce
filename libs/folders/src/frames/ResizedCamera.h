#pragma once

#include <mrpt/img/TCamera.h>

namespace quadmap
{
/** The same camera with images of another size, which show the same. */
inline mrpt::img::TCamera resized(mrpt::img::TCamera camera, unsigned columns, unsigned rows)
{
  // A pixel's number is that of its centre, so that the image begins at -0.5.
  const double sx = static_cast<double>(columns) / camera.ncols,
               sy = static_cast<double>(rows) / camera.nrows;
  camera.setIntrinsicParamsFromValues(
      sx * camera.fx(), sy * camera.fy(), sx * (camera.cx() + 0.5) - 0.5,
      sy * (camera.cy() + 0.5) - 0.5);
  camera.ncols = columns;
  camera.nrows = rows;
  return camera;
}

}  // namespace quadmap
