#include "ImageFile.h"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "quadmap/base/ErrorText.h"
#include "quadmap/base/StderrCapture.h"

namespace quadmap
{
namespace
{
/** libjpeg fills the rest of a damaged image with grey and only says so. Its other remarks, and the
 * warnings of libpng, are about things that do not change the image. */
bool tellsDamage(const std::string& remarks)
{
  return remarks.find("Corrupt JPEG") != std::string::npos ||
         remarks.find("Premature end of JPEG") != std::string::npos;
}
}  // namespace

cv::Mat readImageFile(const std::string& path, int flags)
{
  if (!std::filesystem::is_regular_file(path)) throw std::runtime_error("no such file");
  cv::Mat image;
  std::string remarks;
  {
    const StderrCapture capture;
    try
    {
      image = cv::imread(path, flags);
      remarks = capture.text();
    }
    catch (const cv::Exception& e)
    {
      remarks = rootMessage(e);
    }
  }
  if (image.empty() || tellsDamage(remarks))
    throw std::runtime_error(
        "cannot be read as an image" + (remarks.empty() ? "" : ": " + oneLine(remarks)));
  return image;
}

}  // namespace quadmap
