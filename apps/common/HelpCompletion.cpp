#include <algorithm>

#include "HelpTable.h"

namespace quadmap::cli
{
namespace
{
std::string functionOf(std::string program)
{
  std::replace(program.begin(), program.end(), '-', '_');
  return "_" + program;
}

std::string joined(const std::vector<std::string>& words, const char* between)
{
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::vector<std::string> spellings(const HelpEntry& entry)
{
  if (entry.flag == "-") return {};  // "--"
  std::vector<std::string> words{"--" + entry.name};
  if (!entry.flag.empty()) words.push_back("-" + entry.flag);
  return words;
}

/** Sets what the call may go on with: $options, $words for arguments without names, and for the
 * value of the option before $values, $file, or $other when nobody can tell. */
std::string settings(const HelpTable& table, const std::string& indent)
{
  std::vector<std::string> options, words, files, others;
  std::string cases;
  for (const auto& entry : table.entries)
  {
    const auto choices = entry.choices();
    if (entry.isPositional)
    {
      words.insert(words.end(), choices.begin(), choices.end());
      continue;
    }
    const auto names = spellings(entry);
    options.insert(options.end(), names.begin(), names.end());
    if (!choices.empty())
      cases += indent + "  " + joined(names, "|") + ") values='" + joined(choices, " ") + "' ;;\n";
    else if (!entry.label.empty())
    {
      auto& list = entry.takesPath() ? files : others;
      list.insert(list.end(), names.begin(), names.end());
    }
  }
  if (!files.empty()) cases += indent + "  " + joined(files, "|") + ") file=yes ;;\n";
  if (!others.empty()) cases += indent + "  " + joined(others, "|") + ") other=yes ;;\n";
  return indent + "options='" + joined(options, " ") + "' words='" + joined(words, " ") + "'\n" +
         (cases.empty() ? "" : indent + "case $before in\n" + cases + indent + "esac\n");
}

std::string head(const std::string& program)
{
  return "# Completion of " + program + " for bash.\n" + functionOf(program) +
         "()\n{\n  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local options= words= values= file= other=\n";
}
}  // namespace

std::string completion(const HelpTable& table)
{
  return head(table.program) + settings(table, "  ") + completionTail(table.program);
}

std::string completionHead(const std::string& program, const std::vector<std::string>& commands)
{
  return head(program) + "  if ((COMP_CWORD == 1)); then values='" + joined(commands, " ") +
         " --help --version'; fi\n  case ${COMP_WORDS[1]} in\n";
}

std::string completionSection(const HelpTable& command, const std::string& name)
{
  return "  " + name + ")\n" + settings(command, "    ") + "    ;;\n";
}

std::string completionTail(const std::string& program, bool afterCommands)
{
  return std::string(afterCommands ? "  esac\n" : "") +
         "  if [[ -n $other ]]; then\n    COMPREPLY=()\n"
         "  elif [[ -n $values ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$values\" -- \"$current\")\n"
         "  elif [[ -z $file && $current == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\")\n"
         "  else\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\"; compgen -f -- "
         "\"$current\")\n"
         "  fi\n}\ncomplete -o filenames -F " +
         functionOf(program) + " " + program + "\n";
}

}  // namespace quadmap::cli
