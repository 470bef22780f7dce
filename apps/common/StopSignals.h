#pragma once

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "quadmap/base/Temporary.h"

/** What Ctrl-C, SIGTERM, SIGQUIT (Ctrl-\) and the end of the terminal do. A thread of its own
 * receives these signals, so that what they do may take locks and remove files. */
namespace quadmap::cli
{
enum class OnStop
{
  End,   //!< The program ends at once, without temporary files
  Note,  //!< The program goes on and ends soon; a second signal, or SIGQUIT, ends it at once
  Defer  //!< The program goes on, whatever comes: it is about to end
};

inline std::atomic<OnStop> onStop{OnStop::End};
inline std::atomic<int> stopSignal{0};  //!< The first signal that was noted, or 0

/** Ends the program as the signal does by default. */
[[noreturn]] inline void endBySignal(int signal)
{
  Temporary::removeAll();
  std::signal(signal, SIG_DFL);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  ::raise(signal);
  ::_exit(128 + signal);
}

/** Whether whoever started the program wants it to ignore a signal: nohup, SIGHUP, and a shell that
 * starts it in the background, SIGQUIT. */
inline bool isIgnored(int signal)
{
  struct sigaction action = {};
  ::sigaction(signal, nullptr, &action);
  return action.sa_handler == SIG_IGN;
}

inline void receiveStopSignals(sigset_t signals)
{
  for (;;)
  {
    int signal = 0;
    if (sigwait(&signals, &signal) != 0) continue;
    const bool endsAtOnce = signal == SIGQUIT ? onStop != OnStop::Defer : onStop == OnStop::End;
    if (endsAtOnce) endBySignal(signal);
    int none = 0;
    stopSignal.compare_exchange_strong(none, signal);
    auto note = OnStop::Note;
    onStop.compare_exchange_strong(note, OnStop::End);
  }
}

/** To be called before any other thread starts: they inherit which signals they do not receive. A
 * limit on the size of files makes their writing fail, as a full disk does, and so does the end of
 * whoever reads what is printed: the files of a run matter more than its messages. */
inline void watchStopSignals()
{
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  for (const int signal : {SIGHUP, SIGQUIT})
    if (!isIgnored(signal)) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  std::thread(receiveStopSignals, signals).detach();
}

}  // namespace quadmap::cli
