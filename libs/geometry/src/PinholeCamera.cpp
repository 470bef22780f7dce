#include "quadmap/geometry/PinholeCamera.h"
