#include "quadmap/base/SvgPlot.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <regex>

using namespace quadmap;

namespace
{
/** The points of the n-th polyline or polygon [px]. */
std::vector<Eigen::Vector2d> pointsOf(const std::string& svg, std::size_t n)
{
  const std::string key = " points=\"";
  std::size_t at = 0;
  for (std::size_t i = 0; i <= n; ++i) at = svg.find(key, at) + key.size();
  std::vector<Eigen::Vector2d> points;
  double x = 0, y = 0;
  int length = 0;
  while (std::sscanf(svg.c_str() + at, "%lf,%lf %n", &x, &y, &length) == 2)
  {
    points.emplace_back(x, y);
    at += static_cast<std::size_t>(length);
  }
  return points;
}

std::size_t countOf(const std::string& text, const std::string& part)
{
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}
}  // namespace

TEST(RoundTicks, AreRoundAndWithinTheRange)
{
  EXPECT_EQ(roundTicks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(roundTicks(-1.2, 1.2, 4), (std::vector<double>{-1, 0, 1}));
  const auto small = roundTicks(0.0012, 0.0038, 3);
  ASSERT_EQ(small.size(), 2u);
  EXPECT_NEAR(small[0], 0.002, 1e-12);
  EXPECT_NEAR(small[1], 0.003, 1e-12);
  EXPECT_EQ(roundTicks(3, 3, 5), std::vector<double>{3}) << "no range";
}

TEST(SvgPlot, PutsLargerValuesToTheRightAndUpwards)
{
  SvgPlot plot({"title", "x", "y"});
  plot.addLine(
      {
          { 0, 0},
          {10, 5},
          {20, 1}
  },
      {}, "line");
  const auto p = pointsOf(plot.toSvg(), 0);
  ASSERT_EQ(p.size(), 3u);
  EXPECT_NEAR(p[1].x() - p[0].x(), p[2].x() - p[1].x(), 0.11) << "rounded to 0.1 px";
  EXPECT_GT(p[0].y(), p[2].y());
  EXPECT_GT(p[2].y(), p[1].y());
  EXPECT_NEAR((p[0].y() - p[1].y()) / (p[0].y() - p[2].y()), 5, 0.05);
}

TEST(SvgPlot, AMapHasOneScaleAndKeepsSquares)
{
  SvgPlot plot({"map", "x [m]", "y [m]"}, true);
  plot.addLine(
      {
          {0, 0},
          {8, 3}
  },
      {}, "");
  plot.addArea(
      {
          {1, 1},
          {2, 1},
          {2, 2},
          {1, 2}
  },
      {}, "");
  const auto square = pointsOf(plot.toSvg(), 1);
  ASSERT_EQ(square.size(), 4u);
  EXPECT_NEAR(square[1].x() - square[0].x(), square[1].y() - square[2].y(), 0.21);
}

TEST(SvgPlot, BarsStandOnTheAxis)
{
  SvgPlot plot({"bars", "", "m"});
  plot.setNamesOfX({"cup", "chair"});
  plot.addBar(0, 0.5, 2, {}, "rgbd");
  plot.addBar(1, 0.5, 1, {}, "rgbd");
  const std::string svg = plot.toSvg();
  const auto high = pointsOf(svg, 0), low = pointsOf(svg, 1);
  EXPECT_NEAR(high[0].y(), low[0].y(), 0.01);
  EXPECT_NEAR((high[0].y() - high[2].y()) / (low[0].y() - low[2].y()), 2, 0.01);
  std::smatch frame;
  ASSERT_TRUE(std::regex_search(
      svg, frame,
      std::regex("<rect x=\"[0-9.]+\" y=\"([0-9.]+)\" width=\"[0-9.]+\" height=\"([0-9.]+)\" "
                 "fill=\"none\"")));
  EXPECT_NEAR(std::stod(frame[1]) + std::stod(frame[2]), high[0].y(), 0.11);
  EXPECT_EQ(countOf(svg, ">rgbd<"), 1u) << "once in the legend";
  EXPECT_EQ(countOf(svg, ">chair<"), 1u);
}

TEST(SvgPlot, TextsDoNotLieOverEachOther)
{
  SvgPlot plot({"map", "x", "y"});
  plot.addLine(
      {
          {0, 0},
          {1, 1}
  },
      {}, "");
  for (const char* name : {"table 1", "vase 2", "cup 3"}) plot.addText({0.5, 0.5}, name);
  plot.addText({0.1, 0.5}, "book 4");
  const std::string svg = plot.toSvg();
  std::map<std::string, double> heights;
  const std::regex text("<text x=\"[0-9.]+\" y=\"([0-9.]+)\"[^>]*>([a-z]+ [0-9])<");
  for (std::sregex_iterator i(svg.begin(), svg.end(), text), end; i != end; ++i)
    heights[(*i)[2]] = std::stod((*i)[1]);
  ASSERT_EQ(heights.size(), 4u);
  constexpr double kRow = 12;  // [px]
  EXPECT_NEAR(std::abs(heights["table 1"] - heights["vase 2"]), kRow, 0.11);
  EXPECT_NEAR(std::abs(heights["vase 2"] - heights["cup 3"]), 2 * kRow, 0.11);
  EXPECT_EQ(heights["table 1"], heights["book 4"]) << "far beside, it stays where it belongs";
}

TEST(SvgPlot, EscapesTextAndStaysWellFormed)
{
  SvgPlot plot({"a < b & c", "x", "y"});
  plot.addText({0.5, 0.5}, "<script>");
  const std::string svg = plot.toSvg();
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_EQ(svg.find("<script>"), std::string::npos);
  EXPECT_EQ(countOf(svg, "<text"), countOf(svg, "</text>"));
  EXPECT_EQ(svg.find("nan"), std::string::npos) << "nothing drawn, still a picture";
}

TEST(SvgPlot, TheSameCallsGiveTheSameBytes)
{
  const auto draw = []
  {
    SvgPlot plot({"t", "x", "y"});
    plot.addLine(
        {
            {  0, 1e-9},
            {1e6,   -3}
    },
        {"red", 2, true, 0.5}, "a");
    return plot.toSvg();
  };
  EXPECT_EQ(draw(), draw());
}
