#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/maps/CSimpleMap.h>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "quadmap/maps/Association.h"
#include "quadmap/maps/FramePairing.h"
#include "quadmap/maps/MapObject.h"
#include "quadmap/maps/MapOptions.h"
#include "quadmap/maps/ObjectEstimator.h"
#include "quadmap/maps/WaitingList.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/perception/RoomPlanes.h"

namespace quadmap
{
using mrpt::maps::CMetricMap;  // the serialization macros need it here

/** Objects (ellipsoids with labels) as an MRPT metric map: insert observations, query, draw,
 * localise in it. The map frame is z-up.
 *
 * insertObservation() takes CObservationObjects with their measurements, and boxes without
 * measurements together with the CObservation3DRangeScan of the same frame (equal sensor label and
 * time stamp, one after the other in either order; any number of sensors in any order). A scan with
 * pixelLabels whose boxes have not come before it is its own boxes. It returns true when an object
 * was touched.
 *
 * Threads: const methods may run concurrently; anything that changes the map needs the caller's
 * lock. */
class CQuadricObjectMap : public mrpt::maps::CMetricMap
{
  DEFINE_SERIALIZABLE(CQuadricObjectMap, quadmap)

 public:
  /** An empty map with the installed label table.
   *  \exception std::runtime_error If the table cannot be read. */
  CQuadricObjectMap();

  using TInsertionOptions = InsertionOptions;
  using TLikelihoodOptions = LikelihoodOptions;
  using TRenderOptions = RenderOptions;
  TInsertionOptions insertionOptions;
  TLikelihoodOptions likelihoodOptions;
  TRenderOptions renderOptions;
  /** For boxes without measurements, inserted together with the range scan of their frame. */
  PerceptionOptions perceptionOptions;

  const LabelTable& labels() const { return *labels_; }
  /** For the observations inserted from now on. */
  void setLabels(LabelTable labels);

  /** Labels of inserted boxes and pixels that the table does not know. Such boxes were used with
   *  neutral properties, such pixels were not. Not stored with the map. */
  const std::set<std::string>& unknownLabels() const { return unknownLabels_; }

  using Objects = std::map<ObjectId, MapObject>;
  const Objects& objects() const;                          //!< All, confirmed or not
  std::vector<const MapObject*> confirmedObjects() const;  //!< Those worth reporting, by id

  // Queries over the confirmed objects -------------------------------------------------------
  const MapObject* find(ObjectId id) const;  //!< Any object; null when there is none
  std::vector<const MapObject*> withLabel(const std::string& label) const;
  /** Objects whose centre lies in the axis-aligned region [m]. */
  std::vector<const MapObject*> inRegion(
      const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) const;
  /** The object (of a label, unless empty) whose centre is nearest; null in an empty map. */
  const MapObject* nearest(const Eigen::Vector3d& p, const std::string& label = {}) const;
  /** The cuboid's outline on the floor, counter-clockwise (x, y) [m].
   *  \exception std::out_of_range If there is no such object. */
  std::vector<Eigen::Vector2d> footprint(ObjectId id) const;

  // Editing ----------------------------------------------------------------------------------
  /** Puts in an object that was estimated elsewhere. It is as one of an archive: further
   * observations join it, and the map's options say whether it is confirmed.
   * \param estimated Its `id` and `confirmed` are not looked at.
   * \return Its id here. \exception std::invalid_argument If the object is not upright, the
   * covariance not positive definite, or nothing was observed. */
  ObjectId addObject(const MapObject& estimated);
  void merge(ObjectId kept, ObjectId absorbed);         //!< \exception std::out_of_range
  void relabel(ObjectId id, const std::string& label);  //!< \exception std::out_of_range
  void remove(ObjectId id);                             //!< \exception std::out_of_range

  /** Settles the map after a batch of insertions: re-estimates all objects (while it grows, those
   * with many measurements wait for some more; `estimateGrowth`), merges overlapping compatible
   * ones, decides which are confirmed. Cheap to repeat. */
  void consolidate();

  /** The confirmed objects in the form of objects.json. */
  std::vector<ObjectRecord> toRecords() const;

  /** How the boxes of the last inserted observation were assigned (for reports). */
  struct Decision
  {
    std::size_t box = 0;
    std::optional<ObjectId> object;  //!< Nothing: the measurement was not used
    bool startedObject = false;
    double logPosterior = 0, logPosteriorSecond = 0;
  };
  const std::vector<Decision>& lastDecisions() const;

  /** What insertion at a pose would decide, without inserting anything: boxes without measurements
   * take no part. */
  std::vector<Decision> match(
      const CObservationObjects& obs, const mrpt::poses::CPose3D& robotPose) const;

  // CMetricMap -------------------------------------------------------------------------------
  bool isEmpty() const override;
  std::string asString() const override;
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& out) const override;
  /** Writes PREFIX.json (the objects), PREFIX.3Dscene and PREFIX.txt. */
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
  std::map<ObjectId, ObjectEstimator> estimators_;  // the measurements behind objects_
  std::map<ObjectId, unsigned> estimatedFrom_;      // how many the latest estimates are from
  ObjectId nextId_ = 1;
  WaitingList waiting_;
  FramePairing pairing_;
  RoomPlanes room_;                                     // what the scans measured here showed
  std::map<std::uint32_t, ObjectId> objectOfInstance_;  // when instance ids are believed
  std::vector<Decision> lastDecisions_;
  std::set<std::string> unknownLabels_;
  std::shared_ptr<const LabelTable> labels_;

  void internal_clear() override;
  bool internal_insertObservation(
      const mrpt::obs::CObservation& obs,
      const std::optional<const mrpt::poses::CPose3D>& robotPose) override;
  double internal_computeObservationLikelihood(
      const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& takenFrom) const override;
  bool internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& obs) const override;

  bool insertFrame(FramePairing::Frame frame);
  bool insertObjects(const CObservationObjects& obs, const mrpt::poses::CPose3D& robotPose);
  Frame frameOf(const CObservationObjects& obs, const mrpt::poses::CPose3D& robotPose) const;
  void associate(Frame& frame) const;
  void joinOrStart(const Frame& frame, std::set<ObjectId>& touched);
  void countMisses(const Frame& frame, const std::set<ObjectId>& touched);
  /** Does a box that belongs to no object (rejected, or waiting for others) show this one? */
  bool isShownByAFreeBox(const MapObject& object, const Frame& frame) const;
  ObjectId startObject(const std::vector<WaitingList::Entry>& entries);
  void addView(MapObject& object, const WaitingList::Entry& entry);
  void mergeOverlapping(std::set<ObjectId> touched);
  void estimate(MapObject& object, bool restart);
  bool isDue(const MapObject& object) const;  // for another estimate
  bool isConfirmed(const MapObject& object) const;
  MapObject& require(ObjectId id);

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
