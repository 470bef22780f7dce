#include "quadmap/geometry/Projection.h"
