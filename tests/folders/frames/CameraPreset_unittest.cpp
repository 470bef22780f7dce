#include "frames/CameraPreset.h"

#include <gtest/gtest.h>

#include "../../base/OptionGroupLaws.h"
#include "../SampleRecording.h"
#include "quadmap/base/ShareFiles.h"
#include "quadmap/folders/FolderKinds.h"

using namespace quadmap;

TEST(CameraPreset, AllInstalledCamerasCanBeRead)
{
  const auto names = cameraPresetNames();
  for (const char* name : {"fr1", "fr2", "fr3", "icl", "7scenes", "kinect", "xtion", "primesense"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  for (const auto& name : names)
  {
    const FolderCamera camera = cameraPreset(name);
    EXPECT_EQ(camera.origin, "camera " + name);
    EXPECT_GT(camera.color.fx(), 400) << name;
    EXPECT_LT(std::abs(camera.color.cx() - 0.5 * camera.color.ncols), 20) << name;
    EXPECT_LT(std::abs(camera.color.cy() - 0.5 * camera.color.nrows), 20) << name;
  }
  EXPECT_TRUE(cameraPreset("fr1").isDistorted());
  EXPECT_FALSE(cameraPreset("fr3").isDistorted());
  EXPECT_LT(cameraPreset("icl").color.fy(), 0);
  ASSERT_TRUE(cameraPreset("7scenes").depth);
  EXPECT_NEAR(cameraPreset("7scenes").depth->T_color_depth.x(), -0.0227, 1e-4);
}

TEST(CameraPreset, IsChosenByTheWordsInAFoldersName)
{
  EXPECT_EQ(presetOfFolder("/a/rgbd_dataset_freiburg1_xyz"), "fr1");
  EXPECT_EQ(presetOfFolder("/a/rgbd_dataset_freiburg2_desk/"), "fr2");
  EXPECT_EQ(presetOfFolder("/a/FR3-office/rgbd"), "fr3") << "or of the folder above";
  EXPECT_EQ(presetOfFolder("/a/7scenes/seq-01"), "7scenes");
  EXPECT_EQ(presetOfFolder("/a/living_room_traj0_frei_png"), "icl") << "as downloaded";
  EXPECT_EQ(presetOfFolder("/fr1/a/b"), std::nullopt);
  EXPECT_EQ(presetOfFolder("/a/freiburg12"), std::nullopt) << "another word";
}

TEST(CameraPreset, RefusesWrongFilesByName)
{
  const TemporaryFolder files;
  const auto expect = [&](const std::string& text, const std::string& part)
  {
    const auto path = files.write("my.ini", "[camera]\n" + text);
    const auto error = errorOf([&] { cameraPreset(path); });
    EXPECT_EQ(error.find(path + ": "), 0u) << error;
    EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  expect("", "fx is missing");
  expect("fx = 500\n", "fy must not be 0");
  expect("fx = 500\nfy = 500\nfz = 1\n", "fz");
  expect("fx = 500\nfy = 500\ndepthFx = 500\n", "depthFx must be > 0 and depthFy not 0");
  expect("fx = 500\nfy = 500\ndepthWidth = 640\n", "depthWidth and depthHeight must both be");
  const std::string other = "fx = 500\nfy = 500\ndepthWidth = 320\ndepthHeight = 240\n";
  expect(other + "k1 = 0.1\n", "a lens that distorts needs depthFx and depthFy");
  expect(other + "T_color_depth = 1 0 0 0.05 0 1 0 0 0 0 1 0\n", "T_color_depth needs depthFx");
  expect(
      "fx = 500\nfy = 500\ndepthWidth = 20000\ndepthHeight = 20000\n",
      "images may have 16 million pixels");
  expect("fx = 500\nfy = 500\ndepthFactor = 0.5\n", "depthFactor must be 0 or in 1..1e7");
  expect(
      "fx = 500\nfy = 500\nT_color_depth = 1 0 0 0 0 1 0 0 0 0 2 0\n",
      "must be the first three rows of a rigid transformation");
  expect("fx = 500\nfy = 500\n[other]\na = 1\n", "other");
  EXPECT_NE(errorOf([&] { cameraPreset(files.path("no.ini")); }).find("no.ini"), std::string::npos);
}

TEST(CameraPreset, OfAUserIsNamedByItsPath)
{
  const SampleRecording recording;
  const TemporaryFolder other;
  std::string calibration = SampleRecording::kCalibration;
  calibration.replace(calibration.find("width: 64"), 9, "width: 80");
  const std::string yaml = other.write("my.yaml", "%YAML:1.0\n---\n" + calibration);
  const std::string ini =
      other.write("my.ini", "[camera]\nwidth = 80\nheight = 48\nfx = 50\nfy = -50\nk1 = 0.1\n");
  const auto opened = [&](const std::string& camera)
  {
    FrameFolderOptions options;
    options.camera = camera;
    return openFrameFolder("tum", recording.folder(), options);
  };
  for (const std::string& file : {yaml, ini})
    EXPECT_EQ(
        errorOf([&] { opened(file).scan(0); }),
        recording.files.path("rgb/f0.png") + ": is 64x48, " + file + " is for 80x48");
  const auto notes = opened(ini).notes();
  ASSERT_GE(notes.size(), 2u);
  EXPECT_EQ(notes[0].find(recording.folder() + ": fy of " + ini + " is negative"), 0u) << notes[0];
  EXPECT_NE(notes[1].find("as the lens of " + ini + " distorts"), std::string::npos) << notes[1];
}

TEST(CameraPreset, HasTheCentreOfTheImageWhenTheFileHasNone)
{
  const TemporaryFolder files;
  const std::string text = "[camera]\nwidth = 320\nheight = 240\nfx = 250\nfy = 250\n";
  const FolderCamera camera = cameraPreset(files.write("my.ini", text));
  EXPECT_DOUBLE_EQ(camera.color.cx(), 159.5);
  EXPECT_DOUBLE_EQ(camera.color.cy(), 119.5);
  EXPECT_FALSE(camera.depth);
  const FolderCamera two =
      cameraPreset(files.write("two.ini", text + "cy = 0\ndepthFx = 260\ndepthFy = 260\n"));
  EXPECT_DOUBLE_EQ(two.color.cy(), 0) << "what the file says";
  ASSERT_TRUE(two.depth);
  EXPECT_DOUBLE_EQ(two.depth->camera.cx(), 159.5);
  EXPECT_DOUBLE_EQ(two.depth->camera.cy(), 119.5);
}

TEST(CameraPreset, KnowsDepthImagesOfAnotherSize)
{
  const TemporaryFolder files;
  const std::string text =
      "[camera]\nwidth = 1296\nheight = 968\nfx = 1170\nfy = 1170\n"
      "depthWidth = 640\ndepthHeight = 480\n";
  const FolderCamera registered = cameraPreset(files.write("my.ini", text));
  EXPECT_EQ(registered.color.ncols, 1296u);
  ASSERT_TRUE(registered.depth);
  const auto& depth = registered.depth->camera;
  EXPECT_EQ(depth.ncols, 640u);
  EXPECT_EQ(depth.nrows, 480u);
  EXPECT_DOUBLE_EQ(depth.fx(), 1170 * 640 / 1296.0) << "the colour camera's view";
  EXPECT_DOUBLE_EQ(depth.fy(), 1170 * 480 / 968.0);
  EXPECT_DOUBLE_EQ(depth.cx(), 319.5);
  EXPECT_NEAR(registered.depth->T_color_depth.norm(), 0, 1e-12);

  const FolderCamera own =
      cameraPreset(files.write("own.ini", text + "depthFx = 578\ndepthFy = 578\n"));
  ASSERT_TRUE(own.depth);
  EXPECT_EQ(own.depth->camera.nrows, 480u);
  EXPECT_DOUBLE_EQ(own.depth->camera.fx(), 578);
  EXPECT_DOUBLE_EQ(own.depth->camera.cy(), 239.5) << "the middle of the depth images";
}

TEST(CameraPreset, GivesBackWhatWasSaved)
{
  CameraPreset preset = CameraPreset::fromFile(findShareFile("cameras/7scenes.ini"));
  preset.distortion = {0.1, -0.2, 1e-3, 2e-3, 0.3};
  preset.depthWidth = 320;
  preset.depthHeight = 240;
  const CameraPreset again = throughText(preset, "camera");
  EXPECT_EQ(again.T_color_depth, preset.T_color_depth);
  EXPECT_EQ(again.color, preset.color);
  EXPECT_EQ(again.depth, preset.depth);
  EXPECT_EQ(again.depthWidth, 320);
  EXPECT_EQ(again.depthHeight, 240);
  EXPECT_EQ(again.distortion, preset.distortion);
  EXPECT_EQ(again.folders, preset.folders);
  EXPECT_EQ(again.noDepth, 65535);
  EXPECT_TRUE(again.posesAreOfDepth);
}

TEST(CameraPreset, ScalesWithTheImages)
{
  const auto half = scaledTo(cameraPreset("fr3"), 320, 240);
  EXPECT_NEAR(half.fx(), 0.5 * 535.4, 1e-9);
  // The image's left border, half a pixel left of the first pixel's centre, stays where it is.
  EXPECT_NEAR((half.cx() + 0.5) / 320, (320.1 + 0.5) / 640, 1e-12);
  EXPECT_EQ(half.ncols, 320u);
  EXPECT_EQ(
      errorOf([] { scaledTo(cameraPreset("fr3"), 640, 400); }),
      "camera fr3 is for 640x480, the images are 640x400");
}
