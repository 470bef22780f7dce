#include "quadmap/odometry/PoseSource.h"

#include <utility>

#include "quadmap/base/NamedValues.h"

namespace quadmap
{
namespace
{
constexpr std::pair<PoseSource, const char*> kSources[] = {
    {       PoseSource::Auto,         "auto"},
    {     PoseSource::Rawlog,       "rawlog"},
    {     PoseSource::Visual,       "visual"},
    {PoseSource::GroundTruth, "ground-truth"},
    {      PoseSource::Graph,   "graph:FILE"}
};

}  // namespace

PoseSource poseSourceFrom(const std::string& name)
{
  return valueNamed(kSources, "odometry", name);
}
std::string nameOf(PoseSource source) { return nameIn(kSources, source); }

}  // namespace quadmap
