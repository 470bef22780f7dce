#include "quadmap/evaluation/SelfCheck.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "quadmap/evaluation/EvaluationReport.h"

using namespace quadmap;

namespace
{
SelfCheck sampleCheck()
{
  SelfCheckedObject seen, hidden;
  seen.id = "3";
  seen.label = "chair";
  seen.points = 100;
  seen.onSurface = 0.5;
  seen.inside = 0.4;
  seen.beyond = 0.1;
  seen.rays = 40;
  seen.through = 0.25;
  hidden.id = "hidden";
  hidden.label = "tv";
  return {
      {seen, hidden}
  };
}
}  // namespace

TEST(SelfCheck, MeansAreOverTheObjectsThatHaveTheFigure)
{
  EXPECT_EQ(*sampleCheck().meanOnSurface(), 0.5);
  EXPECT_EQ(*sampleCheck().meanThrough(), 0.25);
  EXPECT_FALSE(SelfCheck().meanInside());
}

TEST(SelfCheck, IsInTheReportWhenItWasAskedFor)
{
  EvaluationReport report;
  EXPECT_FALSE(nlohmann::json::parse(toJson(report)).contains("self"));
  EXPECT_EQ(toTable(report).find("surface"), std::string::npos);

  report.self = sampleCheck();
  const auto self = nlohmann::json::parse(toJson(report)).at("self");
  EXPECT_EQ(self.at("inside"), 0.4);
  const auto& chair = self.at("objects").at(0);
  EXPECT_EQ(chair.at("id"), 3);
  EXPECT_EQ(chair.at("points"), 100);
  EXPECT_EQ(chair.at("on_surface"), 0.5);
  EXPECT_EQ(chair.at("beyond"), 0.1);
  EXPECT_EQ(chair.at("rays"), 40);
  EXPECT_EQ(chair.at("through"), 0.25);
  const auto& tv = self.at("objects").at(1);
  EXPECT_EQ(tv.at("id"), "hidden");
  EXPECT_TRUE(tv.at("on_surface").is_null() && tv.at("through").is_null());

  const std::string table = toTable(report);
  EXPECT_NE(table.find("50.0      40.0      10.0      25.0"), std::string::npos) << table;
}
