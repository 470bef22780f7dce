#include "quadmap/geometry/Support.h"
