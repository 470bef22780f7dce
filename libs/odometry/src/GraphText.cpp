#include "GraphText.h"

#include <mrpt/core/format.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/Words.h"
#include "quadmap/obs/Plausible.h"

namespace quadmap
{
namespace
{
using mrpt::graphs::TNodeID;

bool startsWith(const std::string& word, const char* begin) { return word.rfind(begin, 0) == 0; }

class GraphLines
{
 public:
  explicit GraphLines(const std::string& path) : path_(path) {}

  void add(const std::string& line)
  {
    constexpr unsigned kMost = 400'000;  // 100,000 poses with edges; 0.7 kB of memory each
    if (++line_ > kMost) fail(line_, mrpt::format("a graph may have %u lines", kMost));
    if (line.find('\0') != std::string::npos) fail(line_, "has a zero byte");
    std::istringstream words(line);
    std::string first;
    if (!(words >> first)) return;
    if (first[0] == '#')
      addComment(line);
    else
      addEntry(first, words);
  }

  void requireNodesOfEdges() const
  {
    for (const auto& [line, node] : ends_)
      if (lineOfNode_.count(node) == 0)
        fail(line, mrpt::format("an edge of node %u, which is not there", unsigned(node)));
  }

  const std::vector<NodeTime>& times() const { return times_; }

 private:
  [[noreturn]] void fail(unsigned line, const std::string& what) const
  {
    throw std::runtime_error(placeOf(line) + ": " + what);
  }
  std::string placeOf(unsigned line) const { return mrpt::format("%s:%u", path_.c_str(), line); }

  void addEntry(const std::string& entry, std::istringstream& text)
  {
    static const std::set<std::string> known = {
        "VERTEX", "VERTEX2",  "VERTEX_SE2", "VERTEX3",       "VERTEX_SE3:QUAT", "EDGE",
        "EDGE2",  "EDGE_SE2", "EDGE3",      "EDGE_SE3:QUAT", "EQUIV",           "FIX"};
    if (known.count(entry) == 0) fail(line_, quotedWord(entry) + " is no entry of a pose graph");
    std::vector<std::string> numbers;
    for (std::string word; text >> word; numbers.push_back(word)) requireNumber(word);
    requireQuaternion(entry, numbers);
    if (startsWith(entry, "VERTEX") && !numbers.empty()) addNode(nodeFrom(numbers[0]));
    for (std::size_t i = 0; startsWith(entry, "EDGE") && i < 2 && i < numbers.size(); ++i)
      ends_.emplace_back(line_, nodeFrom(numbers[i]));
  }

  void requireNumber(const std::string& word) const
  {
    constexpr double kLargest = 1e15;  // of a coordinate or an information
    const auto number = parseNumber(word);
    if (!number || !(std::abs(*number) <= kLargest))
      fail(line_, quotedWord(word) + " is not a number of a pose graph");
  }

  /** \param numbers Those of an entry. Of too few MRPT's reader tells. */
  void requireQuaternion(const std::string& entry, const std::vector<std::string>& numbers) const
  {
    if (entry != "VERTEX_SE3:QUAT" && entry != "EDGE_SE3:QUAT") return;
    const std::size_t first = entry == "EDGE_SE3:QUAT" ? 5 : 4;  // behind nodes and a position
    Eigen::Vector4d q;                                           // x, y, z, w
    if (numbers.size() < first + 4) return;
    for (std::size_t i = 0; i < 4; ++i) q[static_cast<int>(i)] = *parseNumber(numbers[first + i]);
    if (const auto why = whyNoUnitQuaternion(Eigen::Quaterniond(q)))
      fail(line_, "the quaternion " + *why);
  }

  /** \param word A number, see requireNumber(). */
  TNodeID nodeFrom(const std::string& word) const
  {
    if (word.find_first_not_of("0123456789") != std::string::npos)
      fail(line_, quotedWord(word) + " is not the number of a node");
    return std::stoull(word);
  }

  void addNode(TNodeID node)
  {
    const auto [known, isNew] = lineOfNode_.emplace(node, line_);
    if (!isNew)
      fail(line_, mrpt::format("node %u is in line %u already", unsigned(node), known->second));
  }

  void addComment(const std::string& line)
  {
    std::istringstream words(line);
    std::string hash, name;
    if (!(words >> hash >> name) || hash != "#" || name != "TIME") return;
    NodeTime t;
    if (!(words >> t.node >> t.time) || !std::isfinite(t.time))
      fail(line_, "expected # TIME node seconds");
    t.place = placeOf(line_);
    const auto [other, isNew] = nodeAt_.emplace(t.time, t.node);
    if (!isNew && other->second != t.node)
      fail(
          line_, mrpt::format(
                     "node %u has the time of node %u", unsigned(t.node), unsigned(other->second)));
    times_.push_back(t);
  }

  std::string path_;
  unsigned line_ = 0;
  std::map<TNodeID, unsigned> lineOfNode_;
  std::vector<std::pair<unsigned, TNodeID>> ends_;  // of edges: line and node
  std::map<double, TNodeID> nodeAt_;
  std::vector<NodeTime> times_;
};

}  // namespace

std::vector<NodeTime> checkGraphText(const std::string& text, const std::string& path)
{
  GraphLines graph(path);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) graph.add(line);
  graph.requireNodesOfEdges();
  return graph.times();
}

}  // namespace quadmap
