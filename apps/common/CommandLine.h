#pragma once

#include <mrpt/3rdparty/tclap/CmdLine.h>
#include <mrpt/system/COutputLogger.h>

#include <iostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "StopSignals.h"
#include "quadmap/base/ErrorText.h"

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
};

/** Runs a program: 0 when `body` returns (or what it returns, if it is an int), 2 for a UsageError,
 * 1 for every other exception, each with "program: message" on stderr. A signal that ends the
 * program leaves no temporary files. */
template <typename F>
int runMain(const char* program, F&& body) noexcept
{
  watchStopSignals();
  try
  {
    if constexpr (std::is_same_v<std::invoke_result_t<F>, int>)
      return body();
    else
    {
      body();
      return 0;
    }
  }
  catch (const UsageError& e)
  {
    std::cerr << program << ": " << oneLine(e.what()) << " (see " << program << " --help)\n";
    return 2;
  }
  catch (const std::exception& e)
  {
    std::cerr << program << ": " << rootMessage(e) << "\n";
    return 1;
  }
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
  void usage(TCLAP::CmdLineInterface& line) override
  {
    line.getProgramName() = program_;  // not the whole path
    StdOutput::usage(line);
  }
  void failure(TCLAP::CmdLineInterface& line, TCLAP::ArgException& e) override
  {
    const std::string missing = missingArguments(line);
    if (e.argId() == " " && !missing.empty()) throw UsageError("missing argument: " + missing);
    throw UsageError(e.argId() == " " ? e.error() : e.error() + " - " + e.argId());
  }

 private:
  static std::string missingArguments(TCLAP::CmdLineInterface& line)
  {
    std::string names;
    for (TCLAP::Arg* arg : line.getArgList())
      if (arg->isRequired() && !arg->isSet()) names += (names.empty() ? "" : ", ") + arg->shortID();
    return names;
  }

  std::string program_;
};

/** The arguments of a program, with --help, --version and -v LEVEL. */
class CommandLine
{
 public:
  CommandLine(const std::string& program, const std::string& description, const char* version) :
      output_(program), line_(description, ' ', version)
  {
    line_.setOutput(&output_);
  }

  /** For the constructors of TCLAP's arguments. */
  TCLAP::CmdLine& args() { return line_; }

  /** \return False when --help or --version was asked for: nothing is left to do.
   *  \exception UsageError For arguments that are wrong or missing. */
  bool parse(int argc, char** argv)
  {
    rejectUnknownOptions(argc, argv);
    return line_.parse(argc, argv);
  }

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
  /** TCLAP takes a misspelt option for a file name where one is expected. */
  void rejectUnknownOptions(int argc, char** argv)
  {
    bool isValue = false;
    for (int i = 1; i < argc && argv[i] != std::string("--"); ++i)
    {
      const std::string word = argv[i];
      const bool isOption = !isValue && word.size() > 1 && word[0] == '-';
      const TCLAP::Arg* option = isOption ? findOption(word) : nullptr;
      if (isOption && !option) throw UsageError("unknown option " + word);
      isValue = option && option->isValueRequired();
    }
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
  std::vector<std::string> levels_{"debug", "info", "warn", "error"};
  TCLAP::ValuesConstraint<std::string> levelsConstraint_{levels_};
  mutable TCLAP::ValueArg<std::string> verbosity_{
      "v",  "verbosity", "How much to tell on the terminal.", false, "info", &levelsConstraint_,
      line_};
};

}  // namespace quadmap::cli
