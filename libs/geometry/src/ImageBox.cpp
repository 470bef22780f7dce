#include "quadmap/geometry/ImageBox.h"
