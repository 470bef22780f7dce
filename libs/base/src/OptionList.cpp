#include "quadmap/base/OptionList.h"

#include <mrpt/core/format.h>
#include <mrpt/system/string_utils.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
namespace
{
/** The fewest digits, from six on, with which `readBack` gives the value again. */
template <typename Number, typename ReadBack>
std::string shortestText(Number number, ReadBack&& readsBack)
{
  constexpr int kMostDigits = 21;  // of a long double with 64 bits of mantissa
  char buffer[64];
  std::string text;
  for (int digits = 6; digits <= kMostDigits; ++digits)
  {
    const auto end = std::to_chars(
        std::begin(buffer), std::end(buffer), number, std::chars_format::general, digits);
    text.assign(buffer, end.ptr);
    if (readsBack(text)) break;
  }
  return text;
}

std::string degreesText(double radians)
{
  return shortestText(
      radians * 180 / kExactPi,
      [&](const std::string& text) { return fromDegrees(*parseLongNumber(text)) == radians; });
}

bool isWithin(const Bounds& bounds, double value)
{
  return value >= bounds.min && value <= bounds.max;
}

std::string rangeText(const Bounds& bounds)
{
  return mrpt::format("%g to %g", bounds.min, bounds.max);
}

std::string listOf(const std::vector<std::string>& names)
{
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/** \return What the text must be, when it is not; else an empty text. */
std::string readVector(const std::string& text, double* field, const Bounds& bounds)
{
  std::vector<std::string> words;
  mrpt::system::tokenize(text, " \t,", words);
  if (words.size() != 3) return "expected three numbers";
  double values[3] = {};
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto value = parseNumber(words[i]);
    if (!value || !isWithin(bounds, *value))
      return mrpt::format(
          "\"%s\" must be a number in [%g, %g]", words[i].c_str(), bounds.min, bounds.max);
    values[i] = *value;
  }
  std::copy(std::begin(values), std::end(values), field);
  return {};
}

}  // namespace

std::string exactText(double value)
{
  return shortestText(value, [&](const std::string& text) { return parseNumber(text) == value; });
}

void OptionList::number(
    const char* key, double& field, Bounds bounds, const char* unit, const char* reason)
{
  Option o{key, unit, rangeText(bounds), reason, {}, {}, &field, bounds, false};
  o.text = [&field] { return exactText(field); };
  o.read = [&field, bounds](const std::string& text) -> std::string
  {
    const auto value = parseNumber(text);
    if (!value || !isWithin(bounds, *value))
      return mrpt::format("must be a number in [%g, %g]", bounds.min, bounds.max);
    field = *value;
    return {};
  };
  options_.push_back(std::move(o));
}

void OptionList::angle(const char* key, double& radians, Bounds degrees, const char* reason)
{
  Option o{key, "deg", rangeText(degrees), reason, {}, {}, &radians, degrees, true};
  o.text = [&radians] { return degreesText(radians); };
  o.read = [&radians, degrees](const std::string& text) -> std::string
  {
    const auto value = parseLongNumber(text);
    if (!value || !isWithin(degrees, static_cast<double>(*value)))
      return mrpt::format("must be a number in [%g, %g]", degrees.min, degrees.max);
    radians = fromDegrees(*value);
    return {};
  };
  options_.push_back(std::move(o));
}

void OptionList::wholeNumber(
    const char* key,
    std::function<long long()> get,
    std::function<void(long long)> set,
    Bounds bounds,
    const char* unit,
    const char* reason)
{
  Option o{key, unit, {}, reason, {}, {}, nullptr, bounds, false};
  o.range = mrpt::format("%.0f to %.0f", bounds.min, bounds.max);
  o.text = [get] { return std::to_string(get()); };
  o.read = [set, bounds](const std::string& text) -> std::string
  {
    const auto value = parseNumber(text);
    if (!value || !isWithin(bounds, *value) || *value != std::floor(*value))
      return mrpt::format("must be a whole number in [%.0f, %.0f]", bounds.min, bounds.max);
    set(static_cast<long long>(*value));
    return {};
  };
  options_.push_back(std::move(o));
}

void OptionList::flag(const char* key, bool& field, const char* reason)
{
  Option o{key, "", "true or false", reason, {}, {}, nullptr, {}, false};
  o.text = [&field] { return std::string(field ? "true" : "false"); };
  o.read = [&field](const std::string& text) -> std::string
  {
    const auto value = parseFlag(text);
    if (!value) return "must be true or false";
    field = *value;
    return {};
  };
  options_.push_back(std::move(o));
}

void OptionList::named(
    const char* key,
    std::function<std::string()> get,
    std::function<void(const std::string&)> set,
    const std::vector<std::string>& names,
    const char* reason)
{
  Option o{key, "", listOf(names), reason, std::move(get), {}, nullptr, {}, false};
  o.read = [set = std::move(set), names](const std::string& text) -> std::string
  {
    for (const auto& known : names)
      if (text == known)
      {
        set(text);
        return {};
      }
    return "must be one of " + listOf(names);
  };
  options_.push_back(std::move(o));
}

void OptionList::vector(
    const char* key, double* field, Bounds bounds, const char* unit, const char* reason)
{
  Option o{key,    unit, "three numbers, " + rangeText(bounds), reason, {}, {}, nullptr,
           bounds, false};
  o.text = [field]
  { return exactText(field[0]) + " " + exactText(field[1]) + " " + exactText(field[2]); };
  o.read = [field, bounds](const std::string& text) { return readVector(text, field, bounds); };
  options_.push_back(std::move(o));
}

void OptionList::text(
    const char* key,
    std::function<std::string()> get,
    std::function<void(const std::string&)> set,
    const char* range,
    const char* reason)
{
  Option o{key, "", range, reason, std::move(get), {}, nullptr, {}, false};
  o.read = [set = std::move(set)](const std::string& text) -> std::string
  {
    set(text);
    return {};
  };
  options_.push_back(std::move(o));
}

const Option& OptionList::find(const std::string& key) const
{
  for (const auto& option : options_)
    if (option.key == key) return option;
  throw std::logic_error("no option is called " + key);
}

void OptionList::requireLess(const char* low, const char* high)
{
  const Option lowOption = find(low), highOption = find(high);
  requirements_.push_back(
      {[=] { return *lowOption.number < *highOption.number; },
       [=]
       {
         return highOption.key + "=" + highOption.text() + ": must be > " + lowOption.key + " (" +
                lowOption.text() + ")";
       }});
}

void OptionList::require(std::function<bool()> condition, std::string message)
{
  requirements_.push_back(
      {std::move(condition), [message = std::move(message)] { return message; }});
}

void OptionList::check() const
{
  for (const auto& requirement : requirements_)
    if (!requirement.holds()) throw std::invalid_argument(requirement.message());
}

}  // namespace quadmap
