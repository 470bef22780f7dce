#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quadmap
{
/** What the camera of the tests shows and does. It is a file of numbers, one per line: the name and
 * the value of each, then "images" and their bytes. */
struct TestCamera
{
  int width = 0, height = 0;                      //!< [px]
  double horizontalFov = 1.0, verticalFov = 0.8;  //!< [rad]
  double fps = 100;
  int frames = 0;          //!< Number of images; the last one is shown for ever
  int unplugAfter = 0;     //!< Is unplugged after this number of frames; 0: never
  int silentAfter = 0;     //!< Gives no more images after this number of frames; 0: never
  int interruptAfter = 0;  //!< Sends Ctrl-C after this number of frames; 0: never
  int loseEvery = 0;       //!< Every n-th frame never comes; 0: none
  int registers = 1;       //!< Can register depth to colour
  int mirrors = 0;         //!< Its images are mirrored, and nothing can be done about it
  int startNumber = 1;     //!< Number of the first frame
  /** Its colour: 0 red, green and blue; 1 YUV 4:2:2, which begins with U; 2 YUYV. */
  int colorFormat = 0;
  std::vector<std::uint8_t> images;  //!< Per frame depth [mm], 16 bits, and colour, red first

  std::size_t depthBytes() const { return 2u * static_cast<std::size_t>(width * height); }
  std::size_t colorBytes() const { return 3u * static_cast<std::size_t>(width * height); }
  const std::uint8_t* depth(int frame) const
  {
    return images.data() + static_cast<std::size_t>(frame) * (depthBytes() + colorBytes());
  }
  const std::uint8_t* color(int frame) const { return depth(frame) + depthBytes(); }

  void save(const std::string& path) const;
  static TestCamera load(const std::string& path);  //!< Without images when it cannot be read

 private:
  template <typename Self, typename Visit>
  static void visit(Self& self, Visit&& each)
  {
    each("width", self.width);
    each("height", self.height);
    each("horizontalFov", self.horizontalFov);
    each("verticalFov", self.verticalFov);
    each("fps", self.fps);
    each("frames", self.frames);
    each("unplugAfter", self.unplugAfter);
    each("silentAfter", self.silentAfter);
    each("interruptAfter", self.interruptAfter);
    each("loseEvery", self.loseEvery);
    each("registers", self.registers);
    each("mirrors", self.mirrors);
    each("startNumber", self.startNumber);
    each("colorFormat", self.colorFormat);
  }
};

/** The environment variable with the file of the camera. Without it there is no camera. */
inline const char* const kTestCameraVariable = "QUADMAP_TEST_CAMERA";

}  // namespace quadmap
