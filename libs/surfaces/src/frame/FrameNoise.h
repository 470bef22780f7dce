#pragma once

#include "quadmap/surfaces/DepthCloud.h"

namespace quadmap
{
/** By which factor the depths of an image err more than their noise() says, equations (4.2) and
 * (4.3): 1 when the image shows too little. */
double noiseFactor(const DepthCloud& cloud);

}  // namespace quadmap
