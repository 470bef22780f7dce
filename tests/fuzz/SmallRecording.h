#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

#include "../obs/TemporaryFolder.h"
#include "quadmap/folders/FolderKinds.h"
#include "quadmap/sensors/BoxCheck.h"

namespace quadmap
{
/** Takes poses and boxes of all frames, as an import does.
 * \exception std::runtime_error Also for what a folder says of single poses. */
inline void readFrames(const FrameFolder& folder)
{
  for (const auto& problems : {folder.listProblems(), folder.posesProblems()})
    if (!problems.empty()) throw std::runtime_error(problems.front());
  for (std::size_t i = 0; i < folder.frames().size(); ++i)
  {
    const auto& problem = folder.frames()[i].poseProblem;
    if (!problem.empty()) throw std::runtime_error(problem);
    folder.T_world_robot(i);
    if (const auto boxes = folder.boxes(i))
      for (const auto& object : boxes->objects)
        whyUnusable(object.box, object.score, boxes->cameraParams.ncols, boxes->cameraParams.nrows);
  }
}

/** The text files of a recording of three frames, without the images. */
class SmallRecording
{
 public:
  SmallRecording()
  {
    std::filesystem::create_directory(folder_.path("detections"));
    for (const auto& [name, text] : texts_) folder_.write(name, text);
  }

  const std::string& text(const std::string& name) const { return texts_.at(name); }
  const TemporaryFolder& files() const { return folder_; }

  /** Reads the whole recording with one of its files replaced. */
  void readWith(
      const std::string& name,
      const std::string& text,
      const FrameFolderOptions& options = {}) const
  {
    folder_.write(name, text);
    readFrames(openFrameFolder("tum", folder_.folder().string(), options));
  }
  void remove(const std::string& name) const { std::filesystem::remove(folder_.path(name)); }

 private:
  TemporaryFolder folder_;
  const std::map<std::string, std::string> texts_ = {
      {         "rgb.txt","# time file\n1.00 rgb/1.jpg\n1.50 rgb/2.jpg\n2.00 rgb/3.jpg\n"                          },
      {       "depth.txt",             "1.01 depth/1.png\n1.51 depth/2.png\n2.01 depth/3.png\n"},
      {"associations.txt", "1.00 rgb/1.jpg 1.01 depth/1.png\n1.50 rgb/2.jpg 1.51 depth/2.png\n"},
      { "groundtruth.txt",    "0.99 0 0 0 0 0 0 1\n1.03 1 0 0 0 0 0 1\n1.5 2 0 0 0 0.6 0 0.8\n"},
      {"calibration.yaml",
       "%YAML:1.0\n---\nfx: 53.5\nfy: -53.9\ncx: 32.1\ncy: 24.7\nwidth: 64\nheight: 48\n"
       "depth_factor: 5000\nk1: 0.01\nworld_up: !!opencv-matrix\n   rows: 3\n   cols: 1\n"
       "   dt: d\n   data: [ 0.1, -0.9, 0.2 ]\n"                                               },
      {"detections/1.txt",                "56 chair 0.91 1 2 20 30\n41 cup 0.5 30.5 20 33 24\n"},
  };
};

}  // namespace quadmap
