#pragma once

#include <mrpt/core/format.h>
#include <mrpt/poses/CPose3D.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "../obs/TemporaryFolder.h"

namespace quadmap
{
/** The same few frames in the form of each download that the pages on importing speak of. */
class Downloads
{
 public:
  static constexpr int kFrames = 6;

  explicit Downloads(const TemporaryFolder& folder) : folder_(folder)
  {
    for (const char* sub :
         {"TUM/rgb", "TUM/depth", "ICL/rgb", "ICL/depth", "7/", "SCAN/color", "SCAN/depth",
          "SCAN/pose", "SCAN/intrinsic", "PCD/"})
      std::filesystem::create_directories(path(sub));
    for (const char* camera : {"color", "depth"})
      write(
          std::string("SCAN/intrinsic/intrinsic_") + camera + ".txt",
          "525 0 319.5 0\n0 525 239.5 0\n0 0 1 0\n0 0 0 1\n");
  }

  /** \param depth In millimetres. \param trajectory The pose as "tx ty tz qx qy qz qw". */
  void add(
      int i,
      const cv::Mat& color,
      const cv::Mat& depth,
      const mrpt::poses::CPose3D& T_world_optical,
      const std::string& trajectory)
  {
    const cv::Mat large = enlarged(color), raw = enlarged(depth);
    const cv::Mat fifths = 5 * raw;  // 5000 a metre
    const std::string number = std::to_string(i), time = mrpt::format("%.6f", 1000 + i / 30.0),
                      frame = mrpt::format("7/frame-%06d.", i);
    for (const std::string& name : {"TUM/@/" + time + ".png", "ICL/@/" + number + ".png"})
    {
      cv::imwrite(path(with(name, "rgb")), large);
      cv::imwrite(path(with(name, "depth")), fifths);
    }
    rgb_ += time + " rgb/" + time + ".png\n";
    depth_ += time + " depth/" + time + ".png\n";
    truth_ += time + " " + trajectory + "\n";
    pairs_ += number + " depth/" + number + ".png " + number + " rgb/" + number + ".png\n";
    icl_ += number + " " + trajectory + "\n";
    cv::imwrite(path(frame + "color.png"), large);
    cv::imwrite(path(frame + "depth.png"), raw);
    cv::imwrite(path("SCAN/color/" + number + ".jpg"), large);
    cv::imwrite(path("SCAN/depth/" + number + ".png"), raw);
    const std::string pose = matrix(T_world_optical);
    for (const std::string& file :
         {frame + "pose.txt", "SCAN/pose/" + number + ".txt", "PCD/" + number + ".txt"})
      write(file, pose);
    writeCloud("PCD/" + number + ".pcd", color, depth);
  }

  void finish() const
  {
    write("TUM/rgb.txt", rgb_);
    write("TUM/depth.txt", depth_);
    write("TUM/groundtruth.txt", truth_);
    write("ICL/associations.txt", pairs_);
    write("ICL/livingRoom0.gt.freiburg", icl_);
  }

 private:
  /** The place of a file; the kinds stand for the names in the pages. */
  std::string path(const std::string& name) const
  {
    const std::size_t slash = name.find('/');
    const std::string kind = name.substr(0, slash);
    const std::string place = kind == "TUM"    ? "rgbd_dataset_freiburg3_long_office_household"
                              : kind == "ICL"  ? "living_room_traj0_frei_png"
                              : kind == "7"    ? "redkitchen/seq-01"
                              : kind == "SCAN" ? "scene0000_00"
                                               : "my_clouds";
    return folder_.path(place + name.substr(slash));
  }
  void write(const std::string& name, const std::string& text) const
  {
    std::ofstream(path(name)) << text;
  }
  static std::string with(std::string name, const std::string& image)
  {
    return name.replace(name.find('@'), 1, image);
  }
  static cv::Mat enlarged(const cv::Mat& image)
  {
    cv::Mat out;
    cv::resize(image, out, {640, 480}, 0, 0, cv::INTER_NEAREST);
    return out;
  }
  static std::string matrix(const mrpt::poses::CPose3D& pose)
  {
    std::string text;
    const auto T = pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
    for (int row = 0; row < 4; ++row)
      text += mrpt::format("%.9f %.9f %.9f %.9f\n", T(row, 0), T(row, 1), T(row, 2), T(row, 3));
    return text;
  }

  /** An organised cloud, as PCL writes it. */
  void writeCloud(const std::string& name, const cv::Mat& color, const cv::Mat& depth) const
  {
    std::ofstream file(path(name), std::ios::binary);
    file << "VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH "
         << depth.cols << "\nHEIGHT " << depth.rows << "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS "
         << depth.total() << "\nDATA binary\n";
    const float focal = 525.0F * static_cast<float>(depth.cols) / 640;
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u)
      {
        const auto value = depth.at<std::uint16_t>(v, u);
        const float z = value > 0 ? 0.001F * static_cast<float>(value)
                                  : std::numeric_limits<float>::quiet_NaN();
        const auto fromMiddle = [](int pixel, int pixels)
        { return static_cast<float>(pixel) - 0.5F * static_cast<float>(pixels - 1); };
        float point[4] = {
            fromMiddle(u, depth.cols) * z / focal, fromMiddle(v, depth.rows) * z / focal, z, 0};
        const auto& bgr = color.at<cv::Vec3b>(v, u);
        const std::uint32_t packed =
            (std::uint32_t{bgr[2]} << 16) | (std::uint32_t{bgr[1]} << 8) | std::uint32_t{bgr[0]};
        std::memcpy(point + 3, &packed, sizeof packed);
        file.write(reinterpret_cast<const char*>(point), sizeof point);
      }
  }

  const TemporaryFolder& folder_;
  std::string rgb_, depth_, truth_, pairs_, icl_;
};

}  // namespace quadmap
