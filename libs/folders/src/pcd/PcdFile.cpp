#include "pcd/PcdFile.h"

#include <mrpt/core/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "pcd/Lzf.h"
#include "quadmap/base/Words.h"
#include "quadmap/obs/Plausible.h"
#include "quadmap/sensors/CheckedReader.h"
#include "quadmap/sensors/EncodedImage.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kMostBytesOfPoint = 4096, kMostBytesOfLine = std::size_t{1} << 20;

/** One field of a point, whose size is that of all its numbers. */
struct Field
{
  std::string name;
  char type = 'F';
  std::size_t bytes = 4, count = 1;
  std::size_t size() const { return bytes * count; }
};

class PcdReader
{
 public:
  explicit PcdReader(const std::string& path) : path_(path)
  {
    try
    {
      file_ = readImageFile(path);
    }
    catch (const std::exception& e)
    {
      reject(e.what());
    }
  }

  PcdCloud read()
  {
    readHeader();
    const std::size_t points = cloud_.width * cloud_.height;
    if (data_ == "ascii")
      readText(points);
    else if (data_ == "binary")
      readPoints(file_.data() + at_, file_.size() - at_, points);
    else if (data_ == "binary_compressed")
      readCompressed(points);
    else
      reject("DATA " + data_ + " is not ascii, binary or binary_compressed");
    return std::move(cloud_);
  }

 private:
  [[noreturn]] void reject(const std::string& what) const
  {
    throw std::runtime_error(path_ + ": " + what);
  }

  /** The next line of the header or the text, without its end; nothing at the end of the file. */
  std::optional<std::string> nextLine()
  {
    if (at_ >= file_.size()) return std::nullopt;
    const auto from = file_.begin() + static_cast<std::ptrdiff_t>(at_);
    const auto end = std::find(from, file_.end(), std::uint8_t{'\n'});
    at_ = std::min(static_cast<std::size_t>(end - file_.begin()) + 1, file_.size());
    if (end - from > static_cast<std::ptrdiff_t>(kMostBytesOfLine))
      reject("has a line of more than 1 MB");
    std::string line(from, end);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }

  void readHeader()
  {
    constexpr int kMostLines = 1000;  // of a header; a file of nothing but line breaks has more
    for (int lines = 0; data_.empty(); ++lines)
    {
      const auto line = lines < kMostLines ? nextLine() : std::nullopt;
      if (!line) reject("is no PCD file, as its first lines have no DATA");
      std::istringstream words(*line);
      std::string key;
      words >> key;
      readHeaderLine(key, words);
      if (words.fail() && !words.eof()) reject("the line " + key + " of the header is malformed");
    }
    pointBytes_ = 0;
    for (const auto& field : fields_) pointBytes_ += field.size();
    if (fields_.empty() || pointBytes_ == 0 || pointBytes_ > kMostBytesOfPoint)
      reject("has no fields, or too large ones");
    if (cloud_.height < 2 || cloud_.width < 2)
      reject("is not organised: it has the height of a list of points, not of an image");
    if (cloud_.width > RecordLimits().imagePixels / cloud_.height) reject("has too many points");
    if (std::max(cloud_.width, cloud_.height) > kLongestImageSide)
      reject("has more than " + std::to_string(kLongestImageSide) + " points in a row or a column");
    if (pointBytes_ > RecordLimits().recordBytes / (cloud_.width * cloud_.height))
      reject("has points of more than 256 MB");
  }

  void readHeaderLine(const std::string& key, std::istringstream& words)
  {
    if (key == "FIELDS")
      addFields(words);
    else if (key == "SIZE")
      for (auto& field : fields_) field.bytes = sizeIn(words);
    else if (key == "TYPE")
      for (auto& field : fields_) words >> field.type;
    else if (key == "COUNT")
      for (auto& field : fields_) field.count = countIn(words);
    else if (key == "WIDTH")
      words >> cloud_.width;
    else if (key == "HEIGHT")
      words >> cloud_.height;
    else if (key == "VIEWPOINT")
      readViewpoint(words);
    else if (key == "DATA")
      words >> data_;
  }

  void addFields(std::istringstream& words)
  {
    for (std::string name; words >> name;)
    {
      if (fields_.size() == kMostBytesOfPoint) reject("has too many fields");
      fields_.push_back({name});
    }
  }

  std::size_t sizeIn(std::istringstream& words) const
  {
    long long bytes = 0;  // signed, as negative numbers would become large ones
    words >> bytes;
    if (bytes != 1 && bytes != 2 && bytes != 4 && bytes != 8)
      reject("each SIZE of the header must be 1, 2, 4 or 8");
    return static_cast<std::size_t>(bytes);
  }

  std::size_t countIn(std::istringstream& words) const
  {
    long long count = 0;
    words >> count;
    if (count < 1 || count > static_cast<long long>(kMostBytesOfPoint))
      reject(mrpt::format("each COUNT of the header must be in 1..%zu", kMostBytesOfPoint));
    return static_cast<std::size_t>(count);
  }

  void readViewpoint(std::istringstream& words)
  {
    Eigen::Vector3d t;
    Eigen::Quaterniond q;
    words >> t.x() >> t.y() >> t.z() >> q.w() >> q.x() >> q.y() >> q.z();
    if (!words || !t.allFinite()) reject("VIEWPOINT is no pose");
    if (const auto why = whyNoUnitQuaternion(q)) reject("the quaternion of VIEWPOINT " + *why);
    cloud_.viewpoint = mrpt::poses::CPose3D::FromRotationAndTranslation(
        Eigen::Matrix3d(q.normalized().toRotationMatrix()), t);
  }

  /** Where a field begins in a point. \exception std::runtime_error If it has not got 4 bytes. */
  std::optional<std::size_t> find(const std::string& name) const
  {
    std::size_t offset = 0;
    for (const auto& field : fields_)
    {
      if (field.name == name && field.size() != 4) reject("the field " + name + " has not 4 bytes");
      if (field.name == name) return offset;
      offset += field.size();
    }
    return std::nullopt;
  }

  std::size_t offsetOf(const std::string& name) const
  {
    const auto offset = find(name);
    if (!offset) reject("has no field " + name);
    return *offset;
  }

  std::size_t colorOffset() const
  {
    const auto rgba = find("rgba");
    return rgba ? *rgba : offsetOf("rgb");
  }

  /** Takes points from memory, where they stand one after the other, or field by field. */
  void readPoints(
      const std::uint8_t* bytes, std::size_t size, std::size_t points, bool byField = false)
  {
    if (size < points * pointBytes_) reject("ends before its last point");
    const auto take = [&](auto& values, std::size_t offset)
    {
      const std::uint8_t* const first = bytes + (byField ? points : 1) * offset;
      const std::size_t step = byField ? sizeof values[0] : pointBytes_;
      values.resize(points);
      for (std::size_t i = 0; i < points; ++i)
        std::memcpy(&values[i], first + i * step, sizeof values[i]);
    };
    take(cloud_.x, offsetOf("x"));
    take(cloud_.y, offsetOf("y"));
    take(cloud_.z, offsetOf("z"));
    take(cloud_.color, colorOffset());
  }

  /** Compressed points are stored field by field. */
  void readCompressed(std::size_t points)
  {
    std::uint32_t sizes[2];  // packed and unpacked
    if (file_.size() - at_ < sizeof sizes) reject("ends before its points");
    std::memcpy(sizes, file_.data() + at_, sizeof sizes);
    at_ += sizeof sizes;
    if (sizes[0] > file_.size() - at_ || sizes[1] != points * pointBytes_)
      reject("ends before its last point");
    const auto plain = unpackedLzf(file_.data() + at_, sizes[0], sizes[1]);
    if (!plain) reject("its compressed points are damaged");
    readPoints(plain->data(), plain->size(), points, true);
  }

  /** Turns a text with numbers into the bytes of a binary file. */
  void readText(std::size_t points)
  {
    // Each number has a digit at least and a blank or the end of a line behind it, except the last.
    std::size_t numbers = 0;
    for (const auto& field : fields_) numbers += points * field.count;
    if (file_.size() - at_ + 1 < 2 * numbers) reject("ends before its last point");
    std::vector<std::uint8_t> whole(points * pointBytes_);
    for (std::size_t i = 0; i < points; ++i)
    {
      const auto line = nextLine();
      if (!line) reject("ends before its last point");
      std::istringstream words(*line);
      std::uint8_t* to = whole.data() + i * pointBytes_;
      for (const auto& field : fields_)
      {
        for (std::size_t n = 0; n < field.count; ++n)
        {
          std::string word;
          if (!(words >> word)) reject(mrpt::format("point %zu has too few numbers", i));
          if (field.size() == 4) store(word, field, to, i);
        }
        to += field.size();
      }
    }
    readPoints(whole.data(), whole.size(), points);
  }

  void store(const std::string& word, const Field& field, std::uint8_t* to, std::size_t point) const
  {
    const char *first = word.data(), *last = first + word.size();
    std::from_chars_result result{};
    if (field.type == 'F')
    {
      float value = 0;
      result = std::from_chars(first, last, value);
      // PCL writes colours as floats of tiny numbers, which may be below the smallest normal one.
      if (result.ec == std::errc::result_out_of_range) value = std::strtof(first, nullptr);
      std::memcpy(to, &value, sizeof value);
    }
    else
    {
      std::int64_t value = 0;
      result = std::from_chars(first, last, value);
      const auto bits = static_cast<std::uint32_t>(value);
      std::memcpy(to, &bits, sizeof bits);
    }
    if (result.ec == std::errc::invalid_argument || result.ptr != last)
      reject(mrpt::format("point %zu: %s is not a number", point, quotedWord(word).c_str()));
  }

  std::string path_;
  std::vector<std::uint8_t> file_;
  std::size_t at_ = 0;  // of the next byte of the file
  std::vector<Field> fields_;
  std::size_t pointBytes_ = 0;
  std::string data_;
  PcdCloud cloud_;
};
}  // namespace

PcdCloud readPcd(const std::string& path) { return PcdReader(path).read(); }

}  // namespace quadmap
