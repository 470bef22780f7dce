#include "quadmap/obs/OutputFile.h"
