#include "quadmap/obs/CObservationObjects.h"
