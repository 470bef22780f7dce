#include "quadmap/base/Sha256.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "../obs/TemporaryFolder.h"

using namespace quadmap;

namespace
{
/** The sum of a file with this content. */
std::string sumOf(const std::string& text)
{
  const TemporaryFolder folder;
  return sha256OfFile(folder.write("a", text));
}
}  // namespace

TEST(Sha256, GivesTheExamplesOfTheStandard)  // FIPS 180-4 and its collection of examples
{
  EXPECT_EQ(sumOf(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sumOf("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(
      sumOf("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
      "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(
      sumOf(std::string(1000000, 'a')),
      "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, DoesNotDependOnThePieces)
{
  const std::string text(200, 'x');
  Sha256 pieces;
  for (std::size_t at = 0, size = 1; at < text.size(); at += size, size += 7)
    pieces.add(text.data() + at, std::min(size, text.size() - at));
  EXPECT_EQ(pieces.finish(), sha256(text));
}

TEST(Sha256, NamesAFileThatIsMissing)
{
  EXPECT_THROW(sha256OfFile("/nonexistent/a"), std::runtime_error);
}
