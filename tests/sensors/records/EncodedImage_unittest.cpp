#include "quadmap/sensors/EncodedImage.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <opencv2/imgcodecs.hpp>

using namespace quadmap;

namespace
{
constexpr int kWidth = 40, kHeight = 30;

/** \param format The end of a file's name. */
std::vector<std::uint8_t> encoded(const char* format)
{
  std::vector<std::uint8_t> bytes;
  cv::imencode(format, cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(10, 200, 30)), bytes);
  return bytes;
}

bool isRead(const std::vector<std::uint8_t>& bytes, std::uint64_t mostPixels)
{
  try
  {
    return decodeImage(bytes.data(), bytes.size(), cv::IMREAD_COLOR, mostPixels).cols == kWidth;
  }
  catch (const std::runtime_error&)
  {
    return false;
  }
}
}  // namespace

TEST(EncodedImage, NoFormatEscapesTheLimitOfPixels)
{
  constexpr std::uint64_t kEnough = kWidth * kHeight;
  for (const char* format : {".jpg", ".png"})
    EXPECT_TRUE(isRead(encoded(format), kEnough)) << format;
  for (const char* format : {".jpg", ".png", ".bmp", ".ppm"})
    EXPECT_FALSE(isRead(encoded(format), kEnough - 1)) << format;
}

TEST(EncodedImage, IsNoLongerThanWhatOpenCVCanRectify)
{
  for (const char* format : {".jpg", ".png"})
    for (const int length : {32766, 32767})
      for (const cv::Size size : {cv::Size(length, 1), cv::Size(1, length)})
      {
        std::vector<std::uint8_t> bytes;
        cv::imencode(format, cv::Mat(size, CV_8UC3, cv::Scalar(10, 200, 30)), bytes);
        const auto read = [&]
        { decodeImage(bytes.data(), bytes.size(), cv::IMREAD_COLOR, 1 << 20); };
        if (length == 32766)
          EXPECT_NO_THROW(read()) << format << size;
        else
          EXPECT_THROW(read(), std::runtime_error) << format << size;
      }
}

TEST(EncodedImage, JpegHasThePixelsThatOpenCVGives)
{
  cv::Mat noise(kHeight, kWidth, CV_8UC3);
  cv::theRNG().state = 7;
  cv::randu(noise, 0, 256);
  cv::Mat grey;
  cv::extractChannel(noise, grey, 0);
  for (const cv::Mat& image : {noise, grey})
  {
    std::vector<std::uint8_t> bytes;
    cv::imencode(".jpg", image, bytes);
    const cv::Mat ours = decodeImage(bytes.data(), bytes.size(), cv::IMREAD_COLOR, 1 << 20);
    ASSERT_EQ(ours.size(), image.size());
    EXPECT_EQ(cv::norm(ours, cv::imdecode(bytes, cv::IMREAD_COLOR), cv::NORM_INF), 0);
  }
}

TEST(EncodedImage, JpegInColourHasASizeWhenItIsWhole)
{
  constexpr std::uint64_t kEnough = kWidth * kHeight;
  const auto bytes = encoded(".jpg");
  const auto size = sizeOfColorJpeg(bytes, kEnough);
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, unsigned{kWidth});
  EXPECT_EQ(size->height, unsigned{kHeight});
  EXPECT_THROW(sizeOfColorJpeg(bytes, kEnough - 1), std::runtime_error);
  for (std::size_t end = bytes.size() - 2; end > bytes.size() / 2; end -= 7)
    EXPECT_THROW(
        sizeOfColorJpeg({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(end)}, kEnough),
        std::runtime_error)
        << end;
  EXPECT_FALSE(sizeOfColorJpeg(encoded(".png"), kEnough));
  std::vector<std::uint8_t> grey;
  cv::imencode(".jpg", cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(9)), grey);
  EXPECT_FALSE(sizeOfColorJpeg(grey, kEnough)) << "has no colour";
}

TEST(EncodedImage, DamageOfAJpegIsTold)
{
  auto bytes = encoded(".jpg");
  bytes.resize(bytes.size() - 20);
  try
  {
    decodeImage(bytes.data(), bytes.size(), cv::IMREAD_COLOR, 1 << 20);
    ADD_FAILURE() << "the end is missing";
  }
  catch (const std::runtime_error& e)
  {
    EXPECT_NE(std::string(e.what()).find("Premature end of JPEG"), std::string::npos) << e.what();
  }
}

TEST(EncodedImage, JpegOfFourInksIsReadAllTheSame)
{
  const std::vector<std::uint8_t> ink(4 * kHeight * kWidth, 120);
  unsigned char* made = nullptr;
  unsigned long size = 0;
  const tjhandle encoder = tjInitCompress();
  ASSERT_EQ(
      tjCompress2(
          encoder, ink.data(), kWidth, 0, kHeight, TJPF_CMYK, &made, &size, TJSAMP_444, 90, 0),
      0);
  const cv::Mat ours = decodeImage(made, size, cv::IMREAD_COLOR, 1 << 20);
  EXPECT_EQ(ours.size(), cv::Size(kWidth, kHeight));
  EXPECT_FALSE(sizeOfColorJpeg({made, made + size}, 1 << 20)) << "it is no plain colour";
  EXPECT_THROW(decodeImage(made, size / 2, cv::IMREAD_COLOR, 1 << 20), std::runtime_error);
  tjFree(made);
  tjDestroy(encoder);
}
