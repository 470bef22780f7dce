#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace quadmap
{
/** The checksum SHA-256 [FIPS 180-4] of bytes that come in pieces. */
class Sha256
{
 public:
  void add(const void* bytes, std::size_t count);

  /** Of all bytes so far: 32 bytes. Nothing can be added afterwards. */
  std::string finish();

 private:
  void addBlock(const std::uint8_t* block);

  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::uint8_t, 64> block_{};  //!< Bytes that do not fill a block yet
  std::uint64_t count_ = 0;               //!< Of all bytes so far
};

/** SHA-256 of some bytes: 32 bytes. */
std::string sha256(std::string_view bytes);

/** SHA-256 of a file, as 64 hexadecimal digits. \exception std::runtime_error If it cannot be read;
 * names it. */
std::string sha256OfFile(const std::string& path);

}  // namespace quadmap
