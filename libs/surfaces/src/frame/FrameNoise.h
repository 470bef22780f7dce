#pragma once

#include "quadmap/surfaces/DepthCloud.h"

namespace quadmap
{
/** By which factor the depths of an image err more than their noise() says, equations (4.2) and
 * (4.3), in [1, most]. It is nearly 1 when few parts of the image show a surface. \param most >= 1
 */
double noiseFactor(const DepthCloud& cloud, double most);

}  // namespace quadmap
