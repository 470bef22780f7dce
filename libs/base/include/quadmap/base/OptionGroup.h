#pragma once

#include <mrpt/config/CLoadableOptions.h>

#include <string>

namespace quadmap
{
class OptionList;

/** Pi to more digits than a double has. */
constexpr long double kExactPi = 3.14159265358979323846264338327950288L;

/** An angle in radians, correctly rounded. An option that an INI file has in degrees uses this for
 * its default, so that the default is bit for bit what the loader reads. */
constexpr double fromDegrees(long double degrees)
{
  return static_cast<double>(degrees * kExactPi / 180);
}

/** Options that are one section of an INI file.
 *
 * A derived struct describes each option once, in describe(): key, field, bounds, unit and reason.
 * Loading, saving, printing and the documented INI file all come from that description, so that
 * they cannot disagree. A loaded file gives back bit for bit what was saved. */
class OptionGroup : public mrpt::config::CLoadableOptions
{
 public:
  /** Reads the keys that the section has; a missing key leaves its option as it is. All options
   * are as they were when this fails.
   *  \exception std::invalid_argument For an unknown key and for a value that is malformed or out
   *  of bounds; the message names section, key, value and bounds. */
  void loadFromConfigFile(
      const mrpt::config::CConfigFileBase& config, const std::string& section) final;

  /** Writes every option, without loss. */
  void saveToConfigFile(
      mrpt::config::CConfigFileBase& config, const std::string& section) const final;

  void dumpToTextStream(std::ostream& out) const final;

  /** The section as INI text: every option with its value below its reason, unit and range. */
  std::string documentedIni(const std::string& section) const;

  /** The options, bound to the fields of this group. The list must not outlive the group. */
  OptionList options();

 protected:
  /** Adds every option to the list. It must not change a field. */
  virtual void describe(OptionList& list) = 0;

 private:
  OptionList optionsToRead() const;
};

}  // namespace quadmap
