#include "quadmap/base/OutputSet.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "FileSystem.h"
#include "quadmap/base/InsideFolder.h"
#include "quadmap/base/OutputFile.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* kStagingEnd = ".partial";  //!< Ends the names of hidden folders
constexpr const char* kListName = ".exchange";   //!< The list of files in such a folder

/** A set has nothing but files and folders of its own folder. The list may have come with a
 * stranger's files. */
bool isPlainName(const fs::path& name)
{
  return name == name.filename() && name != "." && name != "..";
}

/** Entries end with a zero, as names may hold any other byte. */
std::vector<std::string> readList(const fs::path& staging)
{
  constexpr std::uintmax_t kMostBytes = 1u << 24;  // a name has up to 255; a set some thousand
  std::vector<std::string> entries;
  std::error_code error;
  const fs::path list = staging / kListName;
  if (!fs::is_regular_file(fs::symlink_status(list, error))) return entries;
  if (fs::file_size(list, error) > kMostBytes) return entries;
  std::ifstream file(list, std::ios::binary);
  for (std::string entry; std::getline(file, entry, '\0');)
    if (entry.size() > 1 && isPlainName(entry.substr(1))) entries.push_back(entry);
  return entries;
}

bool isStaging(const fs::path& path)
{
  const std::string name = path.filename().string(), end = kStagingEnd;
  return name.size() > end.size() && name[0] == '.' &&
         name.compare(name.size() - end.size(), end.size(), end) == 0;
}

/** Copies a file to another file system, or into a device. */
void copyTo(const fs::path& from, const fs::path& to)
{
  OutputFile output(to.string());
  errno = 0;
  std::ifstream source(from, std::ios::binary);
  std::ofstream copy(output.temporaryPath(), std::ios::binary);
  if (source.peek() != std::ifstream::traits_type::eof()) copy << source.rdbuf();
  copy.close();  // flushes: the other place where a full disk shows
  if (source.bad() || !copy) failToWrite(to.string(), errno != 0 ? errno : EIO);
  output.commit();
  fs::remove(from);
}

void moveTo(const fs::path& from, const fs::path& finalPath)
{
  const fs::path to = withoutLink(finalPath);
  if (const auto permissions = permissionsOf(to)) ::chmod(from.c_str(), *permissions);
  if (::rename(from.c_str(), to.c_str()) == 0) return;
  if (errno != EXDEV) failToWrite(finalPath.string(), errno);
  copyTo(from, to);
}

/** Why a path does not lead to a place in a folder, with the path; nothing when it does. */
std::optional<std::string> whyNotInside(const fs::path& path, const fs::path& folder)
try
{
  if (isInside(path, folder)) return std::nullopt;
  return path.string() + ": is a link out of its folder";
}
catch (const std::runtime_error& e)  // a circle of links
{
  return e.what();
}

/** Completing the work of a killed program puts what is staged where links lead. A stranger's
 * folder may have both: the staged file and the link. \exception std::runtime_error Names a link
 * that leads out of its folder, or in a circle. */
void requireNoWayOut(
    const fs::path& folder, const fs::path& staging, const std::vector<std::string>& entries)
{
  for (const auto& entry : entries)
    for (const fs::path& place : {folder, staging})
    {
      const fs::path path = place / entry.substr(1);
      if (entry[0] == '-') continue;  // removes the link itself
      if (const auto why = whyNotInside(path, place.empty() ? "." : place))
        throw std::runtime_error(*why + ", and a killed program left it to be written: remove it");
    }
}

/** Gives all entries their names. Those that have theirs from an earlier try stay as they are. */
void exchangeEntries(
    const fs::path& folder, const fs::path& staging, const std::vector<std::string>& entries)
{
  for (const auto& entry : entries)
  {
    const std::string name = entry.substr(1);
    std::error_code ignored;
    if (entry[0] == '-')
      fs::remove(folder / name, ignored);
    else if (fs::exists(staging / name, ignored))
      moveTo(staging / name, folder / name);
  }
  syncFolder(folder);
}

/** \return Descriptor of the folder, which is made if needed and locked. */
int lockedFolder(const std::string& staging, const std::string& shown)
{
  for (;;)
  {
    if (::mkdir(staging.c_str(), S_IRWXU) != 0 && errno != EEXIST) failToWrite(shown, errno);
    const int descriptor = ::open(staging.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0 && errno == ENOENT) continue;  // another program just removed it
    if (descriptor < 0) failToWrite(staging, errno);  // a file or a link, too
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    {
      ::close(descriptor);
      throw std::runtime_error(
          shown + ": another program is writing it now; wait for its end or choose another name");
    }
    struct stat locked, named;
    if (::fstat(descriptor, &locked) == 0 && ::stat(staging.c_str(), &named) == 0 &&
        locked.st_ino == named.st_ino && locked.st_dev == named.st_dev)
      return descriptor;
    ::close(descriptor);  // another program removed it before it was locked
  }
}

}  // namespace

OutputSet::OutputSet(std::string folder, const std::string& name) :
    folder_(std::move(folder)), staging_(named("." + name + kStagingEnd))
{
  const auto pause = Temporary::pause();
  lock_ = lockedFolder(staging_, named(name));
  try
  {
    const auto left = readList(staging_);  // by a program that was killed while it exchanged
    requireNoWayOut(folder_, staging_, left);
    exchangeEntries(folder_, staging_, left);
    for (const auto& old : fs::directory_iterator(staging_)) fs::remove_all(old.path());
    temporary_.emplace(staging_);
  }
  catch (...)
  {
    ::close(lock_);
    throw;
  }
}

OutputSet::~OutputSet()
{
  temporary_.reset();
  ::close(lock_);
}

std::string OutputSet::add(const std::string& name)
{
  std::error_code ignored;
  if (fs::is_directory(named(name), ignored)) failToWrite(named(name), EISDIR);
  entries_.push_back("+" + name);
  return written(name);
}

std::string OutputSet::addFolder(const std::string& name)
{
  std::error_code error;
  if (fs::exists(named(name), error))
    throw std::runtime_error(
        named(name) + ": exists already; remove it or choose another output name");
  if (!fs::create_directory(written(name), error)) failToWrite(named(name), error.value());
  entries_.push_back("+" + name);
  return written(name);
}

std::string OutputSet::named(const std::string& name) const
{
  return (fs::path(folder_) / name).string();  // without a folder it is the name alone
}

std::vector<std::string> OutputSet::names() const
{
  std::vector<std::string> names;
  for (const auto& entry : entries_)
    if (entry[0] == '+') names.push_back(entry.substr(1));
  return names;
}

void OutputSet::addRemoval(const std::string& name) { entries_.push_back("-" + name); }

void OutputSet::commit()
{
  prepare();
  const auto pause = Temporary::pause();
  promise();
  exchange();
}

void OutputSet::prepare()
{
  for (const auto& name : names())
    if (!fs::exists(written(name))) failToWrite(written(name), ENOENT);
  // What a device has got cannot be taken back, and it may refuse: the other files come after it.
  for (const auto& name : names())
    if (const fs::path to = withoutLink(named(name)); isDevice(to)) copyTo(written(name), to);
  // Writers of ours synchronise each file, but folders have files of other writers.
  if (::syncfs(lock_) != 0) failToWrite(folder_.empty() ? "." : folder_, errno);
}

void OutputSet::promise()
{
  std::string list;
  for (const auto& entry : entries_) list += entry + '\0';
  writeTextFile(staging_ + "/" + kListName, list);
}

void OutputSet::exchange()
{
  const auto pause = Temporary::pause();
  temporary_->keep();  // whoever comes next completes what fails from here on
  exchangeEntries(folder_, staging_, entries_);
  fs::remove_all(staging_);
}

void requireOneRun(const std::string& file)
{
  for (const fs::path& path : linkChain(file))
  {
    std::error_code error;
    const std::string wanted = path.filename().string();
    const fs::path folder = path.parent_path(), listed = folder.empty() ? "." : folder;
    for (fs::directory_iterator it(listed, error), end; !error && it != end; it.increment(error))
    {
      if (!isStaging(it->path())) continue;
      const auto entries = readList(it->path());
      const auto isWanted = [&](const std::string& e) { return e.substr(1) == wanted; };
      if (std::any_of(entries.begin(), entries.end(), isWanted))
        throw std::runtime_error(
            file +
            ": belongs to two runs: one was killed while it replaced the files of another (" +
            (folder / it->path().filename()).string() + " has the rest); run it again");
    }
  }
}

std::string pathAfterCommit(const std::string& path)
{
  const fs::path whole(path);
  const fs::path folder = whole.parent_path();
  return isStaging(folder) ? (folder.parent_path() / whole.filename()).string() : path;
}

}  // namespace quadmap
