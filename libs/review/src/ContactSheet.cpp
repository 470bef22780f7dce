#include "quadmap/review/ContactSheet.h"

#include <mrpt/img/CImage.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "quadmap/obs/DoubtfulObject.h"
#include "quadmap/review/SceneRenderer.h"

namespace quadmap
{
namespace
{
constexpr int kField = 200,
              kTextHeight = 24;  // of an object: side of its image, text below it [px]
constexpr double kAround =
    0.15;  // of a box that is shown around it, on each side / its longer side

constexpr int kCaptionFont = cv::FONT_HERSHEY_SIMPLEX,
              kCaptionMargin = 4;  // on each side of the text [px]
constexpr double kCaptionScale = 0.5;
const cv::Scalar kSure = cv::Scalar::all(30), kDoubt(0, 106, 154);  // of text; that of pages (BGR)

struct View
{
  const PageKeyframe* keyframe = nullptr;
  const PageBox* box = nullptr;
  double worth = 0;
};

/** The area of a box [px^2]; boxes that were measured completely come before all others. */
double worthOf(const PageBox& box)
{
  constexpr double kFirst = 1e9;
  const double area = std::max(0.0, box.box.width()) * std::max(0.0, box.box.height());
  return area + (box.kind == "complete" ? kFirst : 0.0);
}

View bestView(const PageContent& content, const std::string& id)
{
  View best;
  for (const PageKeyframe& keyframe : content.keyframes)
    for (const PageBox& box : keyframe.boxes)
      if (!keyframe.jpeg.empty() && box.object && std::to_string(*box.object) == id &&
          worthOf(box) > best.worth)
        best = {&keyframe, &box, worthOf(box)};
  return best;
}

/** The part of the image around the box, as large as fits into the field. */
cv::Mat cutOut(const View& view)
{
  const std::string& jpeg = view.keyframe->jpeg;
  const cv::Mat image = cv::imdecode(std::vector<char>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
  if (image.empty()) return {};
  const double reduced = static_cast<double>(image.cols) / view.keyframe->width;
  const ImageBox& b = view.box->box;
  const double margin = kAround * std::max(b.width(), b.height());
  const cv::Point low(cvRound(reduced * (b.x1 - margin)), cvRound(reduced * (b.y1 - margin)));
  const cv::Point high(cvRound(reduced * (b.x2 + margin)), cvRound(reduced * (b.y2 + margin)));
  const cv::Rect part = cv::Rect(low, high) & cv::Rect(0, 0, image.cols, image.rows);
  if (part.empty()) return {};
  cv::Mat cut;
  const double scale = static_cast<double>(kField) / std::max(part.width, part.height);
  cv::resize(image(part), cut, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return cut;
}

/** Label, id and mark of an object; of a label that is too long for the field, its beginning. */
std::string captionOf(const ObjectRecord& record)
{
  const std::string end = " " + record.id + (isDoubtful(record) ? " ?" : "");
  const auto fits = [&](const std::string& label)
  {
    const cv::Size size = cv::getTextSize(label + end, kCaptionFont, kCaptionScale, 1, nullptr);
    return size.width <= kField - 2 * kCaptionMargin;
  };
  if (fits(record.label)) return record.label + end;
  std::size_t length = 0;
  while (length < record.label.size() && fits(record.label.substr(0, length + 1) + "..")) ++length;
  return record.label.substr(0, length) + ".." + end;
}

void drawField(const PageContent& content, const PageObject& object, cv::Mat field)
{
  const View view = bestView(content, object.record.id);
  const cv::Mat cut = view.box ? cutOut(view) : cv::Mat();
  const cv::Rect square(0, 0, kField, kField);
  if (cut.empty())
    field(square).setTo(cv::Scalar::all(200));
  else
  {
    const cv::Rect place((kField - cut.cols) / 2, (kField - cut.rows) / 2, cut.cols, cut.rows);
    cut(cv::Rect(0, 0, (place & square).width, (place & square).height))
        .copyTo(field(place & square));
  }
  cv::putText(
      field, captionOf(object.record), {kCaptionMargin, kField + 17}, kCaptionFont, kCaptionScale,
      isDoubtful(object.record) ? kDoubt : kSure, 1, cv::LINE_AA);
}

}  // namespace

void writeContactSheet(const PageContent& content, const std::string& path)
{
  std::vector<const PageObject*> shown;
  for (const PageObject& object : content.objects)
    if (object.confirmed) shown.push_back(&object);
  const int count = std::max(1, static_cast<int>(shown.size()));
  const int columns = static_cast<int>(std::ceil(std::sqrt(1.3 * count)));
  const int rows = (count + columns - 1) / columns;
  constexpr int kGap = 8;  // [px]
  const cv::Size step(kField + kGap, kField + kTextHeight + kGap);
  cv::Mat sheet(
      rows * step.height + kGap, columns * step.width + kGap, CV_8UC3, cv::Scalar::all(255));
  for (int i = 0; i < static_cast<int>(shown.size()); ++i)
  {
    const cv::Point corner(kGap + i % columns * step.width, kGap + i / columns * step.height);
    const cv::Rect place(corner, cv::Size(kField, kField + kTextHeight));
    drawField(content, *shown[static_cast<std::size_t>(i)], sheet(place));
  }
  writePicture(mrpt::img::CImage(sheet, mrpt::img::SHALLOW_COPY), path);
}

}  // namespace quadmap
