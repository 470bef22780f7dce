// Loaded into a program before its own libraries (LD_PRELOAD). When all libraries are linked, which
// takes a tenth of a second of every start, it waits in front of main(). For each request it forks
// a process that goes on into main(), with arguments of its own. The linking is done once for many
// runs, and nothing else is shared.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "ForkProtocol.h"

namespace
{
using namespace quadmap::torture;

using Main = int (*)(int, char**, char**);
Main programMain = nullptr;

void redirect(int descriptor, const std::string& path)
{
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  ::dup2(file, descriptor);
}

/** In the child: becomes a run of the program. */
int run(const std::vector<std::string>& words, char** environment)
{
  ::close(kRequests);
  ::close(kEndings);
  redirect(STDOUT_FILENO, words[0]);
  redirect(STDERR_FILENO, words[1]);
  const rlimit limit{kMachine, kMachine};
  ::setrlimit(RLIMIT_AS, &limit);
  const rlimit time{kSeconds, kSeconds};
  ::setrlimit(RLIMIT_CPU, &time);
  ::alarm(kSecondsWaiting);
  std::vector<char*> arguments;
  for (std::size_t i = 2; i < words.size(); ++i)
    arguments.push_back(const_cast<char*>(words[i].c_str()));
  arguments.push_back(nullptr);
  return programMain(static_cast<int>(arguments.size()) - 1, arguments.data(), environment);
}

int serve(int, char**, char** environment)
{
  while (const auto words = readWords(kRequests))
  {
    const pid_t child = ::fork();
    if (child == 0) return run(*words, environment);
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    const Ended ended{status, usage.ru_maxrss};
    if (::write(kEndings, &ended, sizeof ended) != sizeof ended) return 1;
  }
  return 0;
}

}  // namespace

/** glibc's function that calls main(), with serve() in its place. */
extern "C" int __libc_start_main(
    Main main,
    int argc,
    char** argv,
    Main init,
    void (*fini)(),
    void (*loaderFini)(),
    void* stackEnd)
{
  using Start = int (*)(Main, int, char**, Main, void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  ::unsetenv("LD_PRELOAD");
  programMain = main;
  return start(serve, argc, argv, init, fini, loaderFini, stackEnd);
}
