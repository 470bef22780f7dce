#include "quadmap/sensors/RawlogSource.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "InputError.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/Words.h"
#include "quadmap/obs/FrameAgreement.h"
#include "quadmap/obs/PixelLabels.h"
#include "quadmap/sensors/RawlogNames.h"
#include "rawlog/MirroredImages.h"
#include "rawlog/RawlogSourceImpl.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kMaxPending = 32;  // most waiting frames of a sensor, 50 MB
/** Most bytes of the images of all waiting frames; 32 of 640x480 with colour and 5 sensors. */
constexpr std::size_t kMaxPendingBytes = 256u << 20;

std::string sidecarFor(const std::string& file, const RawlogSourceOptions& options)
{
  if (!options.readBoxes) return {};
  if (!options.objectsFile.empty()) return options.objectsFile;
  const std::string name = objectsFileOf(file);
  return std::filesystem::exists(name) ? name : std::string();
}

ImageRules imageRulesFor(const std::string& file, const RawlogSourceOptions& options)
{
  return {
      findImagesFolder(file), std::filesystem::absolute(file).parent_path().string(),
      options.imagesAnywhere, options.imagesHint, options.limits.imagePixels};
}

void check(const RawlogSourceOptions& options)
{
  if (!(options.maxBoxDelay >= 0))
    throw std::invalid_argument(
        mrpt::format("maxBoxDelay=%g: must be >= 0 s", options.maxBoxDelay));
  if (!(options.maxOdometryGap > 0))
    throw std::invalid_argument(
        mrpt::format("maxOdometryGap=%g: must be > 0 s", options.maxOdometryGap));
}
}  // namespace

RawlogSource::Impl::Impl(RawlogSource& owner, std::string file, RawlogSourceOptions o) :
    reader(file, o.limits, [this] { return isStopped(); }),
    options(std::move(o)),
    imageRules(imageRulesFor(file, options)),
    boxes(options.maxBoxDelay, [this] { return isStopped(); }),
    odometry(options.odometryKind),
    log_(owner)
{
  check(options);
  registerObsClasses();
  const std::string sidecar = sidecarFor(file, options);
  if (!sidecar.empty()) boxes.openSidecar(sidecar, options.limits);
}

bool RawlogSource::Impl::isStopped()
{
  stopped = stopped || options.shouldStop();
  return stopped;
}

void RawlogSource::Impl::report(const InputProblem& problem)
{
  if (!options.keepGoing)
  {
    ended_ = finished_ = true;
    pending_.clear();
    pendingBytes_ = 0;
    throw std::runtime_error(problem.text());
  }
  problems.push_back(problem);
}

void RawlogSource::Impl::warnOnce(const std::string& text)
{
  if (warned_.insert(text).second) log_.logStr(mrpt::system::LVL_WARN, text);
}

std::optional<RgbdFrame> RawlogSource::Impl::next()
{
  while (!isStopped())
  {
    if (!pending_.empty() && (ended_ || isReady(pending_.front())))
    {
      PendingFrame first = std::move(pending_.front());
      pending_.pop_front();
      pendingBytes_ -= first.bytes;
      auto frame = complete(std::move(first));
      if (frame && !stopped) return frame;  // a stopped one may lack its boxes
    }
    else if (ended_)
    {
      finish();
      return std::nullopt;
    }
    else
      ended_ = !readRecord();
  }
  return std::nullopt;
}

/** Whether everything that can belong to the frame was read. The odometry in use and the sensor's
 * own scans tell how far time has come. The clocks of all other records may be wrong. */
bool RawlogSource::Impl::isReady(const PendingFrame& pending) const
{
  if (pending_.size() > kMaxPending * clocks_.size() || pendingBytes_ > kMaxPendingBytes)
    return true;
  if (!posesAreKnown(pending)) return false;
  const double time = pending.frame.time();
  const std::string& sensor = pending.frame.scan->sensorLabel;
  const double now = std::max(clocks_.at(sensor).latest(), odometry.odometry().latest());
  if (now > time + options.maxOdometryGap) return true;
  return now > time + options.maxBoxDelay && !boxes.mayStillCome(sensor, time);
}

/** Whether no record to come can give the frame a pose, or another one. A rawlog that has shown no
 * odometry for long has none. */
bool RawlogSource::Impl::posesAreKnown(const PendingFrame& pending) const
{
  const double time = pending.frame.time();
  const PoseInterpolator &track = odometry.odometry(), &truth = odometry.truth();
  const double now = clocks_.at(pending.frame.scan->sensorLabel).latest();
  const bool isLong = now > time + options.maxOdometryGap;
  const bool odometryKnown =
      odometry.countsActions() || track.reaches(time) || (track.empty() && isLong);
  return odometryKnown && (truth.empty() || truth.reaches(time) || isLong);
}

std::optional<RgbdFrame> RawlogSource::Impl::complete(PendingFrame pending)
{
  auto& frame = pending.frame;
  try
  {
    prepareScan(*frame.scan, imageRules);
  }
  catch (const std::exception& e)
  {
    report({reader.file(), frame.record, frame.scan->sensorLabel, rootMessage(e)});
    return std::nullopt;
  }
  if (!frame.scan->doDepthAndIntensityCamerasCoincide() && frame.scan->hasIntensityImage)
    warnOnce(
        reader.file() + " (" + frame.scan->sensorLabel +
        "): colour is not registered to depth, boxes may be off");
  addPoses(pending);
  addBoxes(frame);
  if (!frame.objects && options.pixelLabelClasses) addPixelLabels(frame);
  makeFyPositive(frame);
  ++framesRead;
  return std::move(frame);
}

void RawlogSource::Impl::addPoses(PendingFrame& pending)
{
  const double time = pending.frame.time();
  const auto pose = odometry.countsActions() ? std::make_optional(pending.sumOfActions)
                                             : odometry.odometry().at(time, options.maxOdometryGap);
  if (pose)
  {
    pending.frame.T_odom_robot = pose->mean;
    pending.frame.odometryCovariance = pose->cov;
    pending.frame.odometryKind = odometry.kind();
  }
  if (const auto truth = odometry.truth().at(time, options.maxOdometryGap))
    pending.frame.T_world_robot = truth->mean;
  if (!pending_.empty())
  {
    const auto earlier = [](const PendingFrame& a, const PendingFrame& b)
    { return a.frame.time() < b.frame.time(); };
    const auto first = std::min_element(pending_.begin(), pending_.end(), earlier);
    odometry.forgetBefore(std::min(time, first->frame.time()) - kMaxScanDelay);
  }
}

void RawlogSource::Impl::readSidecar(double time)
{
  while (true) try
    {
      return boxes.readUntil(time);
    }
    catch (const InputError& e)
    {
      report(e.problem);
    }
}

void RawlogSource::Impl::addBoxes(RgbdFrame& frame)
{
  readSidecar(frame.time());
  const std::string& label = frame.scan->sensorLabel;
  auto found = boxes.take(label, frame.time());
  if (!found) return;
  const std::string file = boxes.hasSidecar() ? sidecarFor(reader.file(), options) : reader.file();
  if (const auto why = mismatch(*found->boxes, *frame.scan))
    return report({file, found->record, label, *why});
  for (const auto& what : removeUnusableBoxes(*found->boxes))
    report({file, found->record, label, what});
  frame.objects = found->boxes;
}

void RawlogSource::Impl::addPixelLabels(RgbdFrame& frame)
{
  try
  {
    std::size_t leftOut = 0;
    frame.objects = boxesFromPixelLabels(
        *frame.scan, *options.pixelLabelClasses, options.minLabelPixels, unknownPixelLabels_,
        &leftOut);
    if (leftOut > 0)
      warnOnce(mrpt::format(
          "%s (%s): the pixel labels of an image have more than %u separate parts, of which the "
          "largest are kept (minLabelPixels leaves out small ones)",
          reader.file().c_str(), frame.scan->sensorLabel.c_str(),
          CObservationObjects::kMostObjects));
    frame.objectsFromPixelLabels = frame.objects != nullptr;
    sawPixelLabels = sawPixelLabels || frame.objects;
  }
  catch (const std::exception& e)
  {
    report({reader.file(), frame.record, frame.scan->sensorLabel, rootMessage(e)});
  }
}

void RawlogSource::Impl::tellUnknownPixelLabels()
{
  if (!unknownPixelLabels_.empty())
    warnOnce(
        reader.file() + ": pixel labels that are not in the label table are no objects: " +
        firstFew(unknownPixelLabels_));
}

void RawlogSource::Impl::tellLeftOut(const std::string& file, std::uint64_t bytes)
{
  if (bytes > 0)
    warnOnce(
        file + ": " + std::to_string(bytes) +
        " bytes were left out, of records that cannot be read or behind them");
}

/** Reports boxes of which none found its scan. Such an input is wrong, but would look like an empty
 * room. */
void RawlogSource::Impl::finish()
{
  if (finished_) return;
  finished_ = true;
  tellUnknownPixelLabels();
  readSidecar(1e300);
  tellLeftOut(reader.file(), reader.bytesLeftOut());
  tellLeftOut(sidecarFor(reader.file(), options), boxes.bytesLeftOut());
  if (stopped) return;
  const std::size_t lost = boxes.unpaired(options.sensorLabel);
  if (framesRead == 0 || lost == 0) return;
  const std::string text = mrpt::format(
      "%zu records of boxes match no scan by sensor label and time (within %g s)", lost,
      options.maxBoxDelay);
  const std::string file = boxes.hasSidecar() ? sidecarFor(reader.file(), options) : reader.file();
  if (boxes.paired() == 0)
    report({file, 0, "", text});
  else
    warnOnce(file + ": " + text);
}

RawlogSource::RawlogSource(std::string file, RawlogSourceOptions options) :
    FrameSource("RawlogSource"),
    impl_(std::make_unique<Impl>(*this, std::move(file), std::move(options)))
{
}

RawlogSource::~RawlogSource() = default;

bool RawlogSource::wasStopped() const { return impl_->stopped; }

std::optional<RgbdFrame> RawlogSource::read() { return impl_->next(); }

const std::vector<InputProblem>& RawlogSource::problems() const { return impl_->problems; }

double RawlogSource::progress() const { return impl_->reader.progress(); }

std::size_t RawlogSource::recordsRead() const { return impl_->reader.recordsRead(); }

std::size_t RawlogSource::framesRead() const { return impl_->framesRead; }

bool RawlogSource::hasBoxes() const { return impl_->boxes.seenAny() || impl_->sawPixelLabels; }

std::string RawlogSource::odometryKind() const { return impl_->odometry.kind(); }

std::vector<std::string> RawlogSource::odometryKinds() const { return impl_->odometry.kinds(); }

std::string RawlogSource::contentSummary() const { return impl_->summary(); }

}  // namespace quadmap
