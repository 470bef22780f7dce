#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/math/TBoundingBox.h>
#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPolygon2D.h>
#include <mrpt/version.h>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "quadmap/estimation/Association.h"
#include "quadmap/estimation/ExistenceLooks.h"
#include "quadmap/estimation/MapObject.h"
#include "quadmap/maps/FrameLikelihood.h"
#include "quadmap/maps/FramePairing.h"
#include "quadmap/maps/JointSightings.h"
#include "quadmap/maps/MapMerge.h"
#include "quadmap/maps/MapOptions.h"
#include "quadmap/maps/ObjectEstimator.h"
#include "quadmap/maps/UncertainPose.h"
#include "quadmap/maps/WaitingList.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/surfaces/RoomPlanes.h"

namespace quadmap
{
using mrpt::maps::CMetricMap;  // the serialization macros need it here

class LabelSource;
struct MergedMap;
struct PlannedObject;

/** Objects (ellipsoids with labels) as an MRPT metric map: insert observations, query, draw,
 * localise in it. The map frame is z-up; lengths are in metres and angles in radians.
 *
 * insertObservation() takes CObservationObjects with their measurements. It also takes boxes
 * without measurements together with the CObservation3DRangeScan of the same frame: both have an
 * equal sensor label and time stamp and come one after the other in either order, from any number
 * of sensors in any order. A scan with pixelLabels whose boxes have not come before it is its own
 * boxes. insertObservation() returns true when an object was touched.
 *
 * computeObservationLikelihood() takes CObservationObjects. Boxes without measurements are measured
 * with the scan of their frame if that was inserted and waits for them, which takes as long as
 * inserting them does; else their edges say what they can. Boxes that perception rejected and
 * those below `insertionOptions.minScore` take no part. canComputeObservationLikelihood() is false
 * when no box says anything; the likelihood is then the same everywhere. Boxes without a usable
 * calibration are a std::runtime_error, those that do not fit their scan a
 * std::invalid_argument.
 *
 * Pointers to objects: they stay valid while the object is in the map, and show its latest
 * estimate. An object leaves the map by remove(), by merge() as the absorbed one, by a merging of
 * insertObservation() or consolidate(), by clear(), by loading or assigning, and with the map. So
 * copy what you need before you change the map, or find() the id again afterwards.
 *
 * Threads: const methods may run concurrently; anything that changes the map needs the caller's
 * lock. */
class CQuadricObjectMap : public mrpt::maps::CMetricMap
{
  DEFINE_SERIALIZABLE(CQuadricObjectMap, quadmap)

 public:
  /** An empty map. It reads nothing from disk: the installed label table is read when it is first
   *  needed, unless setLabels() gave one before. */
  CQuadricObjectMap();

  using TInsertionOptions = InsertionOptions;
  using TLikelihoodOptions = LikelihoodOptions;
  using TRenderOptions = RenderOptions;
  TInsertionOptions insertionOptions;
  TLikelihoodOptions likelihoodOptions;
  TRenderOptions renderOptions;
  /** For boxes without measurements, inserted together with the range scan of their frame. */
  PerceptionOptions perceptionOptions;

  // Labels -----------------------------------------------------------------------------------
  /** The label table in use. The reference is valid until setLabels(), until another map is loaded
   *  or assigned, and as long as the map lives.
   *  \exception std::runtime_error If no table was given and the installed one cannot be read. All
   *  methods that look at labels throw it, too. */
  const LabelTable& labels() const;

  /** Gives the table for the observations inserted from now on; objects keep their labels. */
  void setLabels(LabelTable labels);

  /** Labels of inserted boxes and pixels that the table does not know. Such boxes were used with
   *  neutral properties, such pixels were not. Not stored with the map. */
  const std::set<std::string>& unknownLabels() const { return unknownLabels_; }

  // Insertion --------------------------------------------------------------------------------
  /** MRPT's way to insert: at a pose that errs by `insertionOptions.poseNoise`, or at the map's
   * origin without a pose. Exceptions are those of the overload below. */
  using CMetricMap::insertObservation;

  /** Inserts an observation at a pose with an uncertainty of its own, given as MRPT's
   * CPose3DPDFGaussian or as {pose, standard deviations}. `insertionOptions.poseNoise` comes on
   * top of it.
   * \param robotPose T_map_robot; the observation knows its sensor's pose on the robot.
   * \return True when an object of the map was touched. False when nothing could be used, when the
   * partner of the frame is missing, or when `genericMapParams` turns insertion off.
   * \exception std::invalid_argument If boxes and scan of one frame have different cameras or
   * sensor poses; neither is used.
   * \exception std::runtime_error If a scan has no depth image, or scan or boxes have no usable
   * calibration; names the sensor. */
  bool insertObservation(const mrpt::obs::CObservation& obs, const UncertainPose& robotPose);

  /** Settles the map after a batch of insertions: it estimates all objects anew (while the map
   * grows, those with many measurements wait for some more; `estimateGrowth`), merges overlapping
   * compatible ones, and decides which are confirmed. */
  void consolidate();

  /** How a box of an observation was assigned. */
  struct Decision
  {
    std::size_t box = 0;             //!< Index in CObservationObjects::objects
    std::optional<ObjectId> object;  //!< Nothing: the measurement was not used
    bool startedObject = false;      //!< The box made a new object
    double logPosterior = 0;         //!< Of the decision [nat]
    double logPosteriorSecond = 0;   //!< Of the second best one [nat]
  };

  /** The decisions for the last inserted observation; empty while it waits for its partner. The
   *  reference is valid as long as the map lives, its content until the next insertion. */
  const std::vector<Decision>& lastDecisions() const;

  /** The objects that others absorbed since the last observation came, each with the object of the
   * map that has its measurements now. */
  const std::map<ObjectId, ObjectId>& heirs() const { return heirs_; }

  /** What insertion at a pose would decide, without inserting anything: boxes without measurements
   * take no part. The pose errs as for insertObservation(). */
  std::vector<Decision> match(const CObservationObjects& obs, const UncertainPose& robotPose) const;
  std::vector<Decision> match(
      const CObservationObjects& obs, const mrpt::poses::CPose3D& robotPose) const;

  /** computeObservationLikelihood() for many poses, prepared once for a frame whose boxes have
   * their measurements.
   * \param boxes With measurements; those of kind None take no part.
   * \param attitude Its pitch and roll are those of the robot at all poses.
   * \exception std::runtime_error If there are boxes without a usable calibration. */
  FrameLikelihood likelihoodOf(
      const CObservationObjects& boxes, const mrpt::poses::CPose3D& attitude) const;

  // Queries ----------------------------------------------------------------------------------
  /** An object of this map, with the measurements behind it, which only the map itself reaches. */
  class Entry : public MapObject
  {
    friend class CQuadricObjectMap;
    ObjectEstimator estimator;
    ExistenceLooks looks;
    unsigned estimatedFrom = 0;  // number of measurements of the latest estimate
    UprightCovariance doubts = UprightCovariance::Zero();  // part of the covariance
  };
  using Objects = std::map<ObjectId, Entry>;

  /** All objects by id, confirmed or not. The reference is valid as long as the map lives. */
  const Objects& objects() const;
  /** The objects worth reporting, by id. For the pointers see the class. */
  std::vector<const MapObject*> confirmedObjects() const;

  /** Objects that were certain when the camera turned away from them, and that it came back to. */
  struct Revisits
  {
    std::size_t found = 0;
    std::size_t missed = 0;  //!< Those that surely are not there, by the later looks
  };
  Revisits revisits() const;

  /** The object with this id, confirmed or not; null when there is none. For the pointer see the
   *  class. */
  const MapObject* find(ObjectId id) const;

  /** The confirmed objects of a label in any of its spellings, by id. */
  std::vector<const MapObject*> withLabel(const std::string& label) const;

  /** The confirmed objects whose centre lies in the axis-aligned region or on its border, by id.
   *  \param region In the map frame [m]. */
  std::vector<const MapObject*> inRegion(const mrpt::math::TBoundingBox& region) const;

  /** The confirmed object whose centre is nearest to a place; null when there is none.
   *  \param p In the map frame [m].
   *  \param label Only objects of this label are looked at, unless it is empty. */
  const MapObject* nearest(const mrpt::math::TPoint3D& p, const std::string& label = {}) const;

  /** The outline of an object's cuboid on the floor, counter-clockwise from above.
   *  \return Four corners (x, y) in the map frame [m].
   *  \exception std::out_of_range If there is no such object. */
  mrpt::math::TPolygon2D footprint(ObjectId id) const;

  /** The smallest axis-aligned box in the map frame that holds the cuboids of all confirmed objects
   * [m]; from the origin to the origin when there is none. */
#if MRPT_VERSION >= 0x020b03
  mrpt::math::TBoundingBoxf boundingBox() const override;
#else
  mrpt::math::TBoundingBoxf boundingBox() const;
#endif

  /** The confirmed objects in the form of objects.json. */
  std::vector<ObjectRecord> toRecords() const;

  // Editing ----------------------------------------------------------------------------------
  /** Puts in an object that was estimated elsewhere. It is as one of an archive: further
   * observations join it, and the map's options say whether it is confirmed.
   * \param estimated In the map frame. Its `id` and `confirmed` are not looked at.
   * \return Its id here.
   * \exception std::invalid_argument If the object is not upright, the covariance not positive
   * definite, or nothing was observed. */
  ObjectId addObject(const MapObject& estimated);

  /** Makes one object of two: `kept` takes over the measurements of `absorbed`, which leaves the
   *  map. \exception std::out_of_range If one of them is not there, or both are the same. */
  void merge(ObjectId kept, ObjectId absorbed);

  /** Makes another map of the same place a part of this one (doc/mathematics.md, section 25). Where
   * it is, is told by the objects that both have; these are estimated together with that. The frame
   * and the options are those of this map, and its objects keep their ids.
   * \param ownFrames,otherFrames What the maps were made of, if that is still there: it shows what
   * is gone. What the newer map shows to be gone or elsewhere leaves the map.
   * \return Nothing when it cannot be told where the other map is; this one is then as it was. */
  std::optional<MapMerge> mergeMap(
      const CQuadricObjectMap& other,
      const MapMergeOptions& options = {},
      const SessionFrames& ownFrames = {},
      const SessionFrames& otherFrames = {});

  /** Tells how uncertain an object is because the poses it was seen from err alike
   * (doc/mathematics.md, (16.18)). It is a part of the object's covariance from now on, however
   * many measurements come, and says anew whether the object is confirmed. A stored map keeps it as
   * a part of what is known.
   * \exception std::out_of_range If there is no such object.
   * \exception std::invalid_argument If it is not symmetric or has a negative eigenvalue. */
  void setSharedError(ObjectId id, const UprightCovariance& error);
  /** \exception std::out_of_range If there is no such object. */
  const UprightCovariance& sharedError(ObjectId id) const;

  /** For the end of a run, when the poses are no longer in doubt. Estimates each object once more,
   * and lets go of sides and box edges that contradict the rest (doc/mathematics.md, (11.28)). Adds
   * to its covariance what it errs by in case those measurements are right that saw it reach
   * farther than it says, and where no image shows its end ((11.25) and (11.27)). The next estimate
   * leaves these out again, because so wide a covariance would let the boxes of neighbours join it.
   * Which objects are confirmed stays as it is. A stored map keeps the doubts as a part of what is
   * known.
   */
  void conclude();

  /** Makes all measurements of an object say this label, in its canonical spelling.
   *  \exception std::out_of_range If there is no such object.
   *  \exception std::invalid_argument For a label that is too long for a stored map. */
  void relabel(ObjectId id, const std::string& label);

  /** Says where an object is and how large, as a person knows it. What was measured before no
   * longer counts, but for how uncertain it was; further observations join what is said. \param
   * object In the map frame. \exception std::out_of_range If there is no such object. \exception
   * std::invalid_argument If it is not upright. */
  void place(ObjectId id, const Ellipsoid& object);

  /** Takes an object out. \exception std::out_of_range If there is no such object. */
  void remove(ObjectId id);

  // Files ------------------------------------------------------------------------------------
  /** Writes the map with its options and its label table as a .quadmap file (doc/formats.md),
   * complete or not at all. Scans and boxes that wait for something are not kept.
   * \exception std::runtime_error One line that names the file. */
  void saveToFile(const std::string& file) const;

  /** Makes this the map of a .quadmap file, of archive version 0 or 1. A file of version 0 has no
   * label table: the table of this map stays.
   * \exception std::runtime_error One line that names the file: it cannot be read, holds something
   * else, is truncated, damaged or of a newer version. The map then is as it was. */
  void loadFromFile(const std::string& file);

  // CMetricMap -------------------------------------------------------------------------------
  bool isEmpty() const override;  //!< No object is in the map, confirmed or not
  /** For people: one line for the map and one for each confirmed object. */
  std::string asString() const override;

  /** Adds what `renderOptions` ask for, in the map frame. */
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& out) const override;

  /** Writes PREFIX.json (the objects), PREFIX.3Dscene and PREFIX.txt.
   *  \exception std::runtime_error Names the file that cannot be written. */
  void saveMetricMapRepresentationToFile(const std::string& prefix) const override;

  /** Pairs each confirmed object of another CQuadricObjectMap with the nearest one here whose label
   *  is compatible. \exception std::invalid_argument If the other map is of another class. */
  void determineMatching3D(
      const mrpt::maps::CMetricMap* otherMap,
      const mrpt::poses::CPose3D& otherMapPose,
      mrpt::tfest::TMatchingPairList& correspondences,
      const mrpt::maps::TMatchingParams& params,
      mrpt::maps::TMatchingExtraResults& extraResults) const override;

  /** Share of the other map's confirmed objects that have a partner here; 0 for other classes. */
  float compute3DMatchingRatio(
      const mrpt::maps::CMetricMap* otherMap,
      const mrpt::poses::CPose3D& otherMapPose,
      const mrpt::maps::TMatchingRatioParams& params) const override;

 private:
  struct Frame;  // one observation while it is inserted

  Objects objects_;
  ObjectId nextId_ = 1;
  WaitingList waiting_;
  FramePairing pairing_;
  RoomPlanes room_;                                     // what the scans measured here showed
  std::map<std::uint32_t, ObjectId> objectOfInstance_;  // when instance ids are believed
  std::vector<Decision> lastDecisions_;
  JointSightings together_;
  std::map<ObjectId, ObjectId> heirs_;
  std::set<std::string> unknownLabels_;
  std::shared_ptr<const LabelSource> labels_;  // copies of a map share it

  void internal_clear() override;
  bool internal_insertObservation(
      const mrpt::obs::CObservation& obs,
      const std::optional<const mrpt::poses::CPose3D>& robotPose) override;
  double internal_computeObservationLikelihood(
      const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& takenFrom) const override;
  bool internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& obs) const override;

  bool insertAt(const mrpt::obs::CObservation& obs, const UncertainPose& robotPose);
  bool insertFrame(FramePairing::Frame frame);
  bool insertObjects(const CObservationObjects& obs, const UncertainPose& robotPose);
  Frame frameOf(const CObservationObjects& obs, const UncertainPose& robotPose) const;
  CObservationObjects measured(
      const CObservationObjects& boxes, const mrpt::poses::CPose3D& T_map_robot) const;
  std::vector<FrameLikelihood::Target> targets(std::vector<const MapObject*>& objects) const;
  void associate(Frame& frame) const;
  double associationLikelihood(const Frame& frame, std::size_t view, const MapObject& object) const;
  void joinOrStart(const Frame& frame, std::set<ObjectId>& touched);
  ObjectId startObject(const std::vector<WaitingList::Entry>& entries);
  void addView(Entry& object, const WaitingList::Entry& entry);
  std::set<ObjectId> countMisses(const Frame& frame, const std::set<ObjectId>& touched);
  LookCounts tellingLooks(const Entry& object) const;
  std::map<std::string, LookCounts> tellingLooksByLabel() const;
  double detectionProbabilityByOthers(
      const Entry& object, const std::map<std::string, LookCounts>& ofLabels) const;
  void judge(const std::set<ObjectId>& looked);
  /** Does a box that belongs to no object (rejected, or waiting for others) show this one? */
  bool isShownByAFreeBox(const MapObject& object, const Frame& frame) const;
  bool areTwoThings(const Entry& a, const Entry& b) const;
  void mergeOverlapping(std::set<ObjectId> touched);
  void estimate(Entry& object, bool restart);
  bool isDue(const Entry& object) const;  // for another estimate
  void weighSize(Entry& object) const;
  bool isConfirmed(const Entry& object) const;
  Entry& require(ObjectId id);
  MergedMap contents() const;
  void take(ObjectId id, const PlannedObject& planned);

  MAP_DEFINITION_START(CQuadricObjectMap)
  quadmap::CQuadricObjectMap::TInsertionOptions insertionOpts;
  quadmap::CQuadricObjectMap::TLikelihoodOptions likelihoodOpts;
  quadmap::CQuadricObjectMap::TRenderOptions renderOpts;
  quadmap::PerceptionOptions perceptionOpts;
  std::string labelTable;  //!< creationOpts: file of the label table; empty: the installed one
  MAP_DEFINITION_END(CQuadricObjectMap)
};

/** Registers the classes of this library (and of obs) with MRPT's factory; see registerObsClasses.
 */
void registerMapClasses();

}  // namespace quadmap
