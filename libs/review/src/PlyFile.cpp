#include "quadmap/review/PlyFile.h"

#include <array>
#include <cmath>
#include <cstring>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/obs/LabelColor.h"

namespace quadmap
{
namespace
{
using Rgb = std::array<std::uint8_t, 3>;

/** The two lists of a PLY file, in its format. */
class PlyBody
{
 public:
  /** \param object Number of the object it belongs to; -1: of none. */
  void addVertex(const Eigen::Vector3f& p, const Rgb& rgb, std::int32_t object)
  {
    append(vertices_, p.data(), sizeof(float) * 3);
    append(vertices_, rgb.data(), rgb.size());
    append(vertices_, &object, sizeof(object));
    ++vertexCount_;
  }

  void addFace(const std::array<std::uint32_t, 3>& corners)
  {
    const std::uint8_t count = 3;
    append(faces_, &count, sizeof(count));
    append(faces_, corners.data(), sizeof(corners));
    ++faceCount_;
  }

  std::uint32_t vertexCount() const { return vertexCount_; }

  void addComment(const std::string& text) { comments_ += "comment " + text + "\n"; }

  std::string text() const
  {
    return "ply\nformat binary_little_endian 1.0\ncomment quadmap: metres, z up\n" + comments_ +
           "element vertex " + std::to_string(vertexCount_) +
           "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
           "property uchar green\nproperty uchar blue\nproperty int object\nelement face " +
           std::to_string(faceCount_) + "\nproperty list uchar uint vertex_indices\nend_header\n" +
           vertices_ + faces_;
  }

 private:
  static void append(std::string& out, const void* data, std::size_t size)
  {
    const std::size_t end = out.size();
    out.resize(end + size);
    std::memcpy(&out[end], data, size);
  }

  std::string comments_, vertices_, faces_;
  std::uint32_t vertexCount_ = 0, faceCount_ = 0;
};

/** Adds an ellipsoid as a net of meridians and parallels. The poles are rings of equal points. */
void addEllipsoid(const ObjectRecord& record, std::int32_t number, PlyBody& ply)
{
  constexpr std::uint32_t kMeridians = 32, kParallels = 16;
  const mrpt::img::TColor color = labelColor(record.label);
  const std::uint32_t first = ply.vertexCount();
  for (std::uint32_t i = 0; i <= kParallels; ++i)
  {
    const double latitude = M_PI * (static_cast<double>(i) / kParallels - 0.5);
    for (std::uint32_t j = 0; j < kMeridians; ++j)
    {
      const double longitude = 2 * M_PI * j / kMeridians;
      const Eigen::Vector3d direction(
          std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
          std::sin(latitude));
      const Eigen::Vector3d p =
          record.object.center() +
          record.object.rotation() * record.object.semiAxes().cwiseProduct(direction);
      ply.addVertex(p.cast<float>(), {color.R, color.G, color.B}, number);
    }
  }
  for (std::uint32_t i = 0; i < kParallels; ++i)
    for (std::uint32_t j = 0; j < kMeridians; ++j)
    {
      const std::uint32_t next = (j + 1) % kMeridians;
      const std::uint32_t low = first + i * kMeridians, high = low + kMeridians;
      ply.addFace({low + j, low + next, high + next});
      ply.addFace({low + j, high + next, high + j});
    }
}

/** The id of an object, or its place in the list when that is no number. */
std::int32_t numberOf(const ObjectRecord& record, std::size_t place)
{
  const auto id = parseNumber(record.id);
  const bool isNumber = id && *id >= 0 && *id < 2147483648.0 && *id == std::floor(*id);
  return static_cast<std::int32_t>(isNumber ? *id : static_cast<double>(place));
}

/** A line of a header: labels may hold line ends. */
std::string withoutLineEnds(std::string text)
{
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text;
}

}  // namespace

void writePly(const SceneContent& content, const std::string& path)
{
  PlyBody ply;
  for (std::size_t i = 0; i < content.objects.size(); ++i)
  {
    const ObjectRecord& record = content.objects[i];
    const std::int32_t number = numberOf(record, i);
    ply.addComment(withoutLineEnds("object " + std::to_string(number) + " " + record.label));
    addEllipsoid(record, number, ply);
  }
  for (const CloudPoint& p : content.cloud) ply.addVertex(p.position, p.rgb, -1);
  writeTextFile(path, ply.text());
}

}  // namespace quadmap
