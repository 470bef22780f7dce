#include "quadmap/obs/ConfigCheck.h"
