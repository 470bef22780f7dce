#pragma once

#include <mrpt/img/TColor.h>

namespace quadmap
{
// Of the lines in scenes, pictures and their legends.
inline const mrpt::img::TColor kTruthColor(20, 20, 20);
inline const mrpt::img::TColor kTrajectoryColor(20, 60, 160);
inline const mrpt::img::TColor kOdometryColor(230, 120, 20, 200);

}  // namespace quadmap
