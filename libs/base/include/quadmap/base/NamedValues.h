#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace quadmap
{
/** The value that a table of pairs (value, name) has under a name.
 * \param what The option, for the message. \exception std::invalid_argument Lists the names. */
template <typename Table>
auto valueNamed(const Table& table, const std::string& what, const std::string& name)
{
  std::string known;
  for (const auto& [value, text] : table)
  {
    if (name == text) return value;
    known += (known.empty() ? "" : ", ") + std::string(text);
  }
  throw std::invalid_argument(what + "=" + name + ": must be one of " + known);
}

/** The name of a value in such a table. */
template <typename Table, typename Value>
std::string nameIn(const Table& table, Value value)
{
  for (const auto& [v, text] : table)
    if (v == value) return text;
  throw std::logic_error("option value without a name");
}

}  // namespace quadmap
