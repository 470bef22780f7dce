#include "quadmap/slam/RawlogRun.h"

#include <memory>
#include <optional>
#include <stdexcept>

#include "files/ResultWriter.h"
#include "keyframes/KeyframeSpool.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/RunFolder.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/odometry/OdometrySurvey.h"
#include "quadmap/sensors/RawlogSource.h"
#include "quadmap/sensors/RememberedStop.h"
#include "run/ObjectSlam.h"

namespace quadmap
{
namespace
{
class RawlogRun
{
 public:
  /** \param request shouldStop() of it remembers a yes. */
  explicit RawlogRun(const RawlogRunRequest& request) :
      request_(request),
      folder_(
          request.outputDirectory,
          "results",
          "report.json",
          {"objects.quadmap", "objects.json", "trajectory.tum", "map.simplemap"}),
      survey_(survey(request)),
      source_(sourceOf(request, survey_)),
      spool_(request.outputDirectory),
      slam_(
          configurationOf(request, survey_),
          LabelTable::installed(),
          spool_,
          survey_,
          request.keepGoing)
  {
    using mrpt::system::VerbosityLevel;
    slam_.logging_enable_console_output = false;
    slam_.setMinLoggingLevel(mrpt::system::LVL_DEBUG);
    slam_.logRegisterCallback(
        [this](std::string_view text, VerbosityLevel level, std::string_view, auto)
        { request_.onMessage(level, std::string(text)); });
    source_->sendWarningsTo([this](const std::string& text) { slam_.warn(text); });
    slam_.setInputName(request.rawlog);
    const std::string warning = survey_.warning(request.rawlog);
    if (!warning.empty()) slam_.warn(warning);
    if (request.isLive) slam_.keepUp();
  }

  RawlogRunSummary run()
  try
  {
    const bool interrupted = addAllFrames() || source_->failure();
    const std::string losses = source_->lossSummary();
    if (!losses.empty()) slam_.warn(request_.rawlog + ": " + losses);
    const std::string late =
        survey_.warningOfLateOdometry(request_.rawlog, source_->odometryKind());
    if (!late.empty()) slam_.warn(late);
    requireContent(interrupted);
    finish();
    request_.onClosing();
    return write(interrupted || slam_.result().loops.stopped);
  }
  catch (const BadFrame& e)
  {
    throw std::runtime_error(problemOf(e).text());
  }

 private:
  static OdometrySurvey survey(const RawlogRunRequest& request)
  {
    const SlamConfiguration& c = request.configuration;
    if (request.source)
      return surveyOdometry(*request.source, c.slam.odometry, c.perception, c.visual);
    return surveyOdometry(
        request.rawlog, sourceOptions(request), c.slam.odometry, c.perception, c.visual);
  }

  static std::shared_ptr<FrameSource> sourceOf(
      const RawlogRunRequest& request, const OdometrySurvey& survey)
  {
    if (request.source) return request.source;
    if (survey.withoutImages) return survey.withoutImages;
    return std::make_shared<RawlogSource>(
        request.rawlog, sourceOptions(request, survey.odometryKind));
  }

  static RawlogSourceOptions sourceOptions(
      const RawlogRunRequest& request, const std::string& odometryKind = {})
  {
    RawlogSourceOptions options;
    options.odometryKind = odometryKind;
    options.objectsFile = request.objectsFile;
    options.sensorLabel = request.sensorLabel;
    options.keepGoing = request.keepGoing;
    options.readBoxes = !request.configuration.slam.findsBoxes();
    if (options.readBoxes && request.configuration.slam.method != SlamMethod::Odometry)
      options.pixelLabelClasses = LabelTable::installed();
    options.minLabelPixels = request.configuration.perception.minLabelPixels;
    options.maxBoxDelay = request.configuration.input.maxBoxDelay;
    options.maxOdometryGap = request.configuration.input.maxOdometryGap;
    options.imagesAnywhere = request.configuration.input.imagesAnywhere;
    options.shouldStop = request.shouldStop;
    options.imagesHint = "imagesAnywhere = true in section [input]";
    options.limits.imagePixels =
        static_cast<std::uint64_t>(request.configuration.input.maxImageMegapixels) << 20;
    return options;
  }

  /** The configuration of the run.
   *  \exception std::invalid_argument If its method cannot continue the given map. */
  static SlamConfiguration configurationOf(
      const RawlogRunRequest& request, const OdometrySurvey& survey)
  {
    const SlamOptions& slam = request.configuration.slam;
    if (request.map && slam.method != SlamMethod::Rgbd)
      throw std::invalid_argument("--map: for method rgbd only");
    if (request.map && slam.association == AssociationSource::Given)
      throw std::invalid_argument(
          "--map: not with association given: the ids of another recording mean other objects");
    SlamConfiguration configuration = request.configuration;
    configuration.slam.odometry = survey.source;
    return configuration;
  }

  /** Reads the rawlog. \return True when asked to stop before its end. */
  bool addAllFrames()
  {
    bool interrupted = false;
    try
    {
      interrupted = addUntilStopped();
    }
    catch (...)
    {
      slam_.settle();  // errors of earlier frames are reported first
      throw;
    }
    slam_.settle();
    return interrupted;
  }

  bool addUntilStopped()
  {
    while (!request_.shouldStop())
    {
      const auto frame = nextFrame();
      request_.onProgress(
          {source_->progress(), slam_.result().counts().keyframes, slam_.objectsByLabel()});
      if (!frame) return source_->wasStopped();
      slam_.addFrame(*frame);
    }
    return true;
  }

  std::optional<RgbdFrame> nextFrame()
  {
    const auto scope = slam_.times().measure("input");
    return source_->next();
  }

  InputProblem problemOf(const BadFrame& e) const
  {
    return {request_.rawlog, e.record, e.sensor, rootMessage(e)};
  }

  void requireContent(bool interrupted)
  {
    const std::string& file = request_.rawlog;
    if (slam_.result().counts().frames == 0)
    {
      if (const auto failure = source_->failure(); interrupted && failure)
        throw std::runtime_error(*failure);
      if (interrupted) throw RunStoppedEarly(file + ": interrupted before the first image");
      if (!request_.keepGoing && !source_->problems().empty())  // the survey passed over them
        throw std::runtime_error(source_->problems().front().text());
      throw std::runtime_error(file + ": " + source_->whyNoFrames(request_.sensorLabel));
    }
    if (!interrupted) requirePoses();
    if (hasSourceOfBoxes() || interrupted) return;
    const std::string text = file + whyNoBoxes();
    if (!request_.keepGoing) throw std::runtime_error(text);
    slam_.warn(text);
  }

  void requirePoses()
  {
    slam_.requireAllPosesUsed();
    if (const std::string text = slam_.warningOfGraph(); !text.empty())
      slam_.warn(request_.rawlog + ": " + text);
    const std::string lack = slam_.lackOfPoses();
    if (!request_.keepGoing && !lack.empty())
      throw std::runtime_error(request_.rawlog + ": " + lack + "; --keep-going leaves them out");
  }

  /** Whether some keyframe has boxes, be they none, or none is wanted. */
  bool hasSourceOfBoxes() const
  {
    const SlamOptions& slam = request_.configuration.slam;
    const SlamCounts counts = slam_.result().counts();
    if (slam.findsBoxes())
      return counts.keyframes == 0 || counts.keyframesWithoutBoxes < counts.keyframes;
    return slam.method == SlamMethod::Odometry || source_->hasBoxes();
  }

  std::string whyNoBoxes() const
  {
    if (!request_.objectsFile.empty() && !request_.configuration.slam.findsBoxes())
      return ": no object boxes, neither in it nor in " + request_.objectsFile;
    return request_.configuration.slam.findsBoxes()
               ? ": none of its images has colour, which the detector needs"
               : ": no object boxes, neither in it nor beside it, and no pixel labels; find some "
                 "with --detector, import them with the images (quadmap-import --detections), name "
                 "their file with --objects, or use --method odometry";
  }

  void finish()
  {
    try
    {
      slam_.finish(request_.map.get(), request_.shouldStop);
    }
    catch (const BadFrame&)
    {
      throw;
    }
    catch (const NotLocalised& e)
    {
      throw std::runtime_error(request_.rawlog + ": " + e.what() + " (" + request_.mapFile + ")");
    }
    catch (const std::exception& e)
    {
      throw std::runtime_error(request_.rawlog + ": " + rootMessage(e));
    }
  }

  RawlogRunSummary write(bool interrupted)
  {
    InputDescription input{request_.rawlog,        request_.objectsFile,    request_.sensorLabel,
                           source_->recordsRead(), source_->odometryKind(), interrupted,
                           source_->problems()};
    for (const auto& e : slam_.badFrames()) input.problems.push_back(problemOf(e));
    if (interrupted && !request_.replaceComplete)
      if (const auto warning = folder_.keepCompleteResult(); !warning.empty()) slam_.warn(warning);
    OutputSet& files = folder_.files();
    RawlogRunSummary summary;
    summary.directory = files.folder();
    writeResult(
        files,
        {request_.version, input, request_.configuration, slam_.result(), spool_, slam_.times()});
    request_.addFiles(slam_.result(), files);
    summary.files = files.names();
    files.commit();
    for (const auto& problem : input.problems) summary.dropped.push_back(problem.text());
    summary.result = slam_.result();
    summary.interrupted = interrupted;
    return summary;
  }

  const RawlogRunRequest& request_;
  RunFolder folder_;
  OdometrySurvey survey_;
  std::shared_ptr<FrameSource> source_;
  KeyframeSpool spool_;
  ObjectSlam slam_;
};

}  // namespace

RawlogRunSummary runOnRawlog(const RawlogRunRequest& request)
{
  RawlogRunRequest remembering = request;
  remembering.shouldStop = rememberedStop(request.shouldStop);
  return RawlogRun(remembering).run();
}

}  // namespace quadmap
