#include "SlamCli.h"

#include <stdexcept>

namespace quadmap
{
namespace
{
/** Sets an option by its setter. An error names the option as the command line does. */
template <typename Value>
void set(SlamOptions& options, void (SlamOptions::*setter)(Value), Value value)
try
{
  (options.*setter)(value);
}
catch (const std::invalid_argument& e)
{
  throw cli::UsageError("--" + std::string(e.what()));
}
}  // namespace

SlamConfiguration configurationOf(SlamCli& cli)
{
  SlamConfiguration configuration;
  if (cli.config.isSet()) configuration = SlamConfiguration::fromFile(cli.config.getValue());
  if (cli.method.isSet()) configuration.slam.method = slamMethodFrom(cli.method.getValue());
  if (cli.odometry.isSet())
    set<const std::string&>(configuration.slam, &SlamOptions::setOdometry, cli.odometry.getValue());
  if (cli.association.isSet())
    configuration.slam.association = associationSourceFrom(cli.association.getValue());
  if (cli.detector.isSet()) configuration.slam.detector = cli.detector.getValue();
  if (cli.objects.isSet() && configuration.slam.findsBoxes())
    throw cli::UsageError("--objects: not with a detector, which finds the boxes");
  if (cli.every.isSet())
  {
    if (cli.every.getValue() < 1) throw cli::UsageError("--every: must be 1 or more");
    configuration.keyframes.every = cli.every.getValue();
  }
  if (cli.threads.isSet())
    set<int>(configuration.slam, &SlamOptions::setThreads, cli.threads.getValue());
  return configuration;
}

}  // namespace quadmap
