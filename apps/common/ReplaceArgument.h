#pragma once

#include "CommandLine.h"

namespace quadmap::cli
{
/** The argument of programs that a signal may stop early (see RunFolder). */
struct ReplaceArgument : TCLAP::SwitchArg
{
  explicit ReplaceArgument(TCLAP::CmdLine& line) :
      TCLAP::SwitchArg(
          "",
          "replace",
          "A run that Ctrl-C stops early replaces even the result of a complete run in OUTDIR; "
          "without it, its files go into OUTDIR/interrupted then.",
          line)
  {
  }
};

}  // namespace quadmap::cli
