#pragma once

#include <mrpt/io/CStream.h>
#include <mrpt/serialization/CSerializable.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "quadmap/base/OutputFile.h"

namespace quadmap
{
/** A whole gzip file (a "member") of these bytes. The same bytes give the same result.
 *  \param compressionLevel 0 (none) to 9 (smallest). */
std::vector<std::uint8_t> gzipMember(const std::vector<std::uint8_t>& bytes, int compressionLevel);

/** \exception std::runtime_error If it is damaged. */
std::vector<std::uint8_t> gunzipMember(const std::vector<std::uint8_t>& member);

/** One MRPT object as an archive. */
std::vector<std::uint8_t> archiveBytes(const mrpt::serialization::CSerializable& object);

/** Compresses what is written to it into gzip members, each of so many bytes, and hands them on. A
 * file of several members is a gzip file: readers (zlib's gzread, and with it MRPT's) see them as
 * one. It is for writing only. */
class GzipPieces : public mrpt::io::CStream
{
 public:
  using Sink = std::function<void(const std::vector<std::uint8_t>& member)>;

  /** \param compressionLevel 0 (none) to 9 (smallest).
   *  \param pieceBytes Bytes of each member before compression, > 0. Memory is bounded by it. */
  GzipPieces(Sink sink, int compressionLevel, std::size_t pieceBytes);

  /** Hands on what is still in memory. Call it at the end. */
  void flush();

  size_t Write(const void* buffer, size_t count) override;

  std::string getStreamDescription() const override { return "gzip members"; }
  size_t Read(void*, size_t) override;
  uint64_t Seek(int64_t, CStream::TSeekOrigin) override;
  uint64_t getTotalBytesCount() const override;
  uint64_t getPosition() const override;

 private:
  Sink sink_;
  int compressionLevel_;
  std::size_t pieceBytes_;
  std::vector<std::uint8_t> pending_;  //!< Not compressed yet
};

/** Writes a gzip file that appears complete or not at all, and says when the disk is full, which
 * MRPT's own stream does not. Takes over gzip members made before. */
class GzipFileWriter : public GzipPieces
{
 public:
  /** \param compressionLevel Of the bytes that are not members already: 0 (none) to 9 (smallest).
   */
  explicit GzipFileWriter(const std::string& path, int compressionLevel = 6);
  ~GzipFileWriter() override;

  void appendMember(const std::vector<std::uint8_t>& member);

  /** Archives would wrap an exception of Write() in a call stack, so that it waits until here.
   *  \exception std::runtime_error If a write failed so far. */
  void requireWritten() const;

  /** Writes what is still in memory. \exception std::runtime_error If a write failed. */
  void close();

  /** Closes, and gives the file its name. \exception std::runtime_error If a write failed. */
  void commit();

  std::string getStreamDescription() const override { return file_.finalPath(); }

 private:
  void writeRaw(const std::vector<std::uint8_t>& bytes);

  OutputFile file_;
  std::FILE* out_ = nullptr;
  int error_ = 0;  //!< errno of the first write that failed
};

/** Writes one object as MRPT does (.gz archive). \exception std::runtime_error Names the file. */
void writeArchive(const std::string& path, const mrpt::serialization::CSerializable& object);

}  // namespace quadmap
