#pragma once

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

#include "../apps/RunProgram.h"
#include "../detection/TinyDetector.h"
#include "Downloads.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/sensors/RawlogSource.h"
#include "quadmap/sensors/RawlogWriter.h"

#ifdef QUADMAP_TEST_OPENNI2
#include "../cameras/driver/CameraOfRawlog.h"
#endif

namespace quadmap
{
/** The folder in which the commands of a page are run: all that pages speak of and do not make. */
class Workspace
{
 public:
  static constexpr int kFrames = 24;  //!< of the recordings in the layout of TUM RGB-D

  Workspace()
  {
    namespace fs = std::filesystem;
    const fs::path source = QUADMAP_SOURCE_DIR, build = fs::path(QUADMAP_BIN_DIR).parent_path();
    fs::create_directory(folder.path("build"));
    link(build, "build/release");
    fs::copy(source / "share", folder.path("share"), fs::copy_options::recursive);
    link(source / "tests", "tests");
    fs::copy(source / "rawlogs", folder.path("rawlogs"));
    for (const std::string name : {"home", "today", "kitchen"})  // copies: commands write, too
      for (const char* end : {".rawlog", ".objects.rawlog", ".objects.gt.json", ".groundtruth.tum"})
        fs::copy(source / "rawlogs" / (std::string("home") + end), folder.path(name + end));
    fs::copy(source / "rawlogs/home.objects.gt.json", folder.path("objects.gt.json"));
    link(folder.path("home"), "yesterday");
    link(folder.path("home"), "later");
    folder.write(
        "edits.json",
        R"({"format":"quadmap-edits", "version":1, "edits":[{"op":"remove", "id":2}]})");
    link(tiny_.folder.folder(), "models");
    folder.write("share/quadmap/detectors/nanodet-m.ini", TinyDetector::ini());
    writeRecordings();
    plugCamera();
  }

  /** Runs commands as typed in the folder, and ends at the first that fails. */
  ProgramResult run(const std::string& commands) const
  {
    folder.write("commands", "set -euo pipefail\n" + commands);
    std::string libraries = QUADMAP_LIB_DIR;
#ifdef QUADMAP_TEST_OPENNI2
    libraries = QUADMAP_TEST_OPENNI2 ":" + libraries;
#endif
    return runCommand(
        "cd '" + folder.folder().string() + "' && env HOME=\"$PWD\" " +
        "QUADMAP_SHARE_DIR=\"$PWD/share/quadmap\" QUADMAP_MODELS=\"$PWD/models\" " +
        "QUADMAP_TEST_CAMERA=\"$PWD/plugged\" LD_LIBRARY_PATH='" + libraries + "' PATH='" +
        QUADMAP_BIN_DIR + "':\"$PATH\" bash commands </dev/null");
  }

  TemporaryFolder folder;

 private:
  void link(const std::filesystem::path& target, const std::string& name) const
  {
    std::filesystem::create_symlink(target, folder.path(name));
  }

  /** The first frames of the bundled recording as what other programs leave: my_kitchen in the
   * layout of TUM RGB-D; room_rgb, room_depth and room_camera_poses.txt of RTAB-Map; kitchen
   * without poses, which are in COLMAP's model/images.txt. */
  void writeRecordings() const
  {
    namespace fs = std::filesystem;
    for (const char* sub : {"my_kitchen/rgb", "my_kitchen/depth", "my_kitchen/detections", "model"})
      fs::create_directories(folder.path(sub));
    RawlogSource source(QUADMAP_SOURCE_DIR "/rawlogs/home.rawlog", {});
    const Trajectory truth = readTumTrajectory(QUADMAP_SOURCE_DIR "/rawlogs/home.groundtruth.tum");
    std::string rgb, depth, poses, colmap = "# image list\n";
    Downloads downloads(folder);
    RawlogWriter session(folder.path("alma_s1.rawlog"), {});
    for (int i = 0; i < kFrames; ++i)
    {
      const auto frame = source.next();
      if (!frame) throw std::runtime_error("the bundled recording ends early");
      const std::string name = mrpt::format("%.6f", mrpt::Clock::toDouble(frame->scan->timestamp));
      writeImages(*frame, name);
      rgb += name + " rgb/" + name + ".jpg\n";
      depth += name + " depth/" + name + ".png\n";
      const auto T_world_optical = truth[static_cast<std::size_t>(i)].pose + T_sensor_optical();
      poses += name + " " + text(T_world_optical, false) + "\n";
      colmap += mrpt::format("%d ", i + 1) + text(-T_world_optical, true) + " 1 images/" + name +
                ".jpg\n12.5 7.25 -1\n";
      if (i == 0) writeCalibration(frame->scan->cameraParams);
      if (i < Downloads::kFrames)
        downloads.add(
            i, frame->scan->intensityImage.asCvMatRef(), millimetresOf(*frame->scan),
            T_world_optical, text(T_world_optical, false));
      if (i >= Downloads::kFrames) continue;
      frame->scan->sensorLabel = "RGBD_1";
      session.write(*frame->scan);
    }
    downloads.finish();
    session.finish();
    folder.write("my_kitchen/rgb.txt", rgb);
    folder.write("my_kitchen/depth.txt", depth);
    fs::copy(folder.path("my_kitchen"), folder.path("kitchen"), fs::copy_options::recursive);
    fs::copy(folder.path("my_kitchen/rgb"), folder.path("room_rgb"));
    fs::copy(folder.path("my_kitchen/depth"), folder.path("room_depth"));
    folder.write("my_kitchen/groundtruth.txt", poses);
    folder.write("room_camera_poses.txt", "#timestamp x y z qx qy qz qw\n" + poses);
    folder.write("model/images.txt", colmap);
  }

  static cv::Mat millimetresOf(const mrpt::obs::CObservation3DRangeScan& scan)
  {
    cv::Mat depth(
        static_cast<int>(scan.rangeImage.rows()), static_cast<int>(scan.rangeImage.cols()), CV_16U);
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u)
        depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(
            std::lround(1000 * static_cast<double>(scan.rangeUnits) * scan.rangeImage(v, u)));
    return depth;
  }

  void writeImages(const RgbdFrame& frame, const std::string& name) const
  {
    const auto& scan = *frame.scan;
    cv::imwrite(folder.path("my_kitchen/rgb/" + name + ".jpg"), scan.intensityImage.asCvMatRef());
    cv::imwrite(folder.path("my_kitchen/depth/" + name + ".png"), millimetresOf(scan));
    std::string boxes;
    for (const auto& o : frame.objects->objects)
    {
      std::string label = o.label;
      std::replace(label.begin(), label.end(), ' ', '_');
      boxes += mrpt::format("0 %s %.3f ", label.c_str(), o.score) +
               mrpt::format("%.2f %.2f %.2f %.2f\n", o.box.x1, o.box.y1, o.box.x2, o.box.y2);
    }
    folder.write("my_kitchen/detections/" + name + ".txt", boxes);
  }

  void writeCalibration(const mrpt::img::TCamera& c) const
  {
    folder.write(
        "my_kitchen/calibration.yaml",
        mrpt::format(
            "%%YAML:1.0\n---\nfx: %f\nfy: %f\ncx: %f\ncy: %f\nwidth: %u\nheight: %u\n", c.fx(),
            c.fy(), c.cx(), c.cy(), c.ncols, c.nrows) +
            "depth_factor: 1000\nworld_up: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n"
            "   data: [ 0., 0., 1. ]\n");
  }

  /** "tx ty tz qx qy qz qw", or "qw qx qy qz tx ty tz" as COLMAP has it. */
  static std::string text(const mrpt::poses::CPose3D& pose, bool quaternionFirst)
  {
    mrpt::math::CQuaternionDouble q;
    pose.getAsQuaternion(q);
    const std::string t = mrpt::format("%.9f %.9f %.9f", pose.x(), pose.y(), pose.z());
    if (quaternionFirst)
      return mrpt::format("%.9f %.9f %.9f %.9f ", q.r(), q.x(), q.y(), q.z()) + t;
    return t + mrpt::format(" %.9f %.9f %.9f %.9f", q.x(), q.y(), q.z(), q.r());
  }

#ifdef QUADMAP_TEST_OPENNI2
  /** The images with each pixel twice in both directions. */
  static TestCamera enlarged(const TestCamera& small)
  {
    TestCamera large = small;
    large.width *= 2;
    large.height *= 2;
    large.images.clear();
    const auto append = [&](const std::uint8_t* image, int bytes)
    {
      for (int v = 0; v < large.height; ++v)
        for (int u = 0; u < large.width; ++u)
        {
          const auto* pixel = image + bytes * (v / 2 * small.width + u / 2);
          large.images.insert(large.images.end(), pixel, pixel + bytes);
        }
    };
    for (int i = 0; i < small.frames; ++i)
    {
      append(small.depth(i), 2);
      append(small.color(i), 3);
    }
    return large;
  }
#endif

  /** A camera for OpenNI2 that ends each run by Ctrl-C, and its recording desk.oni. */
  void plugCamera() const
  {
#ifdef QUADMAP_TEST_OPENNI2
    TestCamera camera = enlarged(cameraOf(QUADMAP_SOURCE_DIR "/rawlogs/home.rawlog", 10));
    camera.fps = 30;
    camera.save(folder.path("plugged"));
    const auto recorded = run("record-oni desk.oni 10");
    if (recorded.status != 0) throw std::runtime_error("record-oni: " + recorded.err);
    camera.interruptAfter = 20;
    camera.save(folder.path("plugged"));
#endif
  }

  TinyDetector tiny_;
};

}  // namespace quadmap
