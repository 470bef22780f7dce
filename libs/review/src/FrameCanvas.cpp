#include "FrameCanvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "quadmap/geometry/Projection.h"

namespace quadmap
{
namespace
{
constexpr double kNear = 0.05;  // nearer parts of cuboids are not drawn [m]
constexpr int kWidth = 1200;    // pictures are about as wide [px]
constexpr int kCanvasFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontScale = 0.5;
constexpr int kRowHeight = 18;  // of a row of text [px of the picture]

/** Bounds of the coordinates that OpenCV can draw [px of the picture]. */
double drawable(double x) { return std::clamp(x, -20000.0, 20000.0); }

/** The part of a line that is in front of the camera, or nothing. */
std::optional<std::array<Eigen::Vector3d, 2>> inFront(Eigen::Vector3d a, Eigen::Vector3d b)
{
  if (a.z() > b.z()) std::swap(a, b);
  if (b.z() <= kNear) return std::nullopt;
  if (a.z() < kNear) a += (kNear - a.z()) / (b.z() - a.z()) * (b - a);
  return std::array<Eigen::Vector3d, 2>{a, b};
}

}  // namespace

FrameCanvas::FrameCanvas(const cv::Mat& bgr, const PinholeCamera& camera) :
    camera_(camera), scale_(std::max(1, cvRound(static_cast<double>(kWidth) / bgr.cols)))
{
  cv::resize(bgr, picture_, {}, scale_, scale_, scale_ > 1 ? cv::INTER_LINEAR : cv::INTER_AREA);
}

/** Pixel centres of the image are in the middle of their squares of the picture. */
cv::Point2d FrameCanvas::onPicture(const Eigen::Vector2d& pixel) const
{
  return {drawable((pixel.x() + 0.5) * scale_), drawable((pixel.y() + 0.5) * scale_)};
}

void FrameCanvas::line(
    const Eigen::Vector2d& a, const Eigen::Vector2d& b, cv::Scalar color, Weight weight)
{
  // Thin lines of dark colours would not show on dark things.
  if (weight == Weight::Thin)
    cv::line(picture_, onPicture(a), onPicture(b), cv::Scalar(0, 0, 0), 3, cv::LINE_AA);
  cv::line(picture_, onPicture(a), onPicture(b), color, static_cast<int>(weight), cv::LINE_AA);
}

void FrameCanvas::textsBelow(const Eigen::Vector2d& at, const Texts& rows)
{
  writeTexts(onPicture(at), rows);
}

void FrameCanvas::textsAbove(const Eigen::Vector2d& at, const Texts& rows)
{
  const auto count =
      std::count_if(rows.begin(), rows.end(), [](const Text& row) { return !row.text.empty(); });
  writeTexts(cv::Point(onPicture(at)) - cv::Point(0, static_cast<int>(count) * kRowHeight), rows);
}

void FrameCanvas::writeTexts(const cv::Point& corner, const Texts& rows)
{
  constexpr int kMargin = 3;
  cv::Rect place(corner, cv::Size(0, 0));
  for (const Text& row : rows)
  {
    if (row.text.empty()) continue;
    const int width = cv::getTextSize(row.text, kCanvasFont, kFontScale, 1, nullptr).width;
    place.width = std::max(place.width, width + 2 * kMargin);
    place.height += kRowHeight;
  }
  if (place.height == 0) return;
  place.x = std::clamp(place.x, 0, std::max(0, picture_.cols - place.width));
  place.y = std::clamp(place.y, 0, std::max(0, picture_.rows - place.height));
  place.y = freeRow(place);
  texts_.push_back(place);
  picture_(place & cv::Rect(0, 0, picture_.cols, picture_.rows)) *= 0.35;
  cv::Point baseline = place.tl() + cv::Point(kMargin, kRowHeight - 5);
  for (const Text& row : rows)
  {
    if (row.text.empty()) continue;
    cv::putText(picture_, row.text, baseline, kCanvasFont, kFontScale, row.color, 1, cv::LINE_AA);
    baseline.y += kRowHeight;
  }
}

/** The upper end of texts, so that they do not lie on earlier ones: rows below are tried. */
int FrameCanvas::freeRow(const cv::Rect& text) const
{
  constexpr int kMostRows = 8;  // farther away nobody knows what it belongs to
  cv::Rect place = text;
  for (int i = 0; i < kMostRows && place.br().y <= picture_.rows; ++i, place.y += kRowHeight)
    if (std::none_of(
            texts_.begin(), texts_.end(),
            [&](const cv::Rect& other) { return (other & place).area() > 0; }))
      return place.y;
  return text.y;
}

void FrameCanvas::tint(const ObjectMask& mask, cv::Scalar color)
{
  auto values = mask.pixels.expanded();
  const cv::Mat pixels(
      static_cast<int>(mask.height), static_cast<int>(mask.width), CV_8U, values.data());
  const cv::Rect place(
      static_cast<int>(mask.x0) * scale_, static_cast<int>(mask.y0) * scale_, pixels.cols * scale_,
      pixels.rows * scale_);
  const cv::Rect inside = place & cv::Rect(0, 0, picture_.cols, picture_.rows);
  if (inside.empty()) return;
  cv::Mat large, mixed;
  cv::resize(pixels, large, place.size(), 0, 0, cv::INTER_NEAREST);
  cv::Mat part = picture_(inside);
  cv::addWeighted(part, 0.65, cv::Mat(part.size(), part.type(), color), 0.35, 0, mixed);
  mixed.copyTo(part, large(inside - place.tl()));
}

void FrameCanvas::cuboid(const Ellipsoid& object_optical, cv::Scalar color)
{
  const auto corners = object_optical.cuboidCorners();
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4})
    {
      if (i & bit) continue;
      const auto edge = inFront(corners.col(i), corners.col(i | bit));
      if (edge) line(camera_.project((*edge)[0]), camera_.project((*edge)[1]), color, Weight::Thin);
    }
}

void FrameCanvas::fillBottom(const Ellipsoid& object_optical, cv::Scalar color)
{
  const auto corners = object_optical.cuboidCorners();
  std::vector<cv::Point> polygon;
  for (const int i : {0, 1, 3, 2})
  {
    if (corners(2, i) < kNear) return;
    polygon.emplace_back(onPicture(camera_.project(corners.col(i))));
  }
  cv::Mat filled = picture_.clone();
  cv::fillConvexPoly(filled, polygon, color);
  cv::addWeighted(picture_, 0.6, filled, 0.4, 0, picture_);
}

std::optional<Eigen::Vector2d> FrameCanvas::outline(
    const Ellipsoid& object_optical, cv::Scalar color)
{
  if (!projectEllipsoidBox(camera_, object_optical)) return std::nullopt;
  // C* = c33 (S - m m^t, -m; -m^t, -1) up to sign, with the centre m and x^t S^-1 x = 1 around it.
  const Eigen::Matrix3d conic = projectDualConic(camera_, object_optical);
  const Eigen::Vector2d m = conic.block<2, 1>(0, 2) / conic(2, 2);
  const Eigen::Matrix2d S = m * m.transpose() - conic.topLeftCorner<2, 2>() / conic(2, 2);
  const Eigen::Matrix2d root = S.llt().matrixL();
  constexpr int kPoints = 72;
  Eigen::Vector2d last = m + root.col(0), top = last;
  for (int i = 1; i <= kPoints; ++i)
  {
    const double angle = 2 * M_PI * i / kPoints;
    const Eigen::Vector2d next = m + root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    line(last, next, color, Weight::Thin);
    if (next.y() < top.y()) top = next;
    last = next;
  }
  return top;
}

}  // namespace quadmap
