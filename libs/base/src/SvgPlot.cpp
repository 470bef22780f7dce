#include "quadmap/base/SvgPlot.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadmap
{
namespace
{
// All lengths are pixels of the picture.
constexpr double kWidth = 720, kHeight = 420, kMaxMapHeight = 720;
constexpr double kLeft = 64, kRight = 16, kTop = 56, kBottom = 48, kNamesBottom = 96;
constexpr double kLegendY = 44, kLegendLetter = 7, kLegendGap = 34;

std::string escaped(const std::string& text)
{
  std::string out;
  for (const char c : text)
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  return out;
}

std::string textAt(
    const Eigen::Vector2d& p, const std::string& text, const char* anchor, double turn_deg = 0)
{
  const std::string turn =
      turn_deg == 0 ? ""
                    : mrpt::format(" transform=\"rotate(%.0f %.1f %.1f)\"", turn_deg, p.x(), p.y());
  return mrpt::format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"", p.x(), p.y(), anchor) +
         turn + ">" + escaped(text) + "</text>\n";
}

/** Where a text is clear of those before [px]: around p, or as little above or below as can be; p
 * itself when there is no place. */
Eigen::Vector2d clearPlace(
    const Eigen::Vector2d& p, const std::string& text, std::vector<Eigen::AlignedBox2d>& taken)
{
  constexpr double kRow = 12;
  constexpr int kPlaces = 24;
  const Eigen::Vector2d half(0.5 * kLegendLetter * static_cast<double>(text.size()), 0.5 * kRow);
  for (int i = 0; i < kPlaces; ++i)
  {
    const int step = (i + 1) / 2 * (i % 2 == 1 ? 1 : -1);
    const Eigen::Vector2d at = p + Eigen::Vector2d(0, 0.5 * step * kRow);
    const Eigen::AlignedBox2d box(at - half, at + half);
    const auto overlaps = [&](const Eigen::AlignedBox2d& other)
    { return box.intersection(other).sizes().minCoeff() > 0; };
    if (std::any_of(taken.begin(), taken.end(), overlaps)) continue;
    taken.push_back(box);
    return at;
  }
  return p;
}

std::string lineBetween(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const char* color)
{
  return mrpt::format(
      "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\"/>\n", a.x(), a.y(),
      b.x(), b.y(), color);
}

std::string strokeOf(const SvgPlot::Style& style)
{
  return mrpt::format("stroke=\"%s\" stroke-width=\"%.1f\"", style.color.c_str(), style.width) +
         (style.dashed ? " stroke-dasharray=\"5 3\"" : "") +
         (style.fill > 0
              ? mrpt::format(" fill=\"%s\" fill-opacity=\"%.2f\"", style.color.c_str(), style.fill)
              : " fill=\"none\"");
}

/** Number of decimals that tells ticks apart whose distance is `step`. */
int decimalsFor(double step)
{
  return std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
}

std::string tickText(const std::vector<double>& ticks, double value)
{
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1;
  return mrpt::format("%.*f", decimalsFor(step), value);
}
}  // namespace

std::vector<double> roundTicks(double low, double high, int count)
{
  if (!(high > low) || count < 1) return {low};
  const double raw = (high - low) / count;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double multiple : {5.0, 2.0, 1.0})
    if (multiple * power >= raw * (1 - 1e-9)) step = multiple * power;
  std::vector<double> ticks;
  const auto first = static_cast<long>(std::ceil(low / step - 1e-9));
  const auto last = static_cast<long>(std::floor(high / step + 1e-9));
  for (long i = first; i <= last; ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

struct SvgPlot::View
{
  Eigen::Vector2d low, high;  // corners of what is shown, in the plot's units
  Eigen::Vector2d scale;      // [px per unit]
  double height = kHeight;    // height of the picture [px]
  double bottom = kBottom;    // space below the axes [px]

  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const
  {
    return {kLeft + (p.x() - low.x()) * scale.x(), height - bottom - (p.y() - low.y()) * scale.y()};
  }
};

SvgPlot::SvgPlot(Labels labels, bool equalScales) :
    labels_(std::move(labels)), equalScales_(equalScales)
{
}

void SvgPlot::add(Shape shape, const std::string& legend)
{
  const auto same = [&](const LegendEntry& entry) { return entry.name == legend; };
  if (!legend.empty() && std::none_of(legend_.begin(), legend_.end(), same))
    legend_.push_back({legend, shape.style});
  shapes_.push_back(std::move(shape));
}

void SvgPlot::addLine(
    const std::vector<Eigen::Vector2d>& points, const Style& style, const std::string& legend)
{
  add({points, style, false}, legend);
}

void SvgPlot::addArea(
    const std::vector<Eigen::Vector2d>& corners, const Style& style, const std::string& legend)
{
  add({corners, style, true}, legend);
}

void SvgPlot::addBar(
    double x, double width, double height, const Style& style, const std::string& legend)
{
  const double left = x - width / 2, right = x + width / 2;
  addArea(
      {
          { left,      0},
          {right,      0},
          {right, height},
          { left, height}
  },
      style, legend);
}

void SvgPlot::addText(const Eigen::Vector2d& center, const std::string& text)
{
  texts_.push_back({center, text});
}

SvgPlot::View SvgPlot::view() const
{
  View view;
  view.low.setConstant(std::numeric_limits<double>::infinity());
  view.high = -view.low;
  for (const auto& shape : shapes_)
    for (const auto& p : shape.points)
    {
      view.low = view.low.cwiseMin(p);
      view.high = view.high.cwiseMax(p);
    }
  if (!view.low.allFinite() || !view.high.allFinite())
  {
    view.low.setZero();
    view.high.setOnes();
  }
  if (!equalScales_)
    view.low.y() = std::min(view.low.y(), 0.0);  // the axis of errors begins at zero
  for (int i : {0, 1})
    if (view.high[i] - view.low[i] < 1e-9) view.high[i] = view.low[i] + 1;
  const Eigen::Vector2d margin = 0.04 * (view.high - view.low);
  view.high += margin;
  view.low.x() -= margin.x();
  if (equalScales_ || view.low.y() != 0) view.low.y() -= margin.y();  // bars stand on the axis

  if (!namesOfX_.empty()) view.bottom = kNamesBottom;
  const double width = kWidth - kLeft - kRight;
  const Eigen::Vector2d range = view.high - view.low;
  view.scale = {width / range.x(), (kHeight - kTop - view.bottom) / range.y()};
  if (!equalScales_) return view;
  const double scale =
      std::min(width / range.x(), (kMaxMapHeight - kTop - view.bottom) / range.y());
  view.scale.setConstant(scale);
  view.height = kTop + view.bottom + range.y() * scale;
  return view;
}

std::string SvgPlot::xTicks(const View& view) const
{
  std::string out;
  const double y = view.height - view.bottom;
  for (std::size_t i = 0; i < namesOfX_.size(); ++i)
    out += textAt({view({static_cast<double>(i), 0}).x() + 4, y + 14}, namesOfX_[i], "end", -35);
  if (!namesOfX_.empty()) return out;
  const auto ticks = roundTicks(view.low.x(), view.high.x(), 8);
  for (const double tick : ticks)
  {
    const double x = view({tick, 0}).x();
    out += lineBetween({x, kTop}, {x, y}, "#dddddd");
    out += textAt({x, y + 16}, tickText(ticks, tick), "middle");
  }
  return out;
}

std::string SvgPlot::yTicks(const View& view) const
{
  std::string out;
  const double right = view({view.high.x(), 0}).x();
  const auto ticks = roundTicks(view.low.y(), view.high.y(), 6);
  for (const double tick : ticks)
  {
    const double y = view({0, tick}).y();
    out += lineBetween({kLeft, y}, {right, y}, "#dddddd");
    out += textAt({kLeft - 6, y + 4}, tickText(ticks, tick), "end");
  }
  return out;
}

std::string SvgPlot::frame(const View& view) const
{
  const Eigen::Vector2d low = view(view.low), high = view(view.high);
  const double midX = (low.x() + high.x()) / 2, midY = (low.y() + high.y()) / 2;
  return xTicks(view) + yTicks(view) +
         mrpt::format(
             "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" "
             "stroke=\"#444444\"/>\n",
             low.x(), high.y(), high.x() - low.x(), low.y() - high.y()) +
         textAt({midX, 20}, labels_.title, "middle") +
         textAt({midX, view.height - 10}, labels_.x, "middle") +
         textAt({16, midY}, labels_.y, "middle", -90);
}

std::string SvgPlot::legend() const
{
  std::string out;
  double x = kLeft;
  for (const auto& [name, style] : legend_)
  {
    out += mrpt::format(
        "<rect x=\"%.1f\" y=\"%.1f\" width=\"16\" height=\"8\" %s/>\n", x, kLegendY - 9,
        strokeOf(style).c_str());
    out += textAt({x + 22, kLegendY}, name, "start");
    x += kLegendGap + kLegendLetter * static_cast<double>(name.size());
  }
  return out;
}

std::string SvgPlot::toSvg() const
{
  const View v = view();
  std::string out = mrpt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
      "viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\" font-size=\"12\">\n",
      kWidth, v.height, kWidth, v.height);
  out += "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" + frame(v);
  for (const auto& shape : shapes_)
  {
    out += shape.closed ? "<polygon points=\"" : "<polyline points=\"";
    for (const auto& p : shape.points) out += mrpt::format("%.1f,%.1f ", v(p).x(), v(p).y());
    out += "\" " + strokeOf(shape.style) + "/>\n";
  }
  std::vector<Eigen::AlignedBox2d> taken;
  for (const auto& text : texts_)
    out += textAt(clearPlace(v(text.center), text.text, taken), text.text, "middle");
  return out + legend() + "</svg>\n";
}

}  // namespace quadmap
