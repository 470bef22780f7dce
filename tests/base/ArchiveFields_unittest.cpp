#include "quadmap/base/ArchiveFields.h"

#include <gtest/gtest.h>
#include <mrpt/io/CStream.h>
#include <mrpt/serialization/CArchive.h>

#include <cstring>
#include <stdexcept>

namespace quadmap
{
namespace
{
/** A stream that answers as MRPT's compressed streams do at damaged data. */
class DamagedStream : public mrpt::io::CStream
{
 public:
  explicit DamagedStream(std::size_t answer) : answer_(answer) {}

  std::size_t Read(void* buffer, std::size_t count) override
  {
    if (reads_++ > 0) return answer_;
    std::memset(buffer, 1, count / 2);
    return count / 2;
  }
  std::size_t Write(const void*, std::size_t) override { return 0; }
  std::uint64_t Seek(std::int64_t, TSeekOrigin) override { return 0; }
  std::uint64_t getTotalBytesCount() const override { return 0; }
  std::uint64_t getPosition() const override { return 0; }

 private:
  std::size_t answer_;
  int reads_ = 0;
};

}  // namespace

TEST(ArchiveFields, DamagedDataAreAnErrorAndNotAnEndlessLoop)
{
  for (const std::size_t answer : {static_cast<std::size_t>(-1), std::size_t{100}})
  {
    DamagedStream stream(answer);
    auto archive = mrpt::serialization::archiveFrom(stream);
    double value = 0;
    EXPECT_THROW(readBytes(archive, &value, sizeof(value)), std::runtime_error) << answer;
  }
}

}  // namespace quadmap
