#include "TestCamera.h"

#include <fstream>
#include <iterator>

namespace quadmap
{
void TestCamera::save(const std::string& path) const
{
  std::ofstream file(path, std::ios::binary);
  file.precision(17);
  visit(*this, [&](const char* name, const auto& value) { file << name << " " << value << "\n"; });
  file << "images\n";
  file.write(
      reinterpret_cast<const char*>(images.data()), static_cast<std::streamsize>(images.size()));
}

TestCamera TestCamera::load(const std::string& path)
{
  TestCamera camera;
  std::ifstream file(path, std::ios::binary);
  std::string word;
  visit(camera, [&](const char*, auto& value) { file >> word >> value; });
  file >> word;
  file.get();  // the line break
  if (!file) return {};
  camera.images.assign(std::istreambuf_iterator<char>(file), {});
  const auto bytes =
      static_cast<std::size_t>(camera.frames) * (camera.depthBytes() + camera.colorBytes());
  return camera.images.size() == bytes ? camera : TestCamera();
}

}  // namespace quadmap
