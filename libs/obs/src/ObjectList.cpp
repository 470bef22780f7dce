#include "quadmap/obs/ObjectList.h"
