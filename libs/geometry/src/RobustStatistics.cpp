#include "quadmap/geometry/RobustStatistics.h"
