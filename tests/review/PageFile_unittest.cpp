#include "quadmap/review/PageFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "../apps/RunProgram.h"
#include "../obs/TemporaryFolder.h"
#include "SamplePage.h"
#include "page/Base64.h"
#include "page/PageData.h"
#include "quadmap/base/Json.h"
#include "quadmap/review/PageKeyframes.h"

using namespace quadmap;
using quadmap::testing::kNastyLabel;
using quadmap::testing::samplePage;

namespace
{
bool hasThree() { return std::filesystem::exists(std::string(kThreeFolder) + "/three.min.js"); }

/** A page in a browser; skipped where there is none. */
class PageInBrowser : public ::testing::Test
{
 protected:
  void SetUp() override
  {
    if (!hasThree()) GTEST_SKIP() << "libjs-three is not installed";
  }

  void check(const std::string& name, const PageContent& content)
  {
    const std::string path = folder_.path("page.html");
    writePage(content, path, kThreeFolder);
    const auto result = runCommand(
        "python3 " QUADMAP_SOURCE_DIR "/tests/review/page/check_page.py " + name + " " + path);
    if (result.status == 77 || result.status == 127)
      GTEST_SKIP() << "chromium or python3 is not installed";
    EXPECT_EQ(result.status, 0) << result.err;
    std::cout << result.out;
  }

  TemporaryFolder folder_;
};

}  // namespace

TEST(Base64, WritesTheExamplesOfTheStandard)  // RFC 4648, section 10
{
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFF\xFE"), "//4=");
}

TEST(PageData, HoldsNoCharacterThatMeansSomethingInHtml)
{
  const std::string text = pageJson(samplePage());
  EXPECT_EQ(text.find_first_of("<>&"), kNotFound);
  for (const char c : text) ASSERT_TRUE(c >= ' ' && c <= '~') << "byte " << static_cast<int>(c);
  const Json json = Json::parse(text);
  EXPECT_EQ(json.at("objects").at(0).at("label"), kNastyLabel) << "it comes back as it was";
  EXPECT_EQ(json.at("keyframes").at(1).at("boxes").at(0).at("object"), "2");
}

TEST(PageData, KeepsThePointsOfTheCloudToHalfAStep)
{
  const Cloud cloud = samplePage().scene.cloud;
  const std::string bytes = pageCloud(cloud);
  ASSERT_EQ(bytes.size(), 12 * cloud.size());
  const Json head = Json::parse(pageJson(samplePage())).at("cloud");
  const double step = head.at("step").get<double>();
  EXPECT_LT(step, 1e-4) << "6 m in 65,535 steps";

  const auto number = [&](std::size_t i)
  {
    return static_cast<unsigned char>(bytes[2 * i]) +
           256 * static_cast<unsigned char>(bytes[2 * i + 1]);
  };
  double sum = 0, expected = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    sum += head.at("origin").at(1).get<double>() + step * number(3 * i + 1);
    expected += static_cast<double>(cloud[i].position.y());
  }
  EXPECT_NEAR(sum, expected, 0.5 * step * static_cast<double>(cloud.size()));
}

TEST(PageData, MakesScriptsSafe)
{
  EXPECT_EQ(safeScript("a = '</script>';", "x.js"), "a = '<\\/script>';");
  EXPECT_NE(errorOf([] { safeScript("if (a<!--b) c();", "x.js"); }).find("x.js"), kNotFound);
  EXPECT_NE(errorOf([] { safeScript("a = '<script>';", "x.js"); }).find("x.js"), kNotFound);
}

TEST(PageImages, KeepToTheirBudget)
{
  auto scan = quadmap::testing::scanOfWall();
  cv::Mat noise(480, 640, CV_8UC3);
  cv::randu(noise, 0, 255);
  scan->intensityImage = mrpt::img::CImage(noise, mrpt::img::DEEP_COPY);
  PageImages few({}, 1), many({}, 1000);
  few.add(*scan, {});
  many.add(*scan, {});
  const PageKeyframe &fine = few.keyframes().front(), &coarse = many.keyframes().front();
  EXPECT_EQ(fine.width, 640u) << "boxes refer to the camera's image";
  EXPECT_LT(coarse.jpeg.size(), fine.jpeg.size());
  const cv::Mat image =
      cv::imdecode(std::vector<char>(coarse.jpeg.begin(), coarse.jpeg.end()), cv::IMREAD_COLOR);
  EXPECT_EQ(image.cols, 320);
}

TEST(PageFile, SaysWhatIsMissing)
{
  const TemporaryFolder folder;
  const std::string error =
      errorOf([&] { writePage(samplePage(), folder.path("p.html"), folder.path("nowhere")); });
  EXPECT_NE(error.find("libjs-three"), kNotFound) << error;
  EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(PageFile, IsBelow30MegabytesWhenLarge)
{
  if (!hasThree()) GTEST_SKIP() << "libjs-three is not installed";
  const TemporaryFolder folder;
  writePage(quadmap::testing::largePage(), folder.path("p.html"), kThreeFolder);
  EXPECT_LT(std::filesystem::file_size(folder.path("p.html")), 30'000'000u);
}

TEST_F(PageInBrowser, LinksTableAndView) { check("links_between_table_and_view", samplePage()); }
TEST_F(PageInBrowser, HidesDoubtfulObjects) { check("doubtful_objects_hide", samplePage()); }
TEST_F(PageInBrowser, LeavesLabelsText) { check("labels_stay_text", samplePage()); }
TEST_F(PageInBrowser, ShowsWhatBecameOfBoxes) { check("keyframes", samplePage()); }
TEST_F(PageInBrowser, KeepsTheViewInItsLink) { check("link_keeps_the_view", samplePage()); }
TEST_F(PageInBrowser, MeasuresDistances) { check("measures", samplePage()); }
TEST_F(PageInBrowser, MarksWhatDiffersFromTheTruth) { check("compares", samplePage()); }
TEST_F(PageInBrowser, EditsWithHandlesAndMerges) { check("handles", samplePage()); }
TEST_F(PageInBrowser, ShowsTheTableWithoutScrollingSideways) { check("table_fits", samplePage()); }
TEST_F(PageInBrowser, FitsATelephone) { check("phone_and_themes", samplePage()); }
TEST_F(PageInBrowser, DrawsOnlyWhenSomethingChanges) { check("rests", samplePage()); }
TEST_F(PageInBrowser, MovesWhenLarge) { check("speed", quadmap::testing::largePage()); }
