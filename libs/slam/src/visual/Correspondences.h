#pragma once

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <vector>

#include "VisualImage.h"

namespace quadmap
{
/** One thing seen in two images. */
struct Correspondence
{
  Eigen::Vector3d point_from;  //!< In the optical frame of the first image [m]
  Eigen::Vector2d pixel_to;    //!< In the second (working) image [px]
  double depth_to = 0;         //!< There [m]; 0: none
};

/** Corners of an image with depth, spread over it, the strongest first. */
struct Corners
{
  std::vector<cv::Point2f> pixels;
  std::vector<Eigen::Vector3d> points;  //!< Optical frame [m]
};
Corners findCorners(const VisualImage& image, const VisualOdometryOptions& options);

/** Follows the corners of one image into another, which looks much the same.
 * \param T_to_from Where the second image is thought to be. */
std::vector<Correspondence> followCorners(
    const VisualImage& from,
    const Corners& corners,
    const VisualImage& to,
    const Eigen::Isometry3d& T_to_from);

/** ORB descriptors of an image, of the points that have depth or of all. */
struct Descriptors
{
  std::vector<Eigen::Vector2d> pixels;  //!< In the working image
  cv::Mat rows;
};
Descriptors describe(const VisualImage& image);

/** Pairs what looks alike, wherever it is: for views far from each other. */
std::vector<Correspondence> matchDescriptors(
    const VisualImage& from,
    const Descriptors& descriptorsFrom,
    const VisualImage& to,
    const Descriptors& descriptorsTo);

/** The same when it is known roughly where the second image is: what looks alike near the place
 * where it should be. */
std::vector<Correspondence> matchDescriptorsNear(
    const VisualImage& from,
    const Descriptors& descriptorsFrom,
    const VisualImage& to,
    const Descriptors& descriptorsTo,
    const Eigen::Isometry3d& T_to_from);

}  // namespace quadmap
