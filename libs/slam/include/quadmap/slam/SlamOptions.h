#pragma once

#include <cstddef>
#include <string>

#include "quadmap/base/OptionGroup.h"
#include "quadmap/odometry/PoseSource.h"

namespace quadmap
{
/** The method that makes a trajectory and a map of the input. */
enum class SlamMethod
{
  Rgbd,     //!< Complete and partial measurements from colour boxes and depth
  Quadric,  //!< QuadricSLAM: ellipsoids that touch the box edges, without depth
  Point,    //!< Objects are points, the centres of the measurements (Mu et al.)
  Odometry  //!< The trajectory alone, without objects
};

/** How it is decided which object a box shows. */
enum class AssociationSource
{
  Estimated,  //!< From labels, positions and sizes
  Given       //!< By the instance ids of the boxes; boxes without one are left out
};

/** The names of the command line and the INI file: rgbd, quadric, point, odometry.
 * \exception std::invalid_argument For another name; lists the known ones. */
SlamMethod slamMethodFrom(const std::string& name);
std::string nameOf(SlamMethod method);

/** The source of the name estimated or given.
 * \exception std::invalid_argument For another name. */
AssociationSource associationSourceFrom(const std::string& name);
std::string nameOf(AssociationSource source);

/** Section [slam] of the configuration. */
struct SlamOptions : public OptionGroup
{
  SlamMethod method = SlamMethod::Rgbd;
  PoseSource odometry = PoseSource::Auto;
  std::string odometryGraph;  //!< File of PoseSource::Graph; see GraphOdometry
  AssociationSource association = AssociationSource::Estimated;
  /** Name or file of the detector that finds the boxes, see loadDetector(); empty when the input
   * has them. */
  std::string detector;
  int threads = 0;  //!< Number of threads, 0..kMostThreads; 0 chooses. It does not change results

  static constexpr int kMostThreads = 64;

  /** Sets `odometry` and, for graph:FILE, also `odometryGraph`. \param name See poseSourceFrom().
   *  \exception std::invalid_argument For an unknown name. */
  void setOdometry(const std::string& name);
  std::string odometryName() const;

  /** \exception std::invalid_argument If it is not within 0..kMostThreads. */
  void setThreads(int number);
  std::size_t workingThreads() const;  //!< >= 1

  /** Whether the run finds the boxes itself: the method wants some, and a detector is named. */
  bool findsBoxes() const { return method != SlamMethod::Odometry && !detector.empty(); }

 private:
  void describe(OptionList& list) override;
};

/** How boxes and poses are paired with images. Section [input] of the configuration. */
struct InputOptions : public OptionGroup
{
  double maxBoxDelay = 0.005;   //!< Most time between an image and its boxes [s], >= 0
  double maxOdometryGap = 1.0;  //!< Longest time to interpolate poses over [s], > 0
  bool imagesAnywhere = false;  //!< Read external images outside the rawlog's image folder
  int maxImageMegapixels = 16;  //!< Most pixels of an image, in units of 2^20, >= 1

 private:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
