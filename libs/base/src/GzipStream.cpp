#include "quadmap/base/GzipStream.h"

#include <libdeflate.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace quadmap
{
namespace
{
constexpr int kGzipFormat = 16;  //!< Added to zlib's window bits: gzip header and checksum
constexpr std::size_t kPendingLimit = 1 << 20;  //!< Compressed in pieces of this size [bytes]
}  // namespace

std::vector<std::uint8_t> gzipMember(const std::vector<std::uint8_t>& bytes, int compressionLevel)
{
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(compressionLevel), &libdeflate_free_compressor);
  if (!compressor) throw std::runtime_error("gzip: out of memory");
  std::vector<std::uint8_t> member(libdeflate_gzip_compress_bound(compressor.get(), bytes.size()));
  member.resize(libdeflate_gzip_compress(
      compressor.get(), bytes.data(), bytes.size(), member.data(), member.size()));
  if (member.empty()) throw std::logic_error("gzip: compression did not end");
  return member;
}

std::vector<std::uint8_t> gunzipMember(const std::vector<std::uint8_t>& member)
{
  z_stream z{};
  if (inflateInit2(&z, MAX_WBITS + kGzipFormat) != Z_OK)
    throw std::runtime_error("zlib: out of memory");
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> piece(1 << 16);
  z.next_in = const_cast<Bytef*>(member.data());
  z.avail_in = static_cast<uInt>(member.size());
  int state = Z_OK;
  while (state == Z_OK)
  {
    z.next_out = piece.data();
    z.avail_out = static_cast<uInt>(piece.size());
    state = inflate(&z, Z_NO_FLUSH);
    bytes.insert(bytes.end(), piece.begin(), piece.end() - z.avail_out);
  }
  inflateEnd(&z);
  if (state != Z_STREAM_END) throw std::runtime_error("gzip data is damaged");
  return bytes;
}

std::vector<std::uint8_t> archiveBytes(const mrpt::serialization::CSerializable& object)
{
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom(memory);
  archive << object;
  const auto* first = static_cast<const std::uint8_t*>(memory.getRawBufferData());
  return {first, first + memory.getTotalBytesCount()};
}

GzipFileWriter::GzipFileWriter(const std::string& path, int compressionLevel) :
    file_(path),
    compressionLevel_(compressionLevel),
    out_(std::fopen(file_.temporaryPath().c_str(), "wb"))
{
  if (!out_)
    throw std::runtime_error(file_.finalPath() + ": cannot be written: " + std::strerror(errno));
}

GzipFileWriter::~GzipFileWriter()
{
  if (out_) std::fclose(out_);
}

size_t GzipFileWriter::Write(const void* buffer, size_t count)
{
  const auto* first = static_cast<const std::uint8_t*>(buffer);
  pending_.insert(pending_.end(), first, first + count);
  if (pending_.size() >= kPendingLimit) flushPending();
  return count;
}

void GzipFileWriter::appendMember(const std::vector<std::uint8_t>& member)
{
  flushPending();
  writeRaw(member);
}

void GzipFileWriter::requireWritten() const
{
  if (error_ != 0)
    throw std::runtime_error(file_.finalPath() + ": cannot be written: " + std::strerror(error_));
}

void GzipFileWriter::close()
{
  if (out_)
  {
    flushPending();
    if (std::fclose(out_) != 0 && error_ == 0) error_ = errno;
    out_ = nullptr;
  }
  requireWritten();
}

void GzipFileWriter::commit()
{
  close();
  file_.commit();
}

void GzipFileWriter::flushPending()
{
  if (pending_.empty()) return;
  writeRaw(gzipMember(pending_, compressionLevel_));
  pending_.clear();
}

void GzipFileWriter::writeRaw(const std::vector<std::uint8_t>& bytes)
{
  if (error_ == 0 && std::fwrite(bytes.data(), 1, bytes.size(), out_) != bytes.size())
    error_ = errno;
}

size_t GzipFileWriter::Read(void*, size_t)
{
  throw std::logic_error("GzipFileWriter: cannot read");
}
uint64_t GzipFileWriter::Seek(int64_t, CStream::TSeekOrigin)
{
  throw std::logic_error("GzipFileWriter: cannot seek");
}
uint64_t GzipFileWriter::getTotalBytesCount() const
{
  throw std::logic_error("GzipFileWriter: size unknown");
}
uint64_t GzipFileWriter::getPosition() const
{
  throw std::logic_error("GzipFileWriter: position unknown");
}

void writeArchive(const std::string& path, const mrpt::serialization::CSerializable& object)
{
  GzipFileWriter file(path);
  auto archive = mrpt::serialization::archiveFrom(file);
  archive << object;
  file.commit();
}

}  // namespace quadmap
