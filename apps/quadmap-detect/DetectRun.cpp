#include "DetectRun.h"

#include <mrpt/core/format.h>
#include <mrpt/serialization/CArchive.h>

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>

#include "quadmap/base/ErrorText.h"
#include "quadmap/base/GzipStream.h"
#include "quadmap/base/OutputGroup.h"
#include "quadmap/detection/FrameDetection.h"
#include "quadmap/review/FramePicture.h"
#include "quadmap/review/FramePictureFolder.h"
#include "quadmap/sensors/RawlogSource.h"

namespace quadmap
{
namespace
{
RawlogSourceOptions sourceOptions(const DetectRequest& request)
{
  RawlogSourceOptions options;
  options.readBoxes = false;
  options.sensorLabel = request.sensorLabel;
  options.keepGoing = request.keepGoing;
  options.imagesAnywhere = request.imagesAnywhere;
  options.imagesHint = "--images-anywhere";
  return options;
}

class DetectRun
{
 public:
  DetectRun(const DetectRequest& request, Detector& detector) :
      request_(request),
      detector_(detector),
      source_(request.rawlog, sourceOptions(request)),
      pictures_(picturesOf(request, files_)),
      output_(files_.add(request.output), kCompression),
      start_(std::chrono::steady_clock::now())
  {
    source_.sendWarningsTo(request.onWarning);
  }

  DetectSummary run()
  {
    auto next = readAhead();
    while (auto read = next.get())
    {
      next = readAhead();
      lookAt(read->frame);
      request_.onProgress(read->progress, framesPerSecond());
    }
    requireFrames();
    if (pictures_) pictures_->commit();
    output_.commit();
    files_.commit();
    summary_.framesPerSecond = framesPerSecond();
    for (const auto& problem : source_.problems()) summary_.dropped.push_back(problem.text());
    return summary_;
  }

 private:
  static constexpr int kCompression = 6;  // boxes are small

  struct ReadFrame
  {
    RgbdFrame frame;
    double progress = 0;
  };

  static std::unique_ptr<FramePictureFolder> picturesOf(
      const DetectRequest& request, OutputGroup& files)
  {
    if (request.pictures.empty()) return nullptr;
    return std::make_unique<FramePictureFolder>(request.pictures, &files);
  }

  /** Reads the next frame in another thread. */
  std::future<std::optional<ReadFrame>> readAhead()
  {
    return std::async(
        std::launch::async,
        [this]() -> std::optional<ReadFrame>
        {
          auto frame = source_.next();
          if (!frame) return std::nullopt;
          return ReadFrame{std::move(*frame), source_.progress()};
        });
  }

  void lookAt(const RgbdFrame& frame)
  {
    ++summary_.frames;
    auto boxes = detect(frame);
    if (!boxes)
    {
      ++summary_.framesWithoutColour;
      return;
    }
    summary_.boxes += boxes->objects.size();
    if (frame.isTurned) turnUpsideDown(*boxes);  // the file speaks of the images as recorded
    if (pictures_) draw(frame, *boxes);
    mrpt::serialization::archiveFrom(output_) << *boxes;
    output_.requireWritten();
  }

  CObservationObjects::Ptr detect(const RgbdFrame& frame)
  try
  {
    return detectObjects(frame, detector_);
  }
  catch (const std::exception& e)
  {
    const InputProblem problem{
        request_.rawlog, frame.record, frame.scan->sensorLabel, rootMessage(e)};
    throw std::runtime_error(problem.text());
  }

  void draw(const RgbdFrame& frame, const CObservationObjects& boxes)
  {
    const mrpt::img::CImage image = recordedImage(frame);
    FramePictureContent content;
    content.scan = frame.scan.get();
    content.image = &image;
    content.boxes = &boxes;
    pictures_->add(summary_.frames - 1, drawFrame(content));
  }

  double framesPerSecond() const
  {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    return static_cast<double>(summary_.frames) / passed.count();
  }

  void requireFrames() const
  {
    if (summary_.frames == 0)
      throw std::runtime_error(request_.rawlog + ": " + source_.whyNoFrames(request_.sensorLabel));
    if (summary_.framesWithoutColour == summary_.frames)
      throw std::runtime_error(mrpt::format(
          "%s: none of its %zu images%s has colour", request_.rawlog.c_str(), summary_.frames,
          ofSensor(request_.sensorLabel).c_str()));
  }

  const DetectRequest& request_;
  Detector& detector_;
  RawlogSource source_;
  OutputGroup files_;
  std::unique_ptr<FramePictureFolder> pictures_;  // null when none are drawn
  GzipFileWriter output_;                         // may lie in the folder made for the pictures
  std::chrono::steady_clock::time_point start_;
  DetectSummary summary_;
};

}  // namespace

DetectSummary detectInRawlog(const DetectRequest& request, Detector& detector)
{
  return DetectRun(request, detector).run();
}

}  // namespace quadmap
