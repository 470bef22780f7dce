#include "quadmap/geometry/Ellipsoid.h"
