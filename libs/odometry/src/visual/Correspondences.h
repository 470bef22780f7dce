#pragma once

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <vector>

#include "VisualImage.h"

namespace quadmap
{
/** One point that was found in two images. */
struct Correspondence
{
  Eigen::Vector3d point_from;  //!< In `optical` of the first image [m]
  Eigen::Vector2d pixel_to;    //!< In the second (working) image [px]
  double depth_to = 0;         //!< Depth at this pixel, 0 for none [m]
};

/** Corners of an image that have depth. They are spread over the image, the strongest first. */
struct Corners
{
  std::vector<cv::Point2f> pixels;
  std::vector<Eigen::Vector3d> points;  //!< In `optical` [m]
};
Corners findCorners(const VisualImage& image, const VisualOdometryOptions& options);

/** Follows the corners of one image into another image that looks much the same.
 * \param T_to_from First guess of the motion. */
std::vector<Correspondence> followCorners(
    const VisualImage& from,
    const Corners& corners,
    const VisualImage& to,
    const Eigen::Isometry3d& T_to_from);

/** ORB descriptors of an image, either of all points or of those that have depth. */
struct Descriptors
{
  std::vector<Eigen::Vector2d> pixels;  //!< In the working image
  cv::Mat rows;
};
Descriptors describe(const VisualImage& image);

/** Pairs descriptors that are alike, wherever they are, for images that are far from each other. */
std::vector<Correspondence> matchDescriptors(
    const VisualImage& from,
    const Descriptors& descriptorsFrom,
    const VisualImage& to,
    const Descriptors& descriptorsTo);

/** Pairs descriptors that are alike and near the place where a rough motion puts them. */
std::vector<Correspondence> matchDescriptorsNear(
    const VisualImage& from,
    const Descriptors& descriptorsFrom,
    const VisualImage& to,
    const Descriptors& descriptorsTo,
    const Eigen::Isometry3d& T_to_from);

}  // namespace quadmap
