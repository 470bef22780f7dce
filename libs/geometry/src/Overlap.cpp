#include "quadmap/geometry/Overlap.h"
