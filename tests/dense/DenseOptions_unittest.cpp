#include "quadmap/dense/DenseOptions.h"

#include <gtest/gtest.h>

#include "../base/OptionGroupLaws.h"

using namespace quadmap;

TEST(DenseOptions, AreAGroupLikeAllOthers) { expectLaws<DenseOptions>("dense"); }

TEST(DenseOptions, AreReadFromTheirSection)
{
  const TemporaryFolder folder;
  const auto path = folder.write("d.ini", "[dense]\nroomCell = 0.02\n[other]\nx = 1\n");
  EXPECT_EQ(readDenseOptions(path).roomCell, 0.02);
  EXPECT_EQ(readDenseOptions(path).objectCell, DenseOptions().objectCell);
}

TEST(DenseOptions, NameTheFileAndTheKeyOfAWrongValue)
{
  const TemporaryFolder folder;
  for (const std::string wrong : {"roomCell = 0", "roomCel = 0.02", "maxRange = far"}) try
    {
      readDenseOptions(folder.write("d.ini", "[dense]\n" + wrong + "\n"));
      ADD_FAILURE() << wrong;
    }
    catch (const std::invalid_argument& e)
    {
      const std::string text = e.what();
      EXPECT_NE(text.find("d.ini"), std::string::npos) << text;
      EXPECT_NE(text.find(wrong.substr(0, wrong.find(' '))), std::string::npos) << text;
    }
  EXPECT_THROW(readDenseOptions(folder.path("none.ini")), std::runtime_error);
}

TEST(DenseOptions, MissTheirSection)
{
  const TemporaryFolder folder;
  for (const char* text : {"", "[dens]\nroomCell = 0.02\n", "roomCell = 0.02\n"}) try
    {
      readDenseOptions(folder.write("d.ini", text));
      ADD_FAILURE() << text;
    }
    catch (const std::invalid_argument& e)
    {
      EXPECT_NE(std::string(e.what()).find("d.ini: has no section [dense]"), std::string::npos);
    }
  EXPECT_EQ(readDenseOptions(folder.write("d.ini", "[dense]\n")).roomCell, 0.01);
}
