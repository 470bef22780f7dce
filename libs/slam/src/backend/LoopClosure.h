#pragma once

#include <vector>

#include "quadmap/constellation/Doubles.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** Moves the keyframes so that the two objects of each pair come to one place, as the steps of the
 * odometry allow it. The first keyframe stays.
 * \param sigma Of the place of an object as its nearest keyframe saw it [m], > 0.
 * \param noise How many times as much as it claims the odometry errs by. */
void bringTogether(
    const Doubles& doubles,
    const CQuadricObjectMap& map,
    double sigma,
    const StepNoise& noise,
    std::vector<Keyframe>& keyframes);

/** Are the doubles of a run one thing each after it was estimated anew? Most pairs must be, and
 * there must be as many objects fewer: where others were torn apart, the places were two. */
bool becameOne(const Doubles& doubles, const SlamResult& before, const SlamResult& after);

}  // namespace quadmap
