#include <gtest/gtest.h>

#include "Fuzz.h"
#include "SmallRecording.h"

using namespace quadmap;

namespace
{
/** Damages a file of boxes, or of the names of their classes, in a recording.
 * \param name Of the file. \param detections, labels See FrameFolderOptions; in the recording. */
void fuzzBoxes(
    const std::string& name,
    const std::string& valid,
    const std::vector<std::string>& words,
    const std::string& detections,
    const std::string& labels = "")
{
  const SmallRecording recording;
  recording.files().write("detections/1.txt", "1 0.5 0.4 0.2 0.2 0.9\n0 0.1 0.1 0.2 0.2\n");
  FrameFolderOptions options;
  options.detections = recording.files().path(detections);
  if (!labels.empty()) options.labels = recording.files().path(labels);
  FuzzRun run;
  run.words = words;
  run.place = recording.files().folder().string();
  fuzz(valid, run, [&](const std::string& text) { recording.readWith(name, text, options); });
}

const std::vector<std::string> kYoloWords = {" ", "0.5 0.5", "80", "79", "1e300", "0.25 ", "7"};
const std::vector<std::string> kCocoWords = {
    "\"bbox\":",
    ", \"id\": 1e300",
    ", \"image_id\": 1.5",
    ", \"category_id\": -9223372036854775808",
    "null",
    "1e300",
    "[0,0,0]",
    "\"a.jpg\"",
    "true",
    "-1.5",
    ",",
    "{}"};
}  // namespace

TEST(Fuzz, YoloBoxes)
{
  fuzzBoxes(
      "detections/1.txt", "56 0.5 0.4 0.2 0.2 0.91\n41 0.1 0.1 0.2 0.2\n", kYoloWords,
      "detections");
}

TEST(Fuzz, YoloOutlines)
{
  fuzzBoxes(
      "detections/1.txt", "56 0.5 0.4 0.6 0.4 0.6 0.55 0.91\n0 0.1 0.1 0.2 0.1 0.2 0.2 0.1 0.2\n",
      kYoloWords, "detections");
}

TEST(Fuzz, ClassNames)
{
  fuzzBoxes("my.names", "cup\n dining table \n\nchair\n", {"\r\n", " "}, "detections", "my.names");
}

TEST(Fuzz, CocoResults)
{
  fuzzBoxes(
      "boxes.json",
      R"([{"image_id": 1, "category_id": 62, "bbox": [10, 20, 30.5, 40], "score": 0.9},)"
      "\n"
      R"( {"image_id": "rgb/2", "category_id": 47, "bbox": [1, 2, 3, 4], "score": 1}])",
      kCocoWords, "boxes.json");
}

TEST(Fuzz, CocoDataset)
{
  fuzzBoxes(
      "boxes.json",
      R"({"images": [{"id": 1, "file_name": "rgb/1.jpg"}, {"id": 2, "file_name": "b/2.jpg"}],)"
      "\n"
      R"( "categories": [{"id": 3, "name": "chair"}, {"id": 4, "name": "cup"}],)"
      "\n"
      R"( "annotations": [{"image_id": 1, "category_id": 3, "bbox": [10, 20, 30.5, 40]},)"
      "\n"
      R"(  {"image_id": 2, "category_id": 4, "bbox": [1, 2, 3, 4], "score": 0.5}]})",
      kCocoWords, "boxes.json");
}
