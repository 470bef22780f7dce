#pragma once

#include <mrpt/core/format.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "../obs/TemporaryFolder.h"

namespace quadmap
{
/** A small recording in the TUM layout. Its frames are 0.1 s apart and have 64x48 pixels. The
 * camera moves along x at 0.5 m/s and sees a wall 2 m ahead. Every image has one box. Tests then
 * spoil single files. */
class SampleRecording
{
 public:
  static constexpr int kFrames = 6;
  static constexpr double kStart = 100.0, kInterval = 0.1;  // [s]

  SampleRecording()
  {
    namespace fs = std::filesystem;
    for (const char* sub : {"rgb", "depth", "detections"}) fs::create_directory(files.path(sub));
    writeCalibration(kCalibration);
    std::string associations, poses;
    for (int i = 0; i < kFrames; ++i)
    {
      writeColor(i, 64, 48);
      writeDepth(i, 10000);
      files.write(boxesFile(i), "56 chair 0.8 10 12 30 40\n");
      associations += line(i, kStart + kInterval * i);
      poses += pose(i, 0.05 * i);
    }
    files.write("associations.txt", associations);
    files.write("groundtruth.txt", poses);
  }

  std::string folder() const { return files.folder().string(); }
  static std::string boxesFile(int i) { return mrpt::format("detections/f%d.txt", i); }

  void writeColor(int i, int columns, int rows) const
  {
    const cv::Mat image(rows, columns, CV_8UC3, cv::Scalar(40, 80, 120));
    cv::imwrite(files.path(mrpt::format("rgb/f%d.png", i)), image);
  }
  /** Writes a depth image. \param value Value of all pixels; 5000 is 1 m. */
  void writeDepth(int i, int value) const
  {
    const cv::Mat image(48, 64, CV_16UC1, cv::Scalar(value));
    cv::imwrite(files.path(mrpt::format("depth/f%d.png", i)), image);
  }
  void writeCalibration(const std::string& text) const
  {
    files.write("calibration.yaml", "%YAML:1.0\n---\n" + text);
  }

  /** Lines of associations.txt and groundtruth.txt, with time [s] and x [m]. */
  static std::string line(int i, double time)
  {
    return mrpt::format("%.4f rgb/f%d.png %.4f depth/f%d.png\n", time, i, time, i);
  }
  static std::string pose(int i, double x)
  {
    return mrpt::format("%.4f %.4f 0 0 0 0 0 1\n", kStart + kInterval * i, x);
  }

  /** world_up is -y, which is up in `optical`. */
  static constexpr const char* kCalibration =
      "fx: 60.0\nfy: 62.0\ncx: 31.5\ncy: 23.5\nwidth: 64\nheight: 48\ndepth_factor: 5000.0\n"
      "world_up: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ 0., -1., 0. ]\n";

  TemporaryFolder files;
};

}  // namespace quadmap
