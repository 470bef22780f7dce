#include "quadmap/geometry/RotationDistance.h"
