#pragma once

#include <fcntl.h>
#include <mrpt/3rdparty/tclap/CmdLine.h>
#include <mrpt/system/COutputLogger.h>
#include <mrpt/system/string_utils.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "HelpTable.h"
#include "StopSignals.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/SimilarWords.h"

/** What all programs of the project share: arguments, errors and the exit status.
 *
 *   int main(int argc, char** argv)
 *   {
 *     return quadmap::cli::runMain("quadmap-x", [&] {
 *       quadmap::cli::CommandLine line("quadmap-x", "Does x.", QUADMAP_VERSION);
 *       TCLAP::UnlabeledValueArg<std::string> in("in", "Input.", true, "", "IN", line.args());
 *       if (!line.parse(argc, argv)) return;  // --help or --version was shown
 *       run(in.getValue(), line.verbosity());
 *     });
 *   }
 */
namespace quadmap::cli
{
/** The program was called in a way it does not understand: exit status 2. */
struct UsageError : std::runtime_error
{
  using std::runtime_error::runtime_error;
  UsageError(const std::string& what, std::string ofCommand) :
      std::runtime_error(what), command(std::move(ofCommand))
  {
  }

  std::string command;  //!< Of a program with commands: whose --help helps; else empty
};

/** A closed stream's number would be the first file's that is opened, and what is printed would go
 * there. It is opened the wrong way round instead, so that using it fails. */
inline void keepStandardStreamsApart()
{
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    if (fcntl(stream, F_GETFD) < 0 &&
        open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
      std::abort();
}

/** What was printed is a result, too. \exception std::runtime_error If it did not arrive. */
inline void requirePrinted()
{
  errno = 0;
  std::cout.flush();
  const bool isWhole = std::fflush(stdout) == 0 && std::cout.good() && std::ferror(stdout) == 0;
  if (isWhole) return;
  const std::string why = errno ? std::string(": ") + std::strerror(errno) : "";
  throw std::runtime_error("the standard output cannot be written" + why);
}

/** Runs a program: 0 when `body` returns (or what it returns, if it is an int) and what it printed
 * has arrived, 2 for a UsageError, 1 for every other exception, each with "program: message" on
 * stderr. A signal that ends the program leaves no temporary files. */
template <typename F>
int runMain(const char* program, F&& body) noexcept
{
  keepStandardStreamsApart();
  watchStopSignals();
  try
  {
    int status = 0;
    if constexpr (std::is_same_v<std::invoke_result_t<F>, int>)
      status = body();
    else
      body();
    requirePrinted();
    return status;
  }
  catch (const UsageError& e)
  {
    std::cerr << program << ": " << oneLine(e.what()) << " (see " << program << " "
              << (e.command.empty() ? "" : e.command + " ") << "--help)\n";
    return 2;
  }
  catch (const std::exception& e)
  {
    std::cerr << program << ": " << rootMessage(e) << "\n";
    return 1;
  }
}

/** Does the command line ask for the defaults alone? The arguments that a run requires are then not
 * needed. */
inline bool asksForDefaults(int argc, char** argv)
{
  return argc == 2 && argv[1] == std::string("--defaults");
}

/** TCLAP with strict errors: it would print a page and let parse() return false for bad arguments
 * and for --help alike. */
class StrictOutput : public TCLAP::StdOutput
{
 public:
  explicit StrictOutput(std::string program) : program_(std::move(program)) {}

  void version(TCLAP::CmdLineInterface& line) override
  {
    std::cout << program_ << " " << line.getVersion() << "\n";
  }
  void usage(TCLAP::CmdLineInterface&) override { std::cout << helpText(help); }
  void failure(TCLAP::CmdLineInterface& line, TCLAP::ArgException& e) override
  {
    const std::string missing = missingArguments(line);
    if (e.argId() == " " && !missing.empty()) throw UsageError("missing argument: " + missing);
    const std::string name = nameOf(e);
    throw UsageError((name.empty() ? "" : name + ": ") + plainly(e.error()));
  }

  HelpTable help;  //!< What usage() shows

 private:
  /** "--method", or "COMMAND" for an argument that is told by its place. TCLAP calls the first one
   * "Argument: -m (--method)", a word that is no argument "Argument: WORD", and none " ". */
  std::string nameOf(const TCLAP::ArgException& e) const
  {
    const std::string id = e.argId();
    for (const HelpEntry& entry : help.entries)
      if (id.find("(--" + entry.name + ")") != std::string::npos)
        return (entry.isPositional ? "" : "--") + entry.name;
    return id == " " ? "" : id.substr(id.find(' ') + 1);
  }

  /** What TCLAP complains about, as our own complaints have it. */
  static std::string plainly(const std::string& error)
  {
    const std::string value = "Value ", constraint = " does not meet constraint: ";
    const auto at = error.find(constraint);
    if (at != std::string::npos)
      return otherThan(
          error.substr(at + constraint.size()), error.substr(value.size(), at - value.size()));
    const std::string unreadable = "Couldn't read argument value from string ";
    if (error.rfind(unreadable, 0) == 0)
      return "expected a number, got " + error.substr(unreadable.size());
    if (error.rfind("Missing a value", 0) == 0) return "a value is missing";
    if (error.rfind("Argument already set", 0) == 0) return "is given twice";
    if (error.rfind("Couldn't find match", 0) == 0) return "is one argument too many";
    return error;
  }

  /** "expected a|b, got 'x'", and which of them may be meant. */
  static std::string otherThan(const std::string& expected, const std::string& got)
  {
    HelpEntry entry;
    entry.label = expected;
    const auto meant =
        mostSimilar(mrpt::system::trim(got.substr(1, got.size() - 2)), entry.choices());
    return "expected " + expected + ", got " + got +
           (meant ? "; did you mean " + *meant + "?" : "");
  }

  static std::string missingArguments(TCLAP::CmdLineInterface& line)
  {
    std::string names;
    for (TCLAP::Arg* arg : line.getArgList())
      if (arg->isRequired() && !arg->isSet()) names += (names.empty() ? "" : ", ") + arg->shortID();
    return names;
  }

  std::string program_;
};

/** The arguments of a program, with --help, --version and -v LEVEL. What the arguments are for is
 * told once, where they are declared: --help, the manual page and the completion of the shell are
 * made from that. Builds ask for the last two by "--help-as man" and "--help-as completion". */
class CommandLine
{
 public:
  CommandLine(const std::string& program, const std::string& description, const char* version) :
      output_(program), line_(description, ' ', version)
  {
    output_.help.program = program;
    output_.help.about = description;
    output_.help.version = version;
    line_.setOutput(&output_);
    beginGroup("Options");
  }

  /** A heading for the named arguments that are declared next. */
  void beginGroup(const std::string& name) { groups_.emplace_back(namedArguments(line_), name); }

  /** \param what What the command does, in whole sentences. */
  void addExample(const std::string& command, const std::string& what)
  {
    output_.help.examples.emplace_back(command, what);
  }

  /** For the constructors of TCLAP's arguments. */
  TCLAP::CmdLine& args() { return line_; }

  /** \return False when --help or --version was asked for: nothing is left to do.
   *  \exception UsageError For arguments that are wrong or missing. */
  bool parse(int argc, char** argv)
  {
    output_.help.entries = helpEntriesOf(line_, groups_);
    if (argc == 3 && argv[1] == std::string("--help-as"))
    {
      std::cout << helpAs(argv[2]);
      return false;
    }
    rejectUnknownOptions(argc, argv);
    rejectEmptyNumbers(argc, argv);
    const bool goesOn = line_.parse(argc, argv);
    rejectEmptyTexts();
    return goesOn;
  }

  /** The value of an option may be empty, as that of a list without items. */
  void allowEmpty(const std::string& name) { mayBeEmpty_.insert(name); }

  /** -v debug|info|warn|error, to be given to the loggers of the libraries. */
  mrpt::system::VerbosityLevel verbosity() const
  {
    const std::string& level = verbosity_.getValue();
    if (level == "debug") return mrpt::system::LVL_DEBUG;
    if (level == "warn") return mrpt::system::LVL_WARN;
    if (level == "error") return mrpt::system::LVL_ERROR;
    return mrpt::system::LVL_INFO;
  }

 private:
  std::string helpAs(const std::string& form) const
  {
    const HelpTable& help = output_.help;
    const std::string name = help.program.substr(help.program.rfind(' ') + 1);
    if (form == "man") return manualPage(help);
    if (form == "man-section") return manualSection(help);
    if (form == "completion") return completion(help);
    if (form == "completion-section") return completionSection(help, name);
    throw UsageError("--help-as " + form + ": must be man or completion");
  }

  /** TCLAP takes a misspelt option for a file name where one is expected. */
  void rejectUnknownOptions(int argc, char** argv)
  {
    bool isValue = false;
    for (int i = 1; i < argc && argv[i] != std::string("--"); ++i)
    {
      const std::string word = argv[i];
      const bool isOption = !isValue && word.size() > 1 && word[0] == '-';
      const TCLAP::Arg* option = isOption ? findOption(word) : nullptr;
      if (isOption && !option) throw UsageError(whyUnknown(word));
      isValue = option && option->isValueRequired();
    }
  }

  /** TCLAP takes the default where the value of a number is empty. */
  void rejectEmptyNumbers(int argc, char** argv)
  {
    for (int i = 2; i < argc; ++i)
    {
      const TCLAP::Arg* option = *argv[i] == '\0' ? findOption(argv[i - 1]) : nullptr;
      if (!option || !option->isValueRequired()) continue;
      if (!dynamic_cast<const TCLAP::ValueArg<std::string>*>(option) &&
          !dynamic_cast<const TCLAP::MultiArg<std::string>*>(option))
        throw UsageError("--" + option->getName() + ": expected a number, got ''");
    }
  }

  /** An empty text would count as not given. */
  void rejectEmptyTexts()
  {
    for (TCLAP::Arg* arg : line_.getArgList())
    {
      const std::string& name = arg->getName();
      if (!arg->isSet() || !hasEmptyText(arg) || mayBeEmpty_.count(name)) continue;
      const bool hasPlace = dynamic_cast<const TCLAP::UnlabeledValueArg<std::string>*>(arg) ||
                            dynamic_cast<const TCLAP::UnlabeledMultiArg<std::string>*>(arg);
      throw UsageError((hasPlace ? "" : "--") + name + ": must not be empty");
    }
  }

  /** Whether the value of an argument, or one of its values, is an empty text. */
  static bool hasEmptyText(TCLAP::Arg* arg)
  {
    if (auto* one = dynamic_cast<TCLAP::ValueArg<std::string>*>(arg))
      return one->getValue().empty();
    auto* several = dynamic_cast<TCLAP::MultiArg<std::string>*>(arg);
    if (!several) return false;
    const auto& values = several->getValue();
    return std::find(values.begin(), values.end(), "") != values.end();
  }

  /** Why a word is no option, with what may be meant by --ouptut, -output or --output=FILE. */
  std::string whyUnknown(const std::string& word)
  {
    const std::string option = word.substr(0, word.find('='));
    if (const TCLAP::Arg* known = findOption(option))
      return word + ": " + option +
             (known->isValueRequired() ? " takes its value after a blank" : " takes no value");
    std::vector<std::string> names;
    for (const HelpEntry& entry : output_.help.entries)
      if (!entry.isPositional) names.push_back(entry.name);
    const auto begin = option.find_first_not_of('-');
    const std::string name = begin == std::string::npos ? "" : option.substr(begin);
    const auto meant = mostSimilar(mrpt::system::lowerCase(name), names);
    return "unknown option " + word + (meant ? "; did you mean --" + *meant + "?" : "");
  }

  const TCLAP::Arg* findOption(const std::string& word)
  {
    for (const TCLAP::Arg* arg : line_.getArgList())
      if (word == "--" + arg->getName() ||
          (!arg->getFlag().empty() && word == "-" + arg->getFlag()))
        return arg;
    return nullptr;
  }

  StrictOutput output_;
  TCLAP::CmdLine line_;
  std::set<std::string> mayBeEmpty_;
  std::vector<std::pair<std::size_t, std::string>> groups_{
      {0, kGeneralGroup}
  };
  std::vector<std::string> levels_{"debug", "info", "warn", "error"};
  TCLAP::ValuesConstraint<std::string> levelsConstraint_{levels_};
  mutable TCLAP::ValueArg<std::string> verbosity_{
      "v",  "verbosity", "How much to tell on the terminal.", false, "info", &levelsConstraint_,
      line_};
};

/** As a member between arguments: those after it stand below this heading. */
struct Group
{
  Group(CommandLine& line, const std::string& name) { line.beginGroup(name); }
};

/** As a member: an example of the program. */
struct Example
{
  Example(CommandLine& line, const std::string& command, const std::string& what)
  {
    line.addExample(command, what);
  }
};

}  // namespace quadmap::cli
