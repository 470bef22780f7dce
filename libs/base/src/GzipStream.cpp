#include "quadmap/base/GzipStream.h"

#include <libdeflate.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace quadmap
{
namespace
{
constexpr int kGzipFormat = 16;  //!< Added to zlib's window bits: gzip header and checksum
constexpr std::size_t kPieceBytes = 1 << 20;  //!< Of a file's members, before compression
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

GzipPieces::GzipPieces(Sink sink, int compressionLevel, std::size_t pieceBytes) :
    sink_(std::move(sink)), compressionLevel_(compressionLevel), pieceBytes_(pieceBytes)
{
}

size_t GzipPieces::Write(const void* buffer, size_t count)
{
  const auto* next = static_cast<const std::uint8_t*>(buffer);
  for (std::size_t left = count; left > 0;)
  {
    const std::size_t n = std::min(left, pieceBytes_ - pending_.size());
    pending_.insert(pending_.end(), next, next + n);
    next += n;
    left -= n;
    if (pending_.size() == pieceBytes_) flush();
  }
  return count;
}

void GzipPieces::flush()
{
  if (pending_.empty()) return;
  sink_(gzipMember(pending_, compressionLevel_));
  pending_.clear();
}

size_t GzipPieces::Read(void*, size_t) { throw std::logic_error("GzipPieces: cannot read"); }
uint64_t GzipPieces::Seek(int64_t, CStream::TSeekOrigin)
{
  throw std::logic_error("GzipPieces: cannot seek");
}
uint64_t GzipPieces::getTotalBytesCount() const
{
  throw std::logic_error("GzipPieces: size unknown");
}
uint64_t GzipPieces::getPosition() const { throw std::logic_error("GzipPieces: position unknown"); }

GzipFileWriter::GzipFileWriter(const std::string& path, int compressionLevel) :
    GzipPieces(
        [this](const std::vector<std::uint8_t>& member) { writeRaw(member); },
        compressionLevel,
        kPieceBytes),
    file_(path),
    out_(std::fopen(file_.temporaryPath().c_str(), "wb"))
{
  if (!out_)
    throw std::runtime_error(file_.finalPath() + ": cannot be written: " + std::strerror(errno));
}

GzipFileWriter::~GzipFileWriter()
{
  if (out_) std::fclose(out_);
}

void GzipFileWriter::appendMember(const std::vector<std::uint8_t>& member)
{
  flush();
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
    flush();
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

void GzipFileWriter::writeRaw(const std::vector<std::uint8_t>& bytes)
{
  if (error_ == 0 && std::fwrite(bytes.data(), 1, bytes.size(), out_) != bytes.size())
    error_ = errno;
}

void writeArchive(const std::string& path, const mrpt::serialization::CSerializable& object)
{
  GzipFileWriter file(path);
  auto archive = mrpt::serialization::archiveFrom(file);
  archive << object;
  file.commit();
}

}  // namespace quadmap
