#pragma once

#include "quadmap/estimation/EstimatorOptions.h"
#include "quadmap/estimation/NormalEquations.h"
#include "quadmap/estimation/ObjectView.h"
#include "quadmap/estimation/ViewAtPose.h"

namespace quadmap
{
/** Adds all rows of a measurement that is placed in the map, times its weight.
 * \param q Of the label, for the box edges. \param weight Of the whole measurement, > 0. */
void addViewResiduals(
    const ViewAtPose& view,
    const ObjectShape& object,
    double q,
    const RowKernels& kernels,
    double weight,
    NormalEquations& eq);

/** The same for a measurement that is used once. */
void addViewResiduals(
    const ObjectView& view,
    const UprightState& x,
    double shapeExponent,
    const EstimatorOptions& options,
    double weight,
    NormalEquations& eq);

/** How much a whole measurement is believed next to a reference state, in (0, 1],
 * doc/mathematics.md, (11.14): near 1 when its faces are where the reference has them, small for a
 * wrong association or a bad cuboid. */
double viewWeight(const ObjectView& view, const UprightState& reference);

}  // namespace quadmap
