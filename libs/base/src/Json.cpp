#include "quadmap/base/Json.h"

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "quadmap/base/InputFile.h"
#include "quadmap/base/OutputSet.h"

namespace quadmap
{
namespace
{
/** Counts what a file holds while it is read. Each value takes more memory than its text: 100 MB of
 * brackets would take 10 GB. Each key of an object is compared with all before it, as these keep
 * their order: 200,000 keys would take minutes. */
class TreeLimit
{
 public:
  /** \param keyBytes Of the key, when one was read. */
  void count(int depth, Json::parse_event_t event, std::size_t keyBytes)
  {
    constexpr std::size_t kMostValues = 8'000'000;         // 20,000 keyframes with 40 boxes each
    constexpr std::size_t kMostComparisons = 200'000'000;  // 20,000 short keys of one object
    if (depth > kDeepest) throw std::runtime_error("is nested too deeply");
    auto& keys = keys_[static_cast<std::size_t>(depth)];
    if (event == Json::parse_event_t::object_end) keys_[static_cast<std::size_t>(depth) + 1] = 0;
    if (event == Json::parse_event_t::key &&
        (comparisons_ += keys++ * (1 + keyBytes / 64)) > kMostComparisons)
      throw std::runtime_error("has too many keys in its objects");
    const bool isBegin = event == Json::parse_event_t::value ||
                         event == Json::parse_event_t::object_start ||
                         event == Json::parse_event_t::array_start;
    if (isBegin && ++values_ > kMostValues) throw std::runtime_error("holds too many values");
  }

 private:
  static constexpr int kDeepest = 64;
  std::size_t values_ = 0, comparisons_ = 0;
  std::array<std::size_t, kDeepest + 2> keys_{};  // of the open object at each depth, so far
};
}  // namespace

Json readJson(const std::string& path)
{
  requireOneRun(path);
  requireNoDevice(path);
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read (does the file exist?)");
  TreeLimit limit;
  const auto count = [&limit](int depth, Json::parse_event_t event, const Json& parsed)
  {
    const std::string* key = parsed.get_ptr<const std::string*>();
    limit.count(depth, event, key ? key->size() : 0);
    return true;
  };
  try
  {
    return Json::parse(file, count);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(path + ": " + e.what());
  }
}

std::optional<std::int64_t> wholeNumber(const Json& value)
{
  if (value.is_number_unsigned() &&
      value.get<std::uint64_t>() > std::uint64_t{std::numeric_limits<std::int64_t>::max()})
    return std::nullopt;
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (!value.is_number_float()) return std::nullopt;
  const double number = value.get<double>();
  // -2^63 has a double, 2^63 - 1 has none: it would be rounded to 2^63.
  const bool isHeld = number >= -0x1p63 && number < 0x1p63;
  if (!isHeld || number != std::floor(number)) return std::nullopt;
  return static_cast<std::int64_t>(number);
}

std::string jsonText(const Json& json, int indent)
{
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json rounded(double value, int decimals)
{
  const double scale = std::pow(10.0, decimals);
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * scale) / scale + 0.0;  // no negative zero
}

Json orNull(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

}  // namespace quadmap
