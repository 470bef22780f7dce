#include "quadmap/dense/ProposalFile.h"

#include <gtest/gtest.h>

#include "../obs/TemporaryFolder.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
CuboidProposal sampleProposal(const std::string& id, bool isSeen)
{
  CuboidProposal proposal;
  proposal.record.id = id;
  proposal.record.label = "dining table";
  proposal.record.orientationDefined = isSeen;
  proposal.record.object = Ellipsoid(CPose3D(1, -2, 0.4, 0.7, 0, 0), {0.5, 0.3, 0.4});
  proposal.points = 99;
  proposal.seen = {isSeen, true, true, true, true};
  return proposal;
}
}  // namespace

TEST(ProposalFile, IsReadAsItWasWritten)
{
  const TemporaryFolder folder;
  const std::vector<CuboidProposal> proposals{
      sampleProposal("3", true), sampleProposal("12", false)};
  const std::string text = proposalText(proposals);
  EXPECT_NE(text.find("not seen along its length: +x\n"), std::string::npos) << text;
  const auto expected = judged(proposals);
  const auto found = readProposals(folder.write("p.ini", text));
  ASSERT_EQ(found.size(), 2u);
  for (const JudgedProposal& proposal : found)
  {
    const JudgedProposal& other = expected[proposal.record.id == "3" ? 0 : 1];
    EXPECT_EQ(proposal.record.id, other.record.id);
    EXPECT_EQ(proposal.accept, other.accept);
    EXPECT_EQ(proposal.record.label, "dining table");
    EXPECT_EQ(proposal.record.orientationDefined, other.record.orientationDefined);
    EXPECT_LT(
        (proposal.record.object.cuboidCorners() - other.record.object.cuboidCorners())
            .cwiseAbs()
            .maxCoeff(),
        3e-4);
  }
  EXPECT_TRUE(expected[0].accept);
  EXPECT_FALSE(expected[1].accept) << "one side was not seen";
}

TEST(ProposalFile, KeepsAnyLabel)
{
  const TemporaryFolder folder;
  for (const std::string& label : std::vector<std::string>{
           "", " ", " cup ", "$env{HOME}", "$env{", "${x}", "a // b", "cup\\", "two\nlines = 1",
           "a ; b # c", "[object 2]", "100% wool %41", "\"tea\" pot",
           "K\xC3\xBC"
           "che",
           std::string("a\0b", 3), "@define x 1", "dining-table_2.5"})
  {
    CuboidProposal proposal = sampleProposal("3", true);
    proposal.record.label = label;
    const std::string text = proposalText({proposal});
    const auto found = readProposals(folder.write("p.ini", text));
    ASSERT_EQ(found.size(), 1u) << text;
    EXPECT_EQ(found[0].record.label, label) << text;
    EXPECT_TRUE(found[0].accept);
  }
}

TEST(ProposalFile, NamesWhatIsWrongInIt)
{
  const TemporaryFolder folder;
  const std::string good = "label = cup\ncenter = 0 0 1\nsize = 0.1 0.1 0.1\n";
  for (const std::string& wrong : std::vector<std::string>{
           "[object 1]\n" + good + "acept = yes\n", "[object 1]\n" + good + "yaw_deg = north\n",
           std::string("[object 1]\nlabel = cup\ncenter = 0 0 1\n"),
           std::string("[object 1]\ncenter = 0 0 1\nsize = 0.1 0.1 0.1\n"),
           std::string("[object 1]\nlabel = cup\nsize = 0.1 0.1 0.1\n"),
           std::string("[object 1]\nlabel = 9%\ncenter = 0 0 1\nsize = 1 1 1\n"),
           "[cup 1]\n" + good, "[object ]\n" + good})
    try
    {
      readProposals(folder.write("p.ini", wrong));
      ADD_FAILURE() << wrong;
    }
    catch (const std::invalid_argument& e)
    {
      EXPECT_NE(std::string(e.what()).find("p.ini: ["), std::string::npos) << e.what();
    }
  EXPECT_THROW(readProposals(folder.path("none.ini")), std::runtime_error);
  const auto error =
      errorOf([&] { readProposals(folder.write("p.ini", "[object 1]\nlabel = ${x}\n")); });
  EXPECT_EQ(error.rfind(folder.path("p.ini:2: "), 0), 0u) << error;
}
