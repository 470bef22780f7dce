#pragma once

#include <mrpt/config/CLoadableOptions.h>

#include <cstddef>
#include <string>

namespace quadmap
{
/** What the program makes of the input. */
enum class SlamMethod
{
  Rgbd,     //!< Complete and partial measurements from colour boxes and depth
  Quadric,  //!< QuadricSLAM: ellipsoids that touch the boxes' edges, no depth
  Point,    //!< Centres of the measurements, for comparison (Mu et al.)
  Odometry  //!< No objects: the trajectory alone
};

/** How it is decided which object a box shows. */
enum class AssociationSource
{
  Estimated,  //!< From labels, positions and sizes
  Given       //!< By the instance ids of the boxes; boxes without one are left out
};

/** Where the poses of the frames come from. */
enum class PoseSource
{
  Auto,         //!< The rawlog's odometry; a single moment needs none; see surveyOdometry()
  Rawlog,       //!< The rawlog's odometry
  Visual,       //!< Visual odometry from the images
  GroundTruth,  //!< The rawlog's "ground_truth" poses
  Graph         //!< A pose graph of another run or program
};

/** The names of the command line and the INI file: rgbd, quadric, point, odometry.
 * \exception std::invalid_argument For another name; lists the known ones. */
SlamMethod slamMethodFrom(const std::string& name);
std::string nameOf(SlamMethod method);

/** estimated, given. \exception std::invalid_argument */
AssociationSource associationSourceFrom(const std::string& name);
std::string nameOf(AssociationSource source);

/** auto, rawlog, visual, ground-truth, graph:FILE. \exception std::invalid_argument */
PoseSource poseSourceFrom(const std::string& name);
std::string nameOf(PoseSource source);

/** Section [slam] of the configuration. */
struct SlamOptions : public mrpt::config::CLoadableOptions
{
  SlamMethod method = SlamMethod::Rgbd;
  PoseSource odometry = PoseSource::Auto;
  std::string odometryGraph;  //!< File of PoseSource::Graph; see GraphOdometry
  AssociationSource association = AssociationSource::Estimated;
  int threads = 0;  //!< That work, 0..kMostThreads; 0: as many as useful. Results are the same

  static constexpr int kMostThreads = 64;

  /** \param name As poseSourceFrom() takes it; of graph:FILE also the file is taken.
   *  \exception std::invalid_argument */
  void setOdometry(const std::string& name);
  std::string odometryName() const;

  /** \exception std::invalid_argument If it is not within 0..kMostThreads. */
  void setThreads(int number);
  std::size_t workingThreads() const;  //!< >= 1

  void loadFromConfigFile(
      const mrpt::config::CConfigFileBase& config, const std::string& section) override;
  void saveToConfigFile(
      mrpt::config::CConfigFileBase& config, const std::string& section) const override;
};

/** How boxes and poses are paired with images. Section [input] of the configuration. */
struct InputOptions : public mrpt::config::CLoadableOptions
{
  double maxBoxDelay = 0.005;   //!< Boxes belong to an image within this time [s], >= 0
  double maxOdometryGap = 1.0;  //!< Poses are interpolated over at most this time [s], > 0

  void loadFromConfigFile(
      const mrpt::config::CConfigFileBase& config, const std::string& section) override;
  void saveToConfigFile(
      mrpt::config::CConfigFileBase& config, const std::string& section) const override;
};

}  // namespace quadmap
