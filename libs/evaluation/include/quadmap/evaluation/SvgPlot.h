#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

namespace quadmap
{
/** A diagram as an SVG file: axes with ticks and units, lines, areas, bars, a legend. The ranges of
 * the axes come from what is drawn; that of y begins at zero, but not in maps. The same calls give
 * the same bytes. */
class SvgPlot
{
 public:
  struct Labels
  {
    std::string title, x, y;  //!< x and y with their units
  };
  struct Style
  {
    std::string color = "#1f77b4";  //!< As in CSS
    double width = 1.5;             //!< [px]
    bool dashed = false;
    double fill = 0;  //!< Opacity inside of areas, 0 to 1
  };

  /** \param equalScales One metre is as long on both axes: a map. */
  explicit SvgPlot(Labels labels, bool equalScales = false);

  /** \param legend Name in the legend; empty: none. What has the name of one before is not named
   * again. */
  void addLine(
      const std::vector<Eigen::Vector2d>& points, const Style& style, const std::string& legend);
  /** A closed line. */
  void addArea(
      const std::vector<Eigen::Vector2d>& corners, const Style& style, const std::string& legend);
  /** A bar from 0 to `height` about `x`. */
  void addBar(double x, double width, double height, const Style& style, const std::string& legend);
  void addText(const Eigen::Vector2d& center, const std::string& text);

  /** Names instead of numbers along x: the i-th stands at x = i. */
  void setNamesOfX(std::vector<std::string> names) { namesOfX_ = std::move(names); }

  std::string toSvg() const;

 private:
  struct Shape
  {
    std::vector<Eigen::Vector2d> points;
    Style style;
    bool closed;
  };
  struct Text
  {
    Eigen::Vector2d center;
    std::string text;
  };
  struct LegendEntry
  {
    std::string name;
    Style style;
  };
  /** From the plot's units to pixels. */
  struct View;

  void add(Shape shape, const std::string& legend);
  View view() const;
  std::string frame(const View& view) const;
  std::string xTicks(const View& view) const;
  std::string yTicks(const View& view) const;
  std::string legend() const;

  Labels labels_;
  bool equalScales_;
  std::vector<Shape> shapes_;
  std::vector<Text> texts_;
  std::vector<LegendEntry> legend_;
  std::vector<std::string> namesOfX_;
};

/** Round numbers (1, 2 or 5 times a power of ten apart) within [low, high], about `count`. */
std::vector<double> roundTicks(double low, double high, int count);

}  // namespace quadmap
