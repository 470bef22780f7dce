#include "quadmap/dense/ProposalFile.h"

#include <mrpt/config/CConfigFile.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <cctype>
#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/OptionGroup.h"
#include "quadmap/base/OptionList.h"

namespace quadmap
{
namespace
{
const std::string kSection = "object ";

/** Whether a byte of a label stands in the file as it is: INI files give others a meaning. */
bool isPlain(const std::string& label, std::size_t at)
{
  const auto byte = static_cast<unsigned char>(label[at]);
  if (byte == ' ') return at > 0 && at + 1 < label.size();  // around a value they are dropped
  return byte < 0x80 && (std::isalnum(byte) || byte == '_' || byte == '-' || byte == '.');
}

/** A label as the file has it: other bytes than plain ones are %XX, as in web addresses. */
std::string encoded(const std::string& label)
{
  std::string text;
  for (std::size_t i = 0; i < label.size(); ++i)
    text += isPlain(label, i) ? std::string(1, label[i])
                              : mrpt::format("%%%02X", static_cast<unsigned char>(label[i]));
  return text;
}

/** The opposite of encoded(). \exception std::invalid_argument For a % without two digits. */
std::string decoded(const std::string& text)
{
  std::string label;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (text[i] != '%')
    {
      label += text[i];
      continue;
    }
    const std::string digits = text.substr(i + 1, 2);
    if (digits.size() != 2 || !std::isxdigit(static_cast<unsigned char>(digits[0])) ||
        !std::isxdigit(static_cast<unsigned char>(digits[1])))
      throw std::invalid_argument(
          "label=" + text + ": after % must be two hexadecimal digits (%25 is the sign itself)");
    label += static_cast<char>(std::stoi(digits, nullptr, 16));
    i += 2;
  }
  return label;
}

/** One section of a file of proposals. */
struct ProposalEntry : public OptionGroup
{
  std::string label;
  bool accept = false, orientationDefined = true;
  Eigen::Vector3d center = Eigen::Vector3d::Zero(), size = Eigen::Vector3d::Zero();
  double yaw = 0;  // [rad]

 protected:
  void describe(OptionList& list) override
  {
    list.text(
        "label", [this] { return encoded(label); },
        [this](const std::string& text) { label = decoded(text); }, "a text",
        "Class of the object.");
    list.flag("accept", accept, "Whether the object becomes a part of the truth.");
    list.vector("center", center.data(), {-1e6, 1e6}, "m", "Centre of the cuboid in the map.");
    list.vector("size", size.data(), {1e-4, 1e4}, "m", "Full edge lengths of the cuboid.");
    list.angle("yaw_deg", yaw, {-360, 360}, "Heading of its x axis about the vertical.");
    list.flag("orientation_defined", orientationDefined, "Whether the heading means something.");
    list.require([this] { return size.minCoeff() > 0; }, "size: must be there, of numbers > 0");
  }
};

std::string numbersText(const Eigen::Vector3d& v)
{
  return mrpt::format("%.4f %.4f %.4f", v.x(), v.y(), v.z());
}

/** The names of the sides of which something holds. */
template <std::size_t N>
std::string sidesText(const std::array<bool, N>& sides, bool value)
{
  constexpr const char* kNames[] = {"+x", "-x", "+y", "-y", "the top"};
  std::string names;
  for (std::size_t side = 0; side < N; ++side)
    if (sides[side] == value) names += (names.empty() ? "" : ", ") + std::string(kNames[side]);
  return names;
}

/** Why a proposal is sure or not. */
std::string reasonText(const CuboidProposal& proposal)
{
  const std::string unseen = sidesText(proposal.seen, false),
                    touched = sidesText(proposal.touched, true);
  std::string text =
      unseen.empty() ? "all sides were seen" : "not seen along its length: " + unseen;
  if (!touched.empty()) text += "; other things are at " + touched;
  return text;
}

std::string sectionText(const CuboidProposal& proposal)
{
  const ObjectRecord& record = proposal.record;
  mrpt::poses::CPose3D pose = record.object.pose();
  return "\n[" + kSection + record.id + "]\n" + mrpt::format("; %zu points; ", proposal.points) +
         reasonText(proposal) + "\nlabel = " + encoded(record.label) +
         "\naccept = " + (proposal.fullySeen() ? "yes" : "no") +
         "\ncenter = " + numbersText(record.object.center()) +
         "\nsize = " + numbersText(2 * record.object.semiAxes()) +
         mrpt::format("\nyaw_deg = %.2f", mrpt::RAD2DEG(pose.yaw())) +
         "\norientation_defined = " + (record.orientationDefined ? "yes" : "no") + "\n";
}

/** \exception std::invalid_argument For a section that is no proposal. */
JudgedProposal readSection(const mrpt::config::CConfigFileBase& config, const std::string& section)
{
  ProposalEntry entry;
  entry.loadFromConfigFile(config, section);
  for (const char* key : {"label", "center"})
    if (!config.keyExists(section, key))
      throw std::invalid_argument("[" + section + "] " + key + ": must be there");
  JudgedProposal proposal;
  proposal.accept = entry.accept;
  proposal.record.id = section.substr(kSection.size());
  proposal.record.label = entry.label;
  proposal.record.orientationDefined = entry.orientationDefined;
  const Eigen::Vector3d& c = entry.center;
  proposal.record.object =
      Ellipsoid(mrpt::poses::CPose3D(c.x(), c.y(), c.z(), entry.yaw, 0, 0), 0.5 * entry.size);
  return proposal;
}

}  // namespace

std::vector<JudgedProposal> judged(const std::vector<CuboidProposal>& proposals)
{
  std::vector<JudgedProposal> out;
  for (const CuboidProposal& proposal : proposals)
    out.push_back({proposal.record, proposal.fullySeen()});
  return out;
}

std::string proposalText(const std::vector<CuboidProposal>& proposals)
{
  std::string text =
      "; Proposals of quadmap-annotate. Look at the picture of each, correct what is wrong "
      "(metres,\n"
      "; degrees), say accept = yes or no, and run quadmap-annotate again.\n";
  for (const CuboidProposal& proposal : proposals) text += sectionText(proposal);
  return text;
}

std::vector<JudgedProposal> readProposals(const std::string& path)
{
  requireReadableIni(path);
  const mrpt::config::CConfigFile config(path);
  std::vector<std::string> sections;
  config.getAllSections(sections);
  std::vector<JudgedProposal> proposals;
  for (const std::string& section : sections)
  {
    if (section.rfind(kSection, 0) != 0 || section.size() == kSection.size())
      throw std::invalid_argument(path + ": [" + section + "]: expected [object ID]");
    try
    {
      proposals.push_back(readSection(config, section));
    }
    catch (const std::invalid_argument& e)
    {
      throw std::invalid_argument(path + ": " + e.what());
    }
    catch (const std::exception& e)  // of MRPT, which does not name the section
    {
      throw std::invalid_argument(path + ": [" + section + "]: " + rootMessage(e));
    }
  }
  return proposals;
}

}  // namespace quadmap
