#include "heads/HeadChoice.h"

#include <gtest/gtest.h>

#include "quadmap/base/ErrorText.h"

using namespace quadmap;

namespace
{
std::string messageFor(const HeadRequest& request)
{
  try
  {
    chooseHead(request);
  }
  catch (const std::runtime_error& e)
  {
    return e.what();
  }
  return "no error";
}
}  // namespace

TEST(HeadChoice, KnowsRealNetworksByTheirShapes)
{
  const std::pair<HeadRequest, HeadKind> cases[] = {
      {                 {HeadKind::Auto, {{84, 8400}}, 640, 640, 80},HeadKind::Yolov8                                                                     },
      {{HeadKind::Auto, {{116, 8400}, {32, 160, 160}}, 640, 640, 80},  HeadKind::Yolov8},
      {                   {HeadKind::Auto, {{5, 8400}}, 640, 640, 1},  HeadKind::Yolov8},
      {                {HeadKind::Auto, {{25200, 85}}, 640, 640, 80},  HeadKind::Yolov5},
      {                 {HeadKind::Auto, {{3549, 85}}, 416, 416, 80},   HeadKind::Yolox},
      {                                                  {HeadKind::Auto,
                                                  {{400, 80}, {1600, 32}, {100, 32}, {1600, 80}, {100, 80}, {400, 32}},
                                                  320,
                                                  320,
                                                  80},
       HeadKind::NanoDet                                                               },
      {   {HeadKind::Darknet, {{300, 85}, {1200, 85}}, 320, 320, 80}, HeadKind::Darknet},
  };
  for (const auto& [request, expected] : cases)
  {
    const auto [kind, head] = chooseHead(request);
    EXPECT_STREQ(nameOf(kind), nameOf(expected));
    EXPECT_EQ(head->labels(), request.labels);
    HeadRequest named = request;
    named.kind = expected;
    EXPECT_EQ(chooseHead(named).first, expected);
  }
}

TEST(HeadChoice, NamesTheShapesThatItDoesNotKnow)
{
  EXPECT_EQ(
      messageFor({HeadKind::Auto, {{300, 6}}, 640, 480, 80}),
      "its outputs (300x6, for an input of 640x480 and 80 labels) are not those of nanodet, "
      "yolov8, "
      "yolox, yolov5");
  EXPECT_EQ(
      messageFor({
          HeadKind::Yolox, {{84, 8400}, {7}},
           640, 640, 80
  }),
      "its outputs (84x8400, 7, for an input of 640x640 and 80 labels) are not those of yolox");
  EXPECT_NE(messageFor({HeadKind::Darknet, {{300}}, 32, 32, 80}), "no error");
  EXPECT_NE(messageFor({HeadKind::Auto, {}, 32, 32, 80}), "no error");
  EXPECT_NE(messageFor({HeadKind::Auto, {{84, 8400}}, 320, 320, 80}), "no error")
      << "another input has another number of cells";
}

TEST(HeadChoice, TellsLabelsOfAnotherNumber)
{
  EXPECT_EQ(
      messageFor({HeadKind::Auto, {{84, 8400}}, 640, 640, 79}),
      "its outputs (84x8400) have 80 classes, but there are 79 labels");
  EXPECT_EQ(
      messageFor({HeadKind::Darknet, {{300, 85}}, 320, 320, 20}),
      "its outputs (300x85) have 80 classes, but there are 20 labels");
}

TEST(HeadChoice, LeavesOutTheBatch)
{
  EXPECT_EQ(withoutBatch({1, 84, 8400}), (Shape{84, 8400}));
  EXPECT_EQ(withoutBatch({1, 32, 160, 160}), (Shape{32, 160, 160}));
  EXPECT_EQ(withoutBatch({1, 6}), (Shape{1, 6}));
  EXPECT_EQ(textOf({1, 84}), "1x84");
}
