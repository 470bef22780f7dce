#include "quadmap/geometry/Plane.h"
