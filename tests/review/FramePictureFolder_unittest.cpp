#include "quadmap/review/FramePictureFolder.h"

#include <gtest/gtest.h>

#include <set>

#include "../obs/TemporaryFolder.h"

using namespace quadmap;

namespace
{
std::set<std::string> namesIn(const std::string& folder)
{
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder))
    names.insert(file.path().filename().string());
  return names;
}

void addPictures(FramePictureFolder& pictures, std::size_t count)
{
  const mrpt::img::CImage picture(32, 24, mrpt::img::CH_RGB);
  for (std::size_t i = 0; i < count; ++i) pictures.add(i, picture);
}
}  // namespace

TEST(FramePictureFolder, ReplacesThePicturesOfAnEarlierRunOnly)
{
  const TemporaryFolder folder;
  folder.write("frame-1.jpg", "mine");
  folder.write("frame-000001.png", "mine");
  for (const std::size_t count : {3, 2})
  {
    FramePictureFolder pictures(folder.folder());
    addPictures(pictures, count);
    pictures.commit();
  }
  EXPECT_EQ(
      namesIn(folder.folder()),
      (std::set<std::string>{
          "frame-000000.jpg", "frame-000001.jpg", "frame-000001.png", "frame-1.jpg"}));
}

TEST(FramePictureFolder, LeavesNothingOfARunThatFailed)
{
  const TemporaryFolder folder;
  {
    FramePictureFolder pictures(folder.path("new/frames"));
    addPictures(pictures, 2);
    EXPECT_FALSE(std::filesystem::exists(folder.path("new/frames/frame-000000.jpg")));
  }
  EXPECT_EQ(folder.fileCount(), 0u);
}
