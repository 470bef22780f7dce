#pragma once

#include <opencv2/imgcodecs.hpp>
#include <random>

#include "SampleScene.h"
#include "quadmap/review/PageContent.h"

namespace quadmap::testing
{
/** A label that a web page must not believe. U+2028 ends a line of an old script. */
inline const std::string kNastyLabel =
    "</script><script>window.attacked = 1</script><!-- <img src=x onerror=attacked()> & "
    "\xE2\x80\xA8";

inline std::string jpegOf(const cv::Mat& image)
{
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", image, jpeg);
  return {jpeg.begin(), jpeg.end()};
}

inline PageObject pageObjectOf(const ObjectRecord& record)
{
  PageObject object;
  object.record = record;
  object.record.observations = 12;
  object.record.existence = 0.98;
  object.record.labelCounts = {
      {record.label, 11},
      {      "lamp",  1}
  };
  object.record.covariance = 1e-4 * Eigen::Matrix<double, 7, 7>::Identity();
  object.record.firstSeen = 100;
  object.record.lastSeen = 110;
  return object;
}

/** Three objects, of which the first has a nasty label, three keyframes and a small cloud. The
 * truth knows the second object and one that the map lacks; the first is not confirmed. */
inline PageContent samplePage()
{
  PageContent page;
  page.title = kNastyLabel;
  page.scene = sampleContent();
  for (const ObjectRecord& record : page.scene.objects)
    page.objects.push_back(pageObjectOf(record));
  page.objects[0].record.label = kNastyLabel;
  page.objects[0].confirmed = false;
  page.labels = {"bench", "chair", "couch", "refrigerator"};
  for (int i = 0; i < 3; ++i)
  {
    PageKeyframe keyframe;
    keyframe.time = 100 + i;
    keyframe.sensor = "camera";
    keyframe.camera = page.scene.cameras[static_cast<std::size_t>(i)];
    keyframe.width = 160;
    keyframe.height = 120;
    keyframe.jpeg = jpegOf(cv::Mat(60, 80, CV_8UC3, cv::Scalar(20, 30, 200)));
    keyframe.boxes = {
        {"couch", "complete", "the cuboid fits", 0.9,   {10, 10, 80, 60},           2u},
        { "lamp", "rejected",  "too few points", 0.4, {90, 30, 120, 100}, std::nullopt}
    };
    page.keyframes.push_back(keyframe);
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-3, 3);
  for (int i = 0; i < 5000; ++i)
  {
    CloudPoint point;
    point.position = {place(random), place(random), 0.0F};
    point.normal = {0, 0, 1};
    point.rgb = {200, static_cast<std::uint8_t>(i % 256), 30};
    page.scene.cloud.push_back(point);
  }
  page.comparedName = "truth";
  page.comparedIsTruth = true;
  page.compared = {
      pageObjectOf(page.scene.objects[1]),
      pageObjectOf(recordOf("9", "bed", {5, 5, 0.3, 0, 0, 0}, {0.5, 1.0, 0.3}))};
  return page;
}

/** As large as pages are to be: 100 objects, 1,000 keyframes, 500,000 points. */
inline PageContent largePage()
{
  PageContent page = samplePage();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-6, 6);
  page.objects.clear();
  for (int i = 0; i < 100; ++i)
    page.objects.push_back(pageObjectOf(recordOf(
        std::to_string(i + 1), "chair", {place(random), place(random), 0.4, place(random), 0, 0},
        {0.25, 0.25, 0.4})));
  page.scene.cloud.clear();
  for (int i = 0; i < 500000; ++i)
  {
    CloudPoint point;
    point.position =
        Eigen::Vector3d(place(random), place(random), 0.1 * place(random)).cast<float>();
    point.normal = {0, 0, 1};
    point.rgb = {200, 100, static_cast<std::uint8_t>(i % 256)};
    page.scene.cloud.push_back(point);
  }
  page.keyframes.resize(1);
  page.keyframes.resize(1000, page.keyframes.front());
  for (std::size_t i = 0; i < page.keyframes.size(); ++i)
  {
    PageKeyframe& keyframe = page.keyframes[i];
    keyframe.camera.T_map_sensor = {place(random), place(random), 1.2, place(random), 0, 0};
    keyframe.boxes.resize(8, keyframe.boxes.front());
    keyframe.jpeg.resize(14000, 'x');  // what PageImages allows for so many
    page.scene.trajectory.push_back(keyframe.camera.T_map_sensor);
  }
  return page;
}

}  // namespace quadmap::testing
