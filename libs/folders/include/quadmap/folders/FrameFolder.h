#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/folders/FolderCamera.h"
#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
class BoxReader;
class FrameImageReader;
class FrameRectification;

/** A colour image and its depth image. */
struct FolderFrame
{
  double time = 0;           //!< Time of the depth image, which gives the geometry [s]
  std::string color, depth;  //!< Full paths; the same file when it has both
  std::string listed;        //!< The place in a list ("associations.txt:12"), or the file
  std::optional<mrpt::poses::CPose3D> T_world_optical;  //!< Of the colour camera
  std::string poseProblem = {};  //!< Why the pose it has cannot be used; names the file
};

/** What the reader of one kind of folder finds in it. */
struct FolderContent
{
  std::string kind, folder;
  FolderCamera camera;
  std::vector<FolderFrame> frames;
  std::string poses;  //!< Where poses are from, such as "groundtruth.txt"; may be ""
  /** Why a file with all poses, or lines of it, cannot be used; each names the file. */
  std::vector<std::string> posesProblems;
  /** Whether there is such a file, and no pose in it can be used. */
  bool posesAreRefused = false;
  /** Why images that are listed or numbered cannot be used, and are no frames; each names the file.
   */
  std::vector<std::string> listProblems;
  std::string pairing;             //!< How colour and depth images were paired
  std::size_t unpaired = 0;        //!< Number of images of which no pair could be made
  std::string firstUnpaired;       //!< The file of the first of them
  std::vector<std::string> notes;  //!< What a user should know, although it is no error
  /** Reads the images of a frame; when it is null, they are image files. */
  std::shared_ptr<const FrameImageReader> images;

  void addUnpaired(const std::string& file)
  {
    if (unpaired++ == 0) firstUnpaired = file;
  }
};

/** How a folder is read. */
struct FrameFolderOptions
{
  /** Folder of the boxes, or a file of COCO's; if empty, DIR/detections. */
  std::string detections;
  std::string labels;  //!< File with the names of classes, for boxes that have numbers; may be ""
  std::string camera;  //!< See cameraPreset(); if empty, the folder tells
  double maxPairDelay = 0.02;   //!< Most time from colour to depth image [s], > 0
  double maxPoseGap = 0.1;      //!< Longest time to interpolate poses over [s], > 0
  bool imagesAnywhere = false;  //!< Images may lie behind links out of the folder
  std::string imagesHint;       //!< How a user sets imagesAnywhere, for messages; empty: not at all
};

/** A frame as it goes into a rawlog. */
struct RecordedFrame
{
  mrpt::obs::CObservation3DRangeScan::Ptr scan;
  /** The colour image as the file has it, when that is a JPEG which needs no change; the scan then
   * has no colour pixels. */
  std::vector<std::uint8_t> jpeg;
};

/** A recording of an RGB-D camera in a folder, of any kind. See openFrameFolder().
 *
 * A recording of a camera with a negative fy is in a left-handed world, and comes out right-handed.
 * Images and boxes come out rectified, with depth registered to colour. Poses come out as
 * T_world_robot. The robot's frame is the sensor's (x forward, z up), and the world is turned so
 * that up is +z. */
class FrameFolder
{
 public:
  /** \exception std::runtime_error If the detections cannot be read. */
  FrameFolder(FolderContent content, const FrameFolderOptions& options);
  FrameFolder(FrameFolder&&) noexcept;
  ~FrameFolder();

  const std::string& kind() const { return content_.kind; }
  const std::string& folder() const { return content_.folder; }
  /** As it is in the files, but that a negative fy is made positive. */
  const FolderCamera& camera() const { return content_.camera; }
  const mrpt::img::TCamera& rectifiedCamera() const { return rectified_; }
  const std::vector<FolderFrame>& frames() const { return content_.frames; }
  const std::string& pairing() const { return content_.pairing; }
  /** Number of colour images without a depth image, and the other way round. */
  std::size_t unpaired() const { return content_.unpaired; }
  const std::string& firstUnpaired() const { return content_.firstUnpaired; }  //!< Its file
  std::size_t posesCount() const;                              //!< Number of frames with a pose
  const std::string& poses() const { return content_.poses; }  //!< Where they are from
  /** Why the file that has the poses, or lines of it, cannot be used; each names the file. */
  const std::vector<std::string>& posesProblems() const { return content_.posesProblems; }
  /** Whether that is why no frame has a pose. */
  bool posesAreRefused() const { return content_.posesAreRefused; }
  /** Why images that are listed or numbered cannot be used; each names the file. */
  const std::vector<std::string>& listProblems() const { return content_.listProblems; }
  bool hasDetections() const { return boxes_ != nullptr; }
  std::string detections() const;  //!< Where boxes are from, and in which form; may be ""
  /** What a user should know, although it is no error. */
  const std::vector<std::string>& notes() const { return content_.notes; }

  /** Loads the images of a frame. \exception std::runtime_error If one is missing, unreadable or of
   *  another size than the camera's. */
  mrpt::obs::CObservation3DRangeScan::Ptr scan(std::size_t frame) const;

  /** The same for a rawlog, without decoding what can be copied. A JPEG is checked for damage.
   *  \exception std::runtime_error As scan(). */
  RecordedFrame recorded(std::size_t frame) const;

  /** The boxes of a frame as the detector gave them, rectified, or null when the detector did not
   *  look at the frame. \exception std::runtime_error For a malformed file. The message names file
   *  and line. */
  CObservationObjects::Ptr boxes(std::size_t frame) const;
  /** The file that has or should have the boxes of a frame, and where in it, for messages. */
  std::string boxesFile(std::size_t frame) const;
  /** Why boxes of a frame cannot be used, with the place of each: "f1.txt:2: chair (x1=9 ...) is
   *  inverted". By their indices in `boxes`, which are boxes(frame). */
  std::map<std::size_t, std::string> unusableBoxes(
      std::size_t frame, const CObservationObjects& boxes) const;
  /** Whether there are boxes in one file for all images, and none of them is of a frame. */
  bool boxesAreOfOtherImages() const;

  /** The pose of a frame, or nothing when the recording has none for it. */
  std::optional<mrpt::poses::CPose3D> T_world_robot(std::size_t frame) const;

  /** Turns the world of all poses. \param up Unit vector in the world as it was recorded. */
  void turnUp(const Eigen::Vector3d& up);

 private:
  FolderContent content_;
  mrpt::img::TCamera rectified_;
  std::unique_ptr<const FrameRectification> rectification_;  // null: nothing to rectify
  std::unique_ptr<const BoxReader> boxes_;                   // null: there are none
  mrpt::poses::CPose3D T_zup_world_;
};

}  // namespace quadmap
