#pragma once

#include <cstring>
#include <string>

#include "../cameras/driver/CameraOfRawlog.h"
#include "../sensors/SampleRawlog.h"
#include "RunProgram.h"

namespace quadmap
{
/** Where OpenNI2 finds the driver of the test camera, and where it finds none. */
inline const std::string kOpenNi2 = QUADMAP_TEST_OPENNI2;
inline const std::string kOpenNi2WithoutDriver = kOpenNi2 + "-without-driver";

constexpr int kMark = 16;  // size of the mark in the corner of an image [px]

/** Marks a frame by its number, to be told again after it went through a JPEG. */
inline void mark(TestCamera& camera, int frame)
{
  auto* image = camera.images.data() + (camera.depth(frame) - camera.images.data());
  for (int row = 0; row < kMark; ++row)
  {
    const std::uint16_t depth_mm = static_cast<std::uint16_t>(1000 + frame);
    for (int column = 0; column < kMark; ++column)
      std::memcpy(image + 2 * (row * camera.width + column), &depth_mm, sizeof depth_mm);
    std::memset(
        image + camera.depthBytes() + static_cast<std::size_t>(3 * row * camera.width), 4 * frame,
        3 * kMark);
  }
}

/** A camera that shows small marked images. */
inline TestCamera markedCamera(int frames)
{
  TestCamera camera;
  camera.width = 64;
  camera.height = 48;
  camera.frames = frames;
  camera.images.assign(
      static_cast<std::size_t>(frames) * (camera.depthBytes() + camera.colorBytes()), 8);
  for (int i = 0; i < frames; ++i) mark(camera, i);
  return camera;
}

/** The environment in which a program finds the camera. */
inline std::string withCamera(const TestCamera& camera, const TemporaryFolder& folder)
{
  const std::string file = folder.path("camera");
  camera.save(file);
  return "LD_LIBRARY_PATH='" + kOpenNi2 + "' " + kTestCameraVariable + "='" + file + "' ";
}

/** A command with one of our programs in this environment. */
inline std::string commandOf(
    const std::string& environment, const std::string& program, const std::string& arguments)
{
  return environment + QUADMAP_BIN_DIR + "/" + program + " " + arguments;
}

/** Records frames of the camera as an .oni file. \return Its path. */
inline std::string recordOni(const TestCamera& camera, int frames, const TemporaryFolder& folder)
{
  const std::string file = folder.path("x.oni");
  const auto result = runCommand(commandOf(
      withCamera(camera, folder), "record-oni", "'" + file + "' " + std::to_string(frames)));
  if (result.status != 0) throw std::runtime_error("record-oni: " + result.err);
  return file;
}

}  // namespace quadmap
