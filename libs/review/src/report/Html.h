#pragma once

#include <string>
#include <vector>

namespace quadmap
{
/** A text as it stands between tags or in quoted attributes. Control bytes become '?'. */
std::string htmlText(const std::string& text);

/** "<tag>text</tag>", with the text made safe. */
std::string htmlElement(const std::string& tag, const std::string& text);

/** A table; all cells are texts that are made safe. */
class HtmlTable
{
 public:
  /** \param columns Their titles. A title that starts with '#' is that of a column of numbers,
   * which stand to the right; the mark is not shown. */
  explicit HtmlTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  void addRow(const std::vector<std::string>& cells);
  bool isEmpty() const { return rows_.empty(); }
  std::string toHtml() const;

 private:
  std::string cell(const char* tag, std::size_t column, const std::string& text) const;

  std::vector<std::string> columns_;
  std::string rows_;
};

}  // namespace quadmap
