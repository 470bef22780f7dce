#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "quadmap/base/OutputFile.h"
#include "quadmap/dense/DenseCloud.h"

namespace quadmap
{
namespace
{
template <typename T>
void append(std::string& out, const T* values, std::size_t count)
{
  out.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

/** The first fields of a point in both formats: x y z nx ny nz curvature. */
void appendGeometry(std::string& out, const DensePoint& point)
{
  append(out, point.position.data(), 3);
  append(out, point.normal.data(), 3);
  append(out, &point.curvature, 1);
}

std::string pcdText(const DenseCloud& cloud)
{
  const std::string count = std::to_string(cloud.size());
  std::string text =
      "# .PCD v0.7 - quadmap: metres, z up\nVERSION 0.7\n"
      "FIELDS x y z normal_x normal_y normal_z curvature rgb\nSIZE 4 4 4 4 4 4 4 4\n"
      "TYPE F F F F F F F F\nCOUNT 1 1 1 1 1 1 1 1\nWIDTH " +
      count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  for (const DensePoint& point : cloud)
  {
    appendGeometry(text, point);
    const auto [r, g, b] = point.rgb;
    const std::uint32_t packed = std::uint32_t{r} << 16 | std::uint32_t{g} << 8 | std::uint32_t{b};
    append(text, &packed, 1);
  }
  return text;
}

std::string plyText(const DenseCloud& cloud)
{
  std::string text =
      "ply\nformat binary_little_endian 1.0\ncomment quadmap: metres, z up\nelement vertex " +
      std::to_string(cloud.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
      "property float ny\nproperty float nz\nproperty float curvature\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nend_header\n";
  for (const DensePoint& point : cloud)
  {
    appendGeometry(text, point);
    append(text, point.rgb.data(), point.rgb.size());
  }
  return text;
}

}  // namespace

bool isCloudName(const std::string& path)
{
  const auto extension = std::filesystem::path(path).extension();
  return extension == ".pcd" || extension == ".ply";
}

void writeCloud(const DenseCloud& cloud, const std::string& path)
{
  if (!isCloudName(path)) throw std::invalid_argument(path + ": the name must end in .pcd or .ply");
  const bool isPcd = std::filesystem::path(path).extension() == ".pcd";
  writeTextFile(path, isPcd ? pcdText(cloud) : plyText(cloud));
}

}  // namespace quadmap
