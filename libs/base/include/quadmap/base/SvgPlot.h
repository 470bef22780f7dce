#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

namespace quadmap
{
/** A diagram as an SVG file, with axes, ticks, units, lines, areas, bars and a legend. The axes
 * cover what is drawn. The axis of y begins at zero, except in maps. The same calls give the same
 * bytes. */
class SvgPlot
{
 public:
  struct Labels
  {
    std::string title, x, y;  //!< Those of x and y have units
  };
  struct Style
  {
    std::string color = "#1f77b4";  //!< A colour of CSS
    double width = 1.5;             //!< [px]
    bool dashed = false;
    double fill = 0;  //!< Opacity of the inside of areas, in [0, 1]
  };

  /** \param equalScales A metre is equally long on both axes, as in a map. */
  explicit SvgPlot(Labels labels, bool equalScales = false);

  /** Adds a line. \param legend Name in the legend, or empty for none. A name that the legend
   * already has is not repeated. */
  void addLine(
      const std::vector<Eigen::Vector2d>& points, const Style& style, const std::string& legend);
  /** Adds a closed line. */
  void addArea(
      const std::vector<Eigen::Vector2d>& corners, const Style& style, const std::string& legend);
  /** Adds a bar from 0 to `height` with its middle at `x`. */
  void addBar(double x, double width, double height, const Style& style, const std::string& legend);
  /** Adds a text, which gives way upwards or downwards to those added before. */
  void addText(const Eigen::Vector2d& center, const std::string& text);

  /** Sets names in place of numbers along x. The i-th name is at x = i. */
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
  /** Transformation from the plot's units to pixels. */
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

/** About `count` round numbers within [low, high]. Their distance is 1, 2 or 5 times a power of
 * ten.
 */
std::vector<double> roundTicks(double low, double high, int count);

}  // namespace quadmap
