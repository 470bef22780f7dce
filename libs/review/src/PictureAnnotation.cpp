#include "quadmap/review/PictureAnnotation.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "LabelLayout.h"
#include "SceneColors.h"
#include "quadmap/obs/DoubtfulObject.h"
#include "quadmap/obs/LabelColor.h"

namespace quadmap
{
namespace
{
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kLetterHeight = 0.022;  // / height of the picture
constexpr double kSmallestLetter = 8;    // [px]

cv::Scalar bgr(const mrpt::img::TColor& c) { return {double(c.B), double(c.G), double(c.R)}; }

/** A picture, and how things are written on it. */
class Sheet
{
 public:
  Sheet(const RenderCamera& camera, cv::Mat& picture) :
      camera_(camera),
      picture_(picture),
      letter_(std::max(kSmallestLetter, kLetterHeight * picture.rows)),
      thickness_(letter_ > 14 ? 2 : 1),
      scale_(cv::getFontScaleFromHeight(kFont, cvRound(letter_), thickness_))
  {
  }

  const RenderCamera& camera() const { return camera_; }
  double letter() const { return letter_; }  //!< Height of a letter [px]
  int width() const { return picture_.cols; }
  int height() const { return picture_.rows; }
  int plateWidth(const std::string& text) const
  {
    return cv::getTextSize(text, kFont, scale_, thickness_, nullptr).width + cvRound(letter_);
  }
  int plateHeight() const { return cvRound(1.7 * letter_); }

  /** Pixels per metre at the distance of the camera's target. */
  double pixelsPerMetre() const
  {
    return height() / (2 * std::tan(0.5 * camera_.verticalFov) * camera_.distance);
  }

  /** Where a point of the map is, or nothing behind the eye. */
  std::optional<cv::Point2d> pixelOf(const Eigen::Vector3d& p_map) const
  {
    const Eigen::Vector3d p = camera_.axes().transpose() * (p_map - camera_.eye());
    if (p.z() >= 0) return std::nullopt;
    const double focal = 0.5 * height() / std::tan(0.5 * camera_.verticalFov);
    return cv::Point2d(
        0.5 * width() - focal * p.x() / p.z(), 0.5 * height() + focal * p.y() / p.z());
  }

  /** A text on a white ground. */
  void plate(const cv::Rect& place, const std::string& text, const cv::Scalar& color)
  {
    const cv::Rect visible = place & cv::Rect(0, 0, width(), height());
    if (visible.empty()) return;
    cv::Mat ground = picture_(visible);
    cv::addWeighted(
        ground, 0.15, cv::Mat(ground.size(), ground.type(), cv::Scalar::all(255)), 0.85, 0, ground);
    const cv::Point start(place.x + cvRound(0.5 * letter_), place.y + cvRound(1.3 * letter_));
    cv::putText(picture_, text, start, kFont, scale_, color, thickness_, cv::LINE_AA);
  }

  void line(const cv::Point2d& a, const cv::Point2d& b, const cv::Scalar& color)
  {
    cv::line(picture_, a, b, color, std::max(2, cvRound(0.15 * letter_)), cv::LINE_AA);
  }

 private:
  const RenderCamera& camera_;
  cv::Mat& picture_;
  double letter_;
  int thickness_;
  double scale_;
};

struct Label
{
  std::string text;
  cv::Scalar color;
  Eigen::Vector3d top;  //!< Point of the map above which it stands
};

std::vector<Label> labelsOf(const SceneContent& content)
{
  const cv::Scalar kWrong(30, 20, 200), kMissed(40, 40, 40);
  std::vector<Label> labels;
  for (const ObjectRecord& record : content.objects)
  {
    std::string text = record.label + " " + record.id;
    if (isDoubtful(record)) text += " ?";
    const bool isPhantom = content.phantoms.count(record.id) > 0;
    if (isPhantom) text += " phantom";
    labels.push_back({text, isPhantom ? kWrong : bgr(labelColor(record.label)), topOf(record)});
  }
  for (const ObjectRecord& record : content.truth)
    if (content.missed.count(record.id) > 0)
      labels.push_back({"missed " + record.label, kMissed, topOf(record)});
  return labels;
}

/** The nearest place above or below the anchor that is free, or the anchor itself. */
cv::Rect freePlace(
    const cv::Point2d& anchor,
    const cv::Size& size,
    const Sheet& sheet,
    const std::vector<cv::Rect>& taken)
{
  constexpr int kPlaces = 40;
  const auto at = [&](double y)
  {
    const double x = std::clamp(
        anchor.x - 0.5 * size.width, 0.0, std::max(0.0, double(sheet.width() - size.width)));
    y = std::clamp(y, 0.0, std::max(0.0, double(sheet.height() - size.height)));
    return cv::Rect(cv::Point(cvRound(x), cvRound(y)), size);
  };
  for (int i = 0; i < kPlaces; ++i)
  {
    const int step = (i + 1) / 2 * (i % 2 == 1 ? -1 : 1);
    const cv::Rect place = at(anchor.y + (step * 0.55 - 1.1) * size.height);
    const auto overlaps = [&](const cv::Rect& other) { return (place & other).area() > 0; };
    if (std::none_of(taken.begin(), taken.end(), overlaps)) return place;
  }
  return at(anchor.y - size.height);
}

/** A line from a plate to what it names, where the two are so far apart that one may wonder. */
void tie(const cv::Rect& place, const cv::Point2d& anchor, const cv::Scalar& color, Sheet& sheet)
{
  const cv::Point2d edge(
      std::clamp(anchor.x, double(place.x), double(place.br().x)),
      std::clamp(anchor.y, double(place.y), double(place.br().y)));
  if (cv::norm(anchor - edge) > 0.5 * place.height) sheet.line(edge, anchor, color);
}

/** The lines come first, so that they pass behind all plates. */
void writeLabels(const SceneContent& content, Sheet& sheet, std::vector<cv::Rect> taken)
{
  std::vector<std::pair<Label, cv::Rect>> placed;
  for (const Label& label : labelsOf(content))
  {
    const auto anchor = sheet.pixelOf(label.top);
    if (!anchor) continue;
    const cv::Size size(sheet.plateWidth(label.text), sheet.plateHeight());
    taken.push_back(freePlace(*anchor, size, sheet, taken));
    tie(taken.back(), *anchor, label.color, sheet);
    placed.emplace_back(label, taken.back());
  }
  for (const auto& [label, place] : placed) sheet.plate(place, label.text, label.color);
}

/** In the upper left corner. \return Where it is. */
cv::Rect writeLegend(const SceneContent& content, Sheet& sheet)
{
  std::vector<std::pair<std::string, cv::Scalar>> rows;
  if (content.trajectory.size() > 1) rows.emplace_back("trajectory", bgr(kTrajectoryColor));
  if (content.odometryDiffers()) rows.emplace_back("odometry", bgr(kOdometryColor));
  if (!content.truth.empty()) rows.emplace_back("truth", bgr(kTruthColor));
  const int sample = cvRound(2.5 * sheet.letter());
  int width = 0, y = 0;
  for (const auto& [text, color] : rows)
  {
    const cv::Rect place(
        sample + cvRound(sheet.letter()), y, sheet.plateWidth(text), sheet.plateHeight());
    sheet.plate(place, text, cv::Scalar::all(40));
    const double middle = y + 0.5 * sheet.plateHeight();
    sheet.line({0.7 * sheet.letter(), middle}, {0.7 * sheet.letter() + sample, middle}, color);
    width = std::max(width, place.br().x);
    y += place.height;
  }
  return {0, 0, width, y};
}

/** In the lower right corner, at most a fifth of the picture long. */
cv::Rect writeScaleBar(Sheet& sheet)
{
  double length = 0.01;  // [m]
  for (const double round : {0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0})
    if (round * sheet.pixelsPerMetre() < 0.2 * sheet.width()) length = round;
  const double letter = sheet.letter(), pixels = length * sheet.pixelsPerMetre();
  const cv::Scalar ink = cv::Scalar::all(40);
  const cv::Point2d right(sheet.width() - 1.5 * letter, sheet.height() - 1.2 * letter);
  const cv::Point2d left = right - cv::Point2d(pixels, 0), tick(0, 0.4 * letter);
  sheet.line(left, right, ink);
  sheet.line(left - tick, left + tick, ink);
  sheet.line(right - tick, right + tick, ink);
  const std::string text = mrpt::format("%g m", length);
  const cv::Size size(sheet.plateWidth(text), sheet.plateHeight());
  const cv::Point2d corner =
      0.5 * (left + right) - cv::Point2d(0.5 * size.width, size.height + 0.5 * letter);
  sheet.plate(cv::Rect(corner, size), text, ink);
  return {cv::Point(cvRound(left.x), cvRound(corner.y)), cv::Point(sheet.width(), sheet.height())};
}

/** In the lower left corner: x red, y green, z blue. */
cv::Rect writeAxes(Sheet& sheet)
{
  const double letter = sheet.letter();
  const cv::Point2d origin(3.5 * letter, sheet.height() - 3.5 * letter);
  const Eigen::Matrix3d axes = sheet.camera().axes();
  const std::array<cv::Scalar, 3> colors = {
      cv::Scalar(30, 20, 200), cv::Scalar(30, 130, 20), cv::Scalar(200, 80, 20)};
  constexpr double kVisible = 0.2;  // share of an axis's length below which it points at the eye
  for (int i = 0; i < 3; ++i)
  {
    const cv::Point2d direction(axes(i, 0), -axes(i, 1));
    if (cv::norm(direction) < kVisible) continue;
    const auto index = static_cast<std::size_t>(i);
    sheet.line(origin, origin + 2 * letter * direction, colors[index]);
    const std::string name(1, "xyz"[i]);
    const cv::Size size(sheet.plateWidth(name), sheet.plateHeight());
    const cv::Point2d middle = origin + 2.8 * letter * direction;
    const cv::Rect place(middle - cv::Point2d(0.5 * size.width, 0.5 * size.height), size);
    sheet.plate(place, name, colors[index]);
  }
  const int side = cvRound(7 * letter);
  return {0, sheet.height() - side, side, side};
}

}  // namespace

void annotatePicture(
    const SceneContent& content, const RenderCamera& camera, mrpt::img::CImage& picture)
{
  Sheet sheet(camera, picture.asCvMatRef());
  const std::vector<cv::Rect> taken = {
      writeLegend(content, sheet), writeScaleBar(sheet), writeAxes(sheet)};
  writeLabels(content, sheet, taken);
}

}  // namespace quadmap
