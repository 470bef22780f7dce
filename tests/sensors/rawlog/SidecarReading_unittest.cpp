#include <gtest/gtest.h>

#include "../SampleRawlog.h"

using namespace quadmap;

namespace
{
constexpr int kImages = 3, kBoxes = 500;

/** A rawlog of few images, with a sidecar of many records. \return The path. */
std::string writeWithLongSidecar(const TemporaryFolder& folder)
{
  std::vector<mrpt::serialization::CSerializable::Ptr> scans, boxes;
  for (int i = 0; i < kImages; ++i) scans.push_back(sampleScan(kStart + i));
  for (int i = 0; i < kBoxes; ++i) boxes.push_back(sampleBoxes(kStart + 0.005 * i));
  writeObjects(folder.path("x.objects.rawlog"), boxes);
  return writeObjects(folder.path("x.rawlog"), scans);
}

/** Number of frames that a source gives which is told once to stop, at the n-th question. */
int framesWhenStoppedAt(const std::string& file, int n)
{
  int asked = 0;
  RawlogSourceOptions options;
  options.shouldStop = [&] { return ++asked == n; };
  RawlogSource source(file, options);
  int frames = 0;
  while (const auto frame = source.next())
  {
    EXPECT_TRUE(frame->objects) << "no frame is given without its boxes";
    ++frames;
  }
  EXPECT_TRUE(source.wasStopped()) << n;
  EXPECT_EQ(asked, n) << "who was told does not ask again";
  return frames;
}
}  // namespace

TEST(SidecarReading, StopsWhileItIsLookedThroughAtFirst)
{
  const TemporaryFolder folder;
  const auto file = writeWithLongSidecar(folder);
  for (const int n : {1, 10, kBoxes}) EXPECT_EQ(framesWhenStoppedAt(file, n), 0);
}

TEST(SidecarReading, StopsBetweenItsRecords)
{
  const TemporaryFolder folder;
  const auto file = writeWithLongSidecar(folder);
  int before = 0;
  for (const int n : {kBoxes + 20, kBoxes + 100, kBoxes + 250})
  {
    const int frames = framesWhenStoppedAt(file, n);
    EXPECT_GE(frames, before) << "the later, the more";
    EXPECT_LT(frames, kImages) << "the boxes of the last one were not read";
    before = frames;
  }
}
