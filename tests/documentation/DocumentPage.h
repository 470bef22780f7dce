#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace quadmap
{
/** Commands of a page that stand together: an indented block, or a fence of ```bash. */
struct CommandBlock
{
  int line = 0;  //!< of the page, from 1
  std::string commands;
  std::string exempt;  //!< Why the tests do not run it; empty: they do
};

/** A page of the documentation as the tests read it. Comments in it say what to do with the block
 * that follows:
 *
 *   <!-- not run by tests: REASON -->          and all blocks to the end of the page with
 *   <!-- not run by tests from here on: REASON -->
 *   <!-- file: NAME -->                        the fence is the content of that file
 */
class DocumentPage
{
 public:
  explicit DocumentPage(const std::filesystem::path& path) : path_(path)
  {
    std::ifstream in(path);
    std::string line;
    while (std::getline(in, line)) lines_.push_back(line);
    if (lines_.empty()) throw std::runtime_error(path.string() + ": empty or missing");
    while (at_ < lines_.size()) readNext();
  }

  const std::vector<CommandBlock>& blocks() const { return blocks_; }
  /** Contents by name. */
  const std::map<std::string, std::string>& files() const { return files_; }

 private:
  static constexpr const char* kIndent = "    ";

  bool startsWith(const std::string& text) const { return lines_[at_].rfind(text, 0) == 0; }

  /** Takes what is between `start` and "-->" if the line is such a comment. */
  bool takeComment(const std::string& start, std::string& content)
  {
    if (!startsWith("<!-- " + start)) return false;
    const auto from = start.size() + 5, to = lines_[at_].find(" -->");
    if (to == std::string::npos || to <= from)
      throw std::runtime_error(path_.string() + ": comment without content or end: " + lines_[at_]);
    content = lines_[at_++].substr(from, to - from);
    return true;
  }

  void readNext()
  {
    const bool afterBlank = at_ == 0 || lines_[at_ - 1].empty();
    if (takeComment("not run by tests: ", exempt_) || takeComment("file: ", file_)) return;
    if (takeComment("not run by tests from here on: ", exemptRest_)) return;
    if (startsWith("```"))
      readFence();
    else if (startsWith(kIndent) && afterBlank)
      readIndented();
    else
      ++at_;
  }

  void readFence()
  {
    const int first = static_cast<int>(at_) + 1;
    const bool isCommands = lines_[at_] == "```bash" || lines_[at_] == "```sh";
    std::string content;
    while (++at_ < lines_.size() && lines_[at_] != "```") content += lines_[at_] + "\n";
    ++at_;
    if (isCommands) add(first, content);
    if (!file_.empty()) files_[file_] = content;
    file_.clear();
  }

  void readIndented()
  {
    const int first = static_cast<int>(at_) + 1;
    std::string content;
    for (; at_ < lines_.size() && (startsWith(kIndent) || continuesAfterBlank()); ++at_)
      content += (lines_[at_].empty() ? "" : lines_[at_].substr(4)) + "\n";
    add(first, content);
  }

  bool continuesAfterBlank() const
  {
    return lines_[at_].empty() && at_ + 1 < lines_.size() && lines_[at_ + 1].rfind(kIndent, 0) == 0;
  }

  void add(int line, const std::string& commands)
  {
    blocks_.push_back({line, commands, exemptRest_.empty() ? exempt_ : exemptRest_});
    exempt_.clear();
  }

  std::filesystem::path path_;
  std::vector<std::string> lines_;
  std::size_t at_ = 0;
  std::string exempt_, exemptRest_, file_;
  std::vector<CommandBlock> blocks_;
  std::map<std::string, std::string> files_;
};

}  // namespace quadmap
