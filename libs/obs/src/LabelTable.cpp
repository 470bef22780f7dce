#include "quadmap/obs/LabelTable.h"
