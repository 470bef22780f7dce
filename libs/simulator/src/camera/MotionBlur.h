#pragma once

#include <mrpt/poses/CPose3D.h>

#include "quadmap/simulator/RayCaster.h"

namespace quadmap::simulator
{
/** Blurs the colour of a frame along the way that each pixel moves on while the camera does: things
 * count as standing still. Sets `blur`. \param T_start_end Motion of the camera, whose frame is x
 * forward, y left, z up, during the exposure. */
void blurByMotion(RenderedFrame& frame, const mrpt::poses::CPose3D& T_start_end);

}  // namespace quadmap::simulator
