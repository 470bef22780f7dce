#include "quadmap/review/ContactSheet.h"

#include <gtest/gtest.h>

#include "../obs/TemporaryFolder.h"
#include "SamplePage.h"

using namespace quadmap;

TEST(ContactSheet, ShowsConfirmedObjectsInTheirLargestBox)
{
  PageContent page = quadmap::testing::samplePage();  // objects 2 and 3 are confirmed, 3 has no box
  PageKeyframe& best = page.keyframes[1];
  best.jpeg = quadmap::testing::jpegOf(cv::Mat(60, 80, CV_8UC3, cv::Scalar(200, 30, 20)));
  best.boxes[0].box = {10, 10, 140, 100};  // the blue image has the largest box of object 2
  const TemporaryFolder folder;
  writeContactSheet(page, folder.path("sheet.png"));
  const cv::Mat sheet = cv::imread(folder.path("sheet.png"));
  ASSERT_FALSE(sheet.empty());
  const cv::Vec3b first = sheet.at<cv::Vec3b>(108, 108), second = sheet.at<cv::Vec3b>(108, 316);
  EXPECT_GT(first[0], 150) << "blue";
  EXPECT_LT(first[2], 60);
  EXPECT_EQ(second, cv::Vec3b(200, 200, 200)) << "no image of it";
  EXPECT_EQ(sheet.cols, 2 * 208 + 8);
  EXPECT_EQ(sheet.rows, 232 + 8) << "the first object is not confirmed";
}

TEST(ContactSheet, MarksDoubtfulObjects)
{
  PageContent page = quadmap::testing::samplePage();
  page.objects[1].record.existence = 0.85;
  const TemporaryFolder folder;
  writeContactSheet(page, folder.path("sheet.png"));
  const cv::Mat sheet = cv::imread(folder.path("sheet.png"));
  const auto isColoured = [&](int column)  // the text below a field; else it is grey
  {
    const cv::Mat text = sheet(cv::Rect(8 + 208 * column, 208, 200, 24));
    return std::any_of(
        text.begin<cv::Vec3b>(), text.end<cv::Vec3b>(),
        [](const cv::Vec3b& pixel) { return pixel[2] > pixel[0] + 60; });
  };
  EXPECT_TRUE(isColoured(0));
  EXPECT_FALSE(isColoured(1)) << "0.98";
}

TEST(ContactSheet, ShowsTheIdBehindALongLabel)
{
  const auto textOf = [](const std::string& id)
  {
    PageContent page = quadmap::testing::samplePage();
    page.objects[1].record.label = std::string(60, 'w');
    page.objects[1].record.id = id;
    const TemporaryFolder folder;
    writeContactSheet(page, folder.path("sheet.png"));
    return cv::Mat(cv::imread(folder.path("sheet.png")), cv::Rect(8, 208, 200, 24)).clone();
  };
  EXPECT_GT(cv::norm(textOf("2"), textOf("7"), cv::NORM_INF), 100);
  cv::Mat inverse;
  cv::bitwise_not(textOf("2").colRange(197, 200), inverse);
  EXPECT_EQ(cv::norm(inverse, cv::NORM_INF), 0) << "nothing is cut off at the right";
}

TEST(ContactSheet, MayBeEmpty)
{
  const TemporaryFolder folder;
  writeContactSheet({}, folder.path("sheet.png"));
  EXPECT_FALSE(cv::imread(folder.path("sheet.png")).empty());
}
