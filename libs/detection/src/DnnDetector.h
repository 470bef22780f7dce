#pragma once

#include <memory>
#include <opencv2/dnn.hpp>
#include <string>
#include <vector>

#include "Letterbox.h"
#include "heads/Head.h"
#include "model/DetectorModel.h"
#include "quadmap/detection/Detector.h"

namespace quadmap
{
/** The files of a model, where they were found. */
struct ModelFiles
{
  std::string name;              //!< Of the model
  std::string weights, network;  //!< Paths; no network for .onnx
  std::string labels;            //!< Path
};

/** A network that OpenCV runs on the processor. */
class DnnDetector : public Detector
{
 public:
  /** \exception std::runtime_error As of loadDetector(). */
  DnnDetector(const DetectorModel& model, const ModelFiles& files);

  std::vector<DetectedObject> detect(const mrpt::img::CImage& image) override;
  std::string description() const override;

 private:
  std::vector<Tensor> run();
  DetectedObject objectOf(
      const RawBox& rawBox,
      const ImageBox& box,
      const Placement& place,
      const std::vector<Tensor>& outputs) const;

  DetectorModel model_;
  ModelFiles files_;
  std::vector<std::string> labels_;
  cv::dnn::Net net_;
  std::vector<std::string> outputNames_;
  InputBlob input_;
  std::vector<cv::Mat> outputs_;
  HeadKind kind_ = HeadKind::Auto;
  std::unique_ptr<Head> head_;
};

}  // namespace quadmap
