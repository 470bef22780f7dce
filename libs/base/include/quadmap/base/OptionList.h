#pragma once

#include <functional>
#include <string>
#include <vector>

#include "quadmap/base/NamedValues.h"

namespace quadmap
{
/** The shortest text that reads back as the same number. The locale plays no part. */
std::string exactText(double value);

/** The smallest and the largest value of a number, both allowed. */
struct Bounds
{
  double min = 0, max = 0;
};

/** One option: what its INI key means, and the way between its field and the text of the key. */
struct Option
{
  std::string key;
  std::string unit;    //!< Of the text; empty for a pure number and for words
  std::string range;   //!< What the text may be: "0 to 1", "true or false"
  std::string reason;  //!< Whole sentences about what the option does
  std::function<std::string()> text;
  /** Changes the field. Returns what the text must be, when it is not; else an empty text.
   *  \exception std::invalid_argument Of a setter that makes its own message. */
  std::function<std::string(const std::string&)> read;
  double* number = nullptr;  //!< The field of a real number; for tests
  Bounds bounds;             //!< Of the text of a number
  bool isAngle = false;      //!< The text has degrees, the field has radians
};

/** The options of one section, each described once. */
class OptionList
{
 public:
  /** What the section is for, in whole sentences. */
  void about(std::string sentences) { about_ = std::move(sentences); }

  void number(const char* key, double& field, Bounds bounds, const char* unit, const char* reason);

  /** A field in radians, which the INI file has in degrees. */
  void angle(const char* key, double& radians, Bounds degrees, const char* reason);

  /** A whole number. */
  template <typename Int>
  void integer(const char* key, Int& field, Bounds bounds, const char* unit, const char* reason)
  {
    wholeNumber(
        key, [&field] { return static_cast<long long>(field); },
        [&field](long long value) { field = static_cast<Int>(value); }, bounds, unit, reason);
  }

  void flag(const char* key, bool& field, const char* reason);

  /** One of the names in a table of pairs (value, name), which must outlive the list. */
  template <typename Enum, typename Table>
  void choice(const char* key, Enum& field, const Table& table, const char* reason)
  {
    std::vector<std::string> names;
    for (const auto& [value, name] : table) names.emplace_back(name);
    named(
        key, [&field, &table] { return nameIn(table, field); },
        [&field, &table, key](const std::string& name) { field = valueNamed(table, key, name); },
        names, reason);
  }

  /** Three numbers with blanks between them.
   *  \param field The first of three. */
  void vector(const char* key, double* field, Bounds bounds, const char* unit, const char* reason);

  /** A text with a meaning of its own.
   *  \param set Throws std::invalid_argument for a text that it does not understand.
   *  \param range What the text may be. */
  void text(
      const char* key,
      std::function<std::string()> get,
      std::function<void(const std::string&)> set,
      const char* range,
      const char* reason);

  /** Keys that begin like this belong to another reader of the same section. */
  void leaveKeys(std::string prefix) { foreignPrefixes_.push_back(std::move(prefix)); }

  /** After loading, the option `low` must be less than the option `high`; both are numbers. */
  void requireLess(const char* low, const char* high);

  /** After loading, `condition` must hold. \param message Names the key and what it must be. */
  void require(std::function<bool()> condition, std::string message);

  const std::vector<Option>& options() const { return options_; }
  const std::string& about() const { return about_; }
  const std::vector<std::string>& foreignPrefixes() const { return foreignPrefixes_; }

  /** \exception std::invalid_argument For the first requirement that does not hold; the message has
   *  no section. */
  void check() const;

 private:
  struct Requirement
  {
    std::function<bool()> holds;
    std::function<std::string()> message;
  };

  void wholeNumber(
      const char* key,
      std::function<long long()> get,
      std::function<void(long long)> set,
      Bounds bounds,
      const char* unit,
      const char* reason);
  void named(
      const char* key,
      std::function<std::string()> get,
      std::function<void(const std::string&)> set,
      const std::vector<std::string>& names,
      const char* reason);
  const Option& find(const std::string& key) const;

  std::string about_;
  std::vector<Option> options_;
  std::vector<std::string> foreignPrefixes_;
  std::vector<Requirement> requirements_;
};

}  // namespace quadmap
