#include "quadmap/slam/SlamOptions.h"

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <utility>

#include "OptionText.h"
#include "quadmap/obs/ConfigCheck.h"

namespace quadmap
{
namespace
{
constexpr std::pair<SlamMethod, const char*> kMethods[] = {
    {    SlamMethod::Rgbd,     "rgbd"},
    { SlamMethod::Quadric,  "quadric"},
    {   SlamMethod::Point,    "point"},
    {SlamMethod::Odometry, "odometry"}
};

constexpr std::pair<PoseSource, const char*> kSources[] = {
    {       PoseSource::Auto,         "auto"},
    {     PoseSource::Rawlog,       "rawlog"},
    {     PoseSource::Visual,       "visual"},
    {PoseSource::GroundTruth, "ground-truth"},
    {      PoseSource::Graph,   "graph:FILE"}
};

const std::string kGraph = "graph:";  // and the name of its file

constexpr unsigned kUsefulThreads = 4;  // the input, and three stages a keyframe goes through

constexpr std::pair<AssociationSource, const char*> kAssociations[] = {
    {AssociationSource::Estimated, "estimated"},
    {    AssociationSource::Given,     "given"}
};

template <typename Table>
auto valueOf(const Table& table, const std::string& what, const std::string& name)
{
  std::string known;
  for (const auto& [value, text] : table)
  {
    if (name == text) return value;
    known += (known.empty() ? "" : ", ") + std::string(text);
  }
  throw std::invalid_argument(what + "=" + name + ": must be one of " + known);
}

template <typename Table, typename Value>
std::string textOf(const Table& table, Value value)
{
  for (const auto& [v, text] : table)
    if (v == value) return text;
  throw std::logic_error("option value without a name");
}

}  // namespace

SlamMethod slamMethodFrom(const std::string& name) { return valueOf(kMethods, "method", name); }
std::string nameOf(SlamMethod method) { return textOf(kMethods, method); }

PoseSource poseSourceFrom(const std::string& name) { return valueOf(kSources, "odometry", name); }
std::string nameOf(PoseSource source) { return textOf(kSources, source); }

void SlamOptions::setOdometry(const std::string& name)
{
  const bool isGraph = name.rfind(kGraph, 0) == 0 && name.size() > kGraph.size();
  odometry = isGraph ? PoseSource::Graph : poseSourceFrom(name);
  odometryGraph = isGraph ? name.substr(kGraph.size()) : "";
}

std::string SlamOptions::odometryName() const
{
  return odometry == PoseSource::Graph ? kGraph + odometryGraph : nameOf(odometry);
}

void SlamOptions::setThreads(int number)
{
  if (number < 0 || number > kMostThreads)
    throw std::invalid_argument(
        "threads=" + std::to_string(number) + ": must be between 0 and " +
        std::to_string(kMostThreads));
  threads = number;
}

std::size_t SlamOptions::workingThreads() const
{
  if (threads > 0) return static_cast<std::size_t>(threads);
  return std::clamp(std::thread::hardware_concurrency(), 1u, kUsefulThreads);
}

AssociationSource associationSourceFrom(const std::string& name)
{
  return valueOf(kAssociations, "association", name);
}
std::string nameOf(AssociationSource source) { return textOf(kAssociations, source); }

void SlamOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& config, const std::string& section)
{
  rejectUnknownKeys(config, section, {"method", "odometry", "threads", "association"});
  method = slamMethodFrom(config.read_string(section, "method", nameOf(method)));
  setOdometry(config.read_string(section, "odometry", odometryName()));
  readNumber(config, section, "threads", threads, 0, kMostThreads);
  association =
      associationSourceFrom(config.read_string(section, "association", nameOf(association)));
}

void SlamOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& config, const std::string& section) const
{
  config.write(section, "method", nameOf(method));
  config.write(section, "odometry", odometryName());
  config.write(section, "threads", threads);
  config.write(section, "association", nameOf(association));
}

void InputOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& config, const std::string& section)
{
  rejectUnknownKeys(config, section, {"maxBoxDelay", "maxOdometryGap"});
  readNumber(config, section, "maxBoxDelay", maxBoxDelay, 0.0, 10.0);
  readNumber(config, section, "maxOdometryGap", maxOdometryGap, 1e-3, 3600.0);
}

void InputOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& config, const std::string& section) const
{
  config.write(section, "maxBoxDelay", optionText(maxBoxDelay));
  config.write(section, "maxOdometryGap", optionText(maxOdometryGap));
}

}  // namespace quadmap
