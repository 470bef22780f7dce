#include "quadmap/base/GzipStream.h"

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include "../obs/FileSizeLimit.h"
#include "../obs/TemporaryFolder.h"
#include "quadmap/base/GzipInput.h"
#include "quadmap/obs/CObservationObjects.h"

using namespace quadmap;

namespace
{
/** More than 1 MB as an archive, so that the file has several members. */
CObservationObjects largeObject()
{
  CObservationObjects object;
  CoarseDepth& coarse = object.coarseDepth;
  coarse.columns = coarse.rows = 1024;
  for (std::size_t i = 0; i < std::size_t{coarse.columns} * coarse.rows; ++i)
    coarse.depth.push_back(static_cast<float>(i * i / 77 % 1000));
  return object;
}
}  // namespace

TEST(GzipStream, MembersComeBackAndDamageIsSeen)
{
  std::vector<std::uint8_t> bytes(200000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * i / 77);
  auto member = gzipMember(bytes, 1);
  EXPECT_EQ(gunzipMember(member), bytes);
  EXPECT_EQ(gunzipMember(gzipMember({}, 9)).size(), 0u);
  EXPECT_EQ(member, gzipMember(bytes, 1)) << "no time stamp inside";
  member[member.size() / 2] ^= 0x55;
  EXPECT_THROW(gunzipMember(member), std::runtime_error);
  EXPECT_THROW(gunzipMember({member.begin(), member.begin() + 100}), std::runtime_error);
}

TEST(GzipStream, MrptReadsArchives)
{
  const TemporaryFolder folder;
  const auto object = largeObject();
  ASSERT_GT(archiveBytes(object).size(), 1u << 20);
  writeArchive(folder.path("x.gz"), object);
  EXPECT_EQ(folder.fileCount(), 1u) << "no temporary file is left";
  mrpt::io::CFileGZInputStream file(folder.path("x.gz"));
  CObservationObjects read;
  mrpt::serialization::archiveFrom(file) >> read;
  EXPECT_TRUE(archiveBytes(read) == archiveBytes(object));
}

TEST(GzipStream, PiecesAreOfOneSizeHoweverTheyAreWritten)
{
  std::vector<std::uint8_t> bytes(2500);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * i / 77);
  for (const std::size_t step : {1, 700, 1000, 2500})
  {
    std::vector<std::vector<std::uint8_t>> pieces;
    GzipPieces writer([&](const auto& member) { pieces.push_back(gunzipMember(member)); }, 1, 1000);
    for (std::size_t i = 0; i < bytes.size(); i += step)
      writer.Write(bytes.data() + i, std::min(step, bytes.size() - i));
    writer.flush();
    ASSERT_EQ(pieces.size(), 3u) << step;
    EXPECT_EQ(pieces[0].size(), 1000u);
    EXPECT_EQ(pieces[1].size(), 1000u);
    std::vector<std::uint8_t> all;
    for (const auto& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
    EXPECT_EQ(all, bytes);
  }
}

TEST(GzipStream, FullDiskKeepsTheOldFile)
{
  const TemporaryFolder folder;
  const auto object = largeObject();
  const auto path = folder.path("x.gz");
  writeArchive(path, object);
  const auto size = std::filesystem::file_size(path);
  folder.write("x.gz", "old");
  for (const auto bytes : {size - 1, size / 2, std::uintmax_t(0)})
  {
    const FileSizeLimit limit(bytes);
    const std::string error = errorOf([&] { writeArchive(path, object); });
    EXPECT_EQ(error.find(path + ": cannot be written: "), 0u) << bytes << ": " << error;
    EXPECT_EQ(readFile(path), "old") << bytes;
    EXPECT_EQ(folder.fileCount(), 1u) << bytes;
  }
}

TEST(GzInput, ReadsNoMoreThanItMay)
{
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> zeros(3u << 20, 0);
  const auto member = gzipMember(zeros, 9);
  const auto path = folder.write("x.gz", std::string(member.begin(), member.end()));
  const auto readAll = [&](std::uint64_t most)
  {
    GzInput file(path);
    file.setMostBytes(most);
    file.startRecord();
    char first = 1;
    file.Read(&first, 1);
    file.skipToEnd();
  };
  EXPECT_EQ(errorOf([&] { readAll(3u << 20); }), "");
  EXPECT_EQ(errorOf([&] { readAll(2u << 20); }), "the file holds more than 2 MB");
}

TEST(GzInput, TellsWhatFollowsTheCompressedData)
{
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> bytes(300000, 'x');  // more than the buffers hold
  const auto member = gzipMember(bytes, 1);
  const std::string part(member.begin(), member.end());
  const auto failure = [&](const std::string& content, std::uint64_t expected)
  {
    GzInput file(folder.write("x.gz", content));
    const std::string error = errorOf([&] { file.skipToEnd(); });
    EXPECT_EQ(file.getPosition(), expected);
    return error;
  };
  EXPECT_EQ(failure(part, bytes.size()), "");
  EXPECT_EQ(failure(part + part, 2 * bytes.size()), "");
  EXPECT_EQ(failure(std::string(bytes.begin(), bytes.end()), bytes.size()), "") << "as it is";
  EXPECT_EQ(failure("", 0), "");
  EXPECT_EQ(failure("\x1f", 1), "");
  for (const std::size_t more : {std::size_t{1}, std::size_t{8}, std::size_t{200000}})
    for (const char fill : {'\0', '\x1f', 'g'})
      EXPECT_EQ(
          failure(part + part + std::string(more, fill), 2 * bytes.size()),
          "the file is damaged (more than gzip wrote follows)")
          << more << ' ' << static_cast<int>(fill);
  std::string flipped = part + part;
  flipped[part.size()] ^= 1;  // in the mark of the second member
  EXPECT_EQ(failure(flipped, bytes.size()), "the file is damaged (more than gzip wrote follows)");
  EXPECT_EQ(
      failure(part + part.substr(0, 5), bytes.size()),
      "the file is truncated (its compressed data ends early)");
}
