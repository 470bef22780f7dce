#include "Html.h"

namespace quadmap
{
std::string htmlText(const std::string& text)
{
  std::string safe;
  for (const char c : text) switch (c)
    {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += static_cast<unsigned char>(c) < ' ' && c != '\n' ? '?' : c;
    }
  return safe;
}

std::string htmlElement(const std::string& tag, const std::string& text)
{
  return "<" + tag + ">" + htmlText(text) + "</" + tag + ">\n";
}

std::string HtmlTable::cell(const char* tag, std::size_t column, const std::string& text) const
{
  const bool isNumber = columns_.at(column).rfind('#', 0) == 0;
  return std::string("<") + tag + (isNumber ? " class=\"number\">" : ">") + htmlText(text) + "</" +
         tag + ">";
}

void HtmlTable::addRow(const std::vector<std::string>& cells)
{
  rows_ += "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) rows_ += cell("td", i, cells[i]);
  rows_ += "</tr>\n";
}

std::string HtmlTable::toHtml() const
{
  std::string head;
  bool hasTitles = false;
  for (std::size_t i = 0; i < columns_.size(); ++i)
  {
    head += cell("th", i, columns_[i][0] == '#' ? columns_[i].substr(1) : columns_[i]);
    hasTitles = hasTitles || !columns_[i].empty();
  }
  if (hasTitles) head = "<thead><tr>" + head + "</tr></thead>\n";
  return "<div class=\"wide\"><table>\n" + (hasTitles ? head : "") + "<tbody>\n" + rows_ +
         "</tbody></table></div>\n";
}

}  // namespace quadmap
