#include "quadmap/base/Json.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <vector>

#include "quadmap/base/InputFile.h"
#include "quadmap/base/OutputSet.h"

namespace quadmap
{
namespace
{
/** What the parts of a tree take in memory [bytes]. A value stands in a list, and in another one
 * when the tree is removed; lists double their room when it is full. A key counts twice, as readers
 * keep what has a name. */
constexpr std::size_t kBytesOfValue = 40, kBytesOfKey = 100, kBytesOfList = 48, kBytesOfText = 48;

/** What the letters of a text take beside it [bytes]. A few have their place in it. */
std::size_t bytesOfLetters(const std::string& text)
{
  return text.size() < 16 ? 0 : text.size() + 32;
}

/** Adds up what a file holds, before a tree is made of it. Each value takes more memory than its
 * text: 100 MB of brackets would take 10 GB. Each key of an object is compared with all before it,
 * as these keep their order: 200,000 keys would take minutes. */
class TreeLimit : public nlohmann::json_sax<Json>
{
 public:
  bool null() override { return add(kBytesOfValue); }
  bool boolean(bool) override { return add(kBytesOfValue); }
  bool number_integer(number_integer_t) override { return add(kBytesOfValue); }
  bool number_unsigned(number_unsigned_t) override { return add(kBytesOfValue); }
  bool number_float(number_float_t, const string_t&) override { return add(kBytesOfValue); }
  bool string(string_t& text) override
  {
    return add(kBytesOfValue + kBytesOfText + bytesOfLetters(text));
  }
  bool binary(binary_t&) override { return add(kBytesOfValue); }

  bool start_object(std::size_t) override { return begin(); }
  bool start_array(std::size_t) override { return begin(); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }

  bool key(string_t& text) override
  {
    constexpr std::size_t kShownText = 60;
    constexpr std::size_t kMostComparisons = 200'000'000;  // 20,000 short keys of one object
    auto& keys = keys_.back();
    comparisons_ += keys.size() * (1 + text.size() / 64);
    if (comparisons_ > kMostComparisons)
      throw std::runtime_error("has too many keys in its objects");
    // The parser would take the last value and lose the others.
    if (!keys.insert(text).second)
      throw std::runtime_error(
          "the key '" + text.substr(0, kShownText) + "' stands twice in an object");
    return add(kBytesOfKey + bytesOfLetters(text));
  }

  /** Ends the counting. The parser finds the same error, and says where it is. */
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override
  {
    return false;
  }

 private:
  bool add(std::size_t bytes)
  {
    // 20,000 keyframes with 24 boxes each, or 100,000 objects of a map with 8 labels each.
    constexpr std::size_t kMostBytes = 700'000'000;
    bytes_ += bytes;
    if (bytes_ > kMostBytes) throw std::runtime_error("holds too many values");
    return true;
  }

  bool begin()
  {
    constexpr std::size_t kDeepest = 64;
    if (keys_.size() >= kDeepest) throw std::runtime_error("is nested too deeply");
    keys_.emplace_back();
    return add(kBytesOfValue + kBytesOfList);
  }

  bool end()
  {
    keys_.pop_back();
    return true;
  }

  std::size_t bytes_ = 0, comparisons_ = 0;
  std::vector<std::unordered_set<std::string>> keys_;  // of each open object or array, so far
};

/** The parser takes a zero byte for the end of the text, and passes over what follows. */
void requireNoZeroByte(std::istream& file)
{
  std::vector<char> block(std::size_t{1} << 16);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    if (std::memchr(block.data(), 0, static_cast<std::size_t>(file.gcount())))
      throw std::runtime_error("has a zero byte");
}
}  // namespace

Json readJson(const std::string& path)
{
  requireOneRun(path);
  requireNoDevice(path);
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read (does the file exist?)");
  try
  {
    requireNoZeroByte(file);
    file.clear();
    file.seekg(0);
    // Counted apart: with a callback, the parser walks through the whole enclosing list each time
    // an object in it ends.
    TreeLimit limit;
    Json::sax_parse(file, &limit);
    file.clear();
    file.seekg(0);
    return Json::parse(file);
  }
  catch (const Json::exception& e)
  {
    const std::string text = e.what();  // "[json.exception.parse_error.101] parse error at line 1"
    throw std::runtime_error(path + ": " + text.substr(text.find("] ") + 2));
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
