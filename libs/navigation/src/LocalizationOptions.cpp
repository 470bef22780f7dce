#include "quadmap/navigation/LocalizationOptions.h"

#include "quadmap/base/OptionList.h"

namespace quadmap
{
namespace
{
constexpr double kLeastValue = 1e-6;
}

void LocalizationOptions::describe(OptionList& list)
{
  list.about("The particle filter that finds the robot in a known map of objects.");
  list.integer("particles", particles, {100, 1000000}, "", "Number of poses that are weighed.");
  list.integer("seed", seed, {0, 2147483647}, "", "Seed of all random numbers.");
  list.number(
      "startMargin", startMargin, {0, 1000}, "m",
      "The poses start anywhere within the objects of the map and this far around them.");
  list.number(
      "startHeightSigma", startHeightSigma, {0, 100}, "m",
      "Standard deviation of the height at the start about that of the odometry.");
  list.number(
      "updateDistance", updateDistance, {0, 100}, "m",
      "The poses are weighed again when a camera has moved this far: one that stands still repeats "
      "its mistakes.");
  list.angle("updateAngle_deg", updateAngle, {0, 180}, "... or has turned by this.");
  list.number(
      "floorShare", floorShare, {0, 1}, "",
      "Share of the floor's tilt, as an image shows it, that is taken out of pitch and roll; 0 "
      "leaves them to the odometry.");
  list.number(
      "searchShare", searchShare, {0, 0.9}, "",
      "Share of the poses that are drawn anew from what is seen, while the robot is lost.");
  list.number(
      "doubtShare", doubtShare, {0, 0.9}, "",
      "The same when all other poses agree, so that a robot that was carried away is found again.");
  list.number(
      "placeRadius", placeRadius, {kLeastValue, 100}, "m",
      "The estimate is the mean of the poses within this distance of the best place.");
  list.angle("placeAngle_deg", placeAngle, {kLeastValue, 180}, "... and within this turn.");
  list.number(
      "localisedShare", localisedShare, {kLeastValue, 1}, "",
      "The robot counts as localised when these poses have this share of the weight.");
  list.number(
      "localisedSigma", localisedSigma, {kLeastValue, 100}, "m",
      "... and the standard deviation of each horizontal coordinate is below this.");
  list.angle(
      "localisedAngle_deg", localisedAngle, {kLeastValue, 180},
      "... and the standard deviation of the yaw is below this.");
}

std::vector<IniSection> LocalizationConfiguration::sections()
{
  return {
      {"localization", &localization},
      {       "poses",        &poses},
      {      "visual",       &visual},
      {  "perception",   &perception},
  };
}

LocalizationConfiguration LocalizationConfiguration::fromFile(const std::string& path)
{
  LocalizationConfiguration result;
  readIniSections(path, result.sections());
  return result;
}

std::string LocalizationConfiguration::documentedIni() const
{
  LocalizationConfiguration copy = *this;
  return "; Options of quadmap-localize, each with its default: delete what you do not change. A "
         "key that is\n; misspelt is an error. `quadmap-localize --defaults` prints this file.\n" +
         quadmap::documentedIni(copy.sections());
}

}  // namespace quadmap
