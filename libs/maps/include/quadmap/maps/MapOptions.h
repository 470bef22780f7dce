#pragma once

#include "quadmap/base/OptionGroup.h"
#include "quadmap/estimation/Association.h"
#include "quadmap/estimation/ObjectRules.h"
#include "quadmap/estimation/ObjectView.h"
#include "quadmap/estimation/Visibility.h"
#include "quadmap/maps/ObjectEstimator.h"
#include "quadmap/maps/WaitingList.h"

namespace quadmap
{
/** How observations become objects. INI section `<prefix>_insertOpts`; keys in MapOptions.cpp. */
struct InsertionOptions : public OptionGroup
{
  AssociationParameters association;
  AgreementOptions agreement;
  EstimatorOptions estimator;
  PoseNoise poseNoise;
  ExistenceOptions existence;
  MergeOptions merging;
  WaitingOptions waiting;
  /** An object is estimated anew when its measurements are more by this share, >= 0. */
  double estimateGrowth = 0.1;
  bool useInstanceIds = false;  //!< Believe DetectedObject::instanceId instead of associating
  double minScore = 0;          //!< Boxes the detector is less sure of are ignored, in [0, 1]

 private:
  void describe(OptionList& list) override;
};

/** Log-likelihood of an observation from a pose. INI section `<prefix>_likelihoodOpts`. */
struct LikelihoodOptions : public OptionGroup
{
  double positionSigma = 0.15;  //!< Of a measured centre, beyond the measurement's own [m], > 0
  double yawSigma = 0.15;       //!< Of a measured yaw, beyond the measurement's own [rad], > 0
  double angleSigma = 0.03;     //!< Of a box edge as an angle, beyond the detector's [rad], > 0
  double outlierShare = 0.1;    //!< Boxes that show nothing of the map, in (0, 1)
  bool onlyConfirmed = true;    //!< Compare with confirmed objects only

 private:
  void describe(OptionList& list) override;
};

/** What getVisualizationInto() draws. INI section `<prefix>_renderOpts`. */
struct RenderOptions : public OptionGroup
{
  bool cuboids = true;       //!< Wire frame of the circumscribed cuboid
  bool ellipsoids = true;    //!< Transparent solid ellipsoid
  bool labels = true;        //!< Name and id above the object
  bool unconfirmed = false;  //!< Draw objects that are not confirmed too, in grey
  double textHeight = 0.08;  //!< Of the labels [m], > 0
  double opacity = 0.35;     //!< Of the ellipsoids, in [0, 1]

 private:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
