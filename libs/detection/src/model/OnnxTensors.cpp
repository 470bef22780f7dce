#include "model/OnnxTensors.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "model/ProtobufFields.h"
#include "quadmap/base/ErrorText.h"

namespace quadmap
{
namespace
{
using Form = ProtobufField::Form;

/** A file that is larger takes more memory than programs here may take. */
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 29;
constexpr std::uint64_t kMostNumbers = std::uint64_t{1} << 28;  // of a tensor
constexpr int kDeepest = 8;                                     // graphs in nodes of graphs
constexpr std::size_t kLongestName = 60;                        // of a tensor that is told

/** The numbers of the fields in the messages of onnx.proto. */
enum ModelField : std::uint64_t
{
  kModelGraph = 7
};
enum GraphField : std::uint64_t
{
  kGraphNode = 1,
  kGraphInitializer = 5
};
enum NodeField : std::uint64_t
{
  kNodeAttribute = 5
};
enum AttributeField : std::uint64_t
{
  kAttributeTensor = 5,
  kAttributeGraph = 6,
  kAttributeTensors = 10,
  kAttributeGraphs = 11
};
enum TensorField : std::uint64_t
{
  kDims = 1,
  kDataType = 2,
  kFloatData = 4,
  kInt32Data = 5,
  kInt64Data = 7,
  kName = 8,
  kRawData = 9,
  kDoubleData = 10,
  kUint64Data = 11
};

/** How a tensor of a type stores its numbers. */
struct NumberType
{
  std::uint64_t bytes = 0;  //!< Of a number in raw_data; 0 for a type whose numbers are not known
  std::uint64_t field = 0;  //!< Where they are when not in raw_data
};

/** \param dataType As in TensorProto.DataType. */
NumberType numberType(std::uint64_t dataType)
{
  switch (dataType)
  {
    case 1:  // float
      return {4, kFloatData};
    case 2:  // uint8
    case 3:  // int8
    case 9:  // bool
      return {1, kInt32Data};
    case 4:   // uint16
    case 5:   // int16
    case 10:  // float16
      return {2, kInt32Data};
    case 6:  // int32
      return {4, kInt32Data};
    case 7:  // int64
      return {8, kInt64Data};
    case 11:  // double
      return {8, kDoubleData};
    case 12:  // uint32
      return {4, kUint64Data};
    case 13:  // uint64
      return {8, kUint64Data};
    default:
      return {};
  }
}

/** What a tensor states and holds. */
class StoredTensor
{
 public:
  explicit StoredTensor(std::string_view message)
  {
    ProtobufFields fields(message);
    while (const auto field = fields.next()) add(*field);
  }

  /** \exception std::runtime_error See requireAllNumbers(). */
  void check() const;

  std::string name() const { return name_; }

 private:
  void add(const ProtobufField& field);
  void addDimensions(const ProtobufField& field);
  void addDimension(std::uint64_t size);

  static constexpr std::uint64_t kTooMany = kMostNumbers + 1;
  std::uint64_t stated_ = 1;  //!< Product of the dimensions, or kTooMany
  std::uint64_t dataType_ = 0;
  std::string name_;
  std::map<std::uint64_t, std::uint64_t> counts_;  //!< By field: how many numbers, or raw bytes
};

void StoredTensor::check() const
{
  const NumberType type = numberType(dataType_);
  const bool isKnown = type.bytes > 0;
  for (const auto& [field, count] : counts_)
  {
    if (count == 0) continue;
    const bool isRaw = field == kRawData;
    if (!isKnown || (!isRaw && field != type.field))
      throw std::runtime_error("stores its numbers in a way that is not read");
    if (stated_ == kTooMany)
      throw std::runtime_error(
          mrpt::format("states more than %ju numbers", static_cast<std::uintmax_t>(kMostNumbers)));
    if (count != stated_ * (isRaw ? type.bytes : 1))
      throw std::runtime_error(mrpt::format(
          "states %ju numbers and holds %ju%s", static_cast<std::uintmax_t>(stated_),
          static_cast<std::uintmax_t>(count), isRaw ? " bytes" : ""));
  }
}

/** How many integers of variable length a field holds: each ends with a byte below 128. */
std::uint64_t integersIn(const ProtobufField& field)
{
  if (field.form == Form::Integer) return 1;
  if (field.form == Form::Fixed) return 0;
  return static_cast<std::uint64_t>(std::count_if(
      field.bytes.begin(), field.bytes.end(),
      [](char c) { return (static_cast<unsigned char>(c) & 0x80) == 0; }));
}

/** How many numbers of so many bytes a field holds. */
std::uint64_t fixedIn(const ProtobufField& field, std::size_t size)
{
  if (field.form == Form::Fixed) return field.bytes.size() == size ? 1 : 0;
  return field.bytes.size() / size;
}

void StoredTensor::add(const ProtobufField& field)
{
  switch (field.number)
  {
    case kDims:
      return addDimensions(field);
    case kDataType:
      if (field.form == Form::Integer) dataType_ = field.integer;
      return;
    case kName:
      name_ = field.bytes.substr(0, kLongestName);
      return;
    case kRawData:
      if (field.form == Form::Bytes) counts_[kRawData] = field.bytes.size();  // the last one counts
      return;
    case kFloatData:
      counts_[kFloatData] += fixedIn(field, sizeof(float));
      return;
    case kDoubleData:
      counts_[kDoubleData] += fixedIn(field, sizeof(double));
      return;
    case kInt32Data:
    case kInt64Data:
    case kUint64Data:
      counts_[field.number] += integersIn(field);
      return;
    default:
      return;
  }
}

void StoredTensor::addDimensions(const ProtobufField& field)
{
  if (field.form == Form::Integer) return addDimension(field.integer);
  if (field.form == Form::Fixed) return;
  ProtobufFields packed(field.bytes);
  while (!packed.isAtEnd()) addDimension(packed.integer());
}

void StoredTensor::addDimension(std::uint64_t size)
{
  const bool isTooMuch = size > kMostNumbers || (size > 0 && stated_ > kMostNumbers / size);
  stated_ = isTooMuch ? kTooMany : stated_ * size;
}

void checkTensor(std::string_view message)
{
  const StoredTensor tensor(message);
  try
  {
    tensor.check();
  }
  catch (const std::runtime_error& e)
  {
    throw std::runtime_error("its tensor '" + oneLine(tensor.name()) + "' " + e.what());
  }
}

void checkGraph(std::string_view message, int depth);

void checkAttribute(std::string_view message, int depth)
{
  int tensors = 0;
  ProtobufFields fields(message);
  while (const auto field = fields.next())
  {
    // Protocol Buffers would join several of these to one.
    if (field->number == kAttributeTensor && ++tensors > 1)
      throw std::runtime_error("an attribute has two tensors");
    if (field->number == kAttributeTensor || field->number == kAttributeTensors)
      checkTensor(field->bytes);
    if (field->number == kAttributeGraph || field->number == kAttributeGraphs)
      checkGraph(field->bytes, depth + 1);
  }
}

void checkNode(std::string_view message, int depth)
{
  ProtobufFields fields(message);
  while (const auto field = fields.next())
    if (field->number == kNodeAttribute) checkAttribute(field->bytes, depth);
}

void checkGraph(std::string_view message, int depth)
{
  if (depth > kDeepest) throw std::runtime_error("graphs are nested in each other too deeply");
  ProtobufFields fields(message);
  while (const auto field = fields.next())
  {
    if (field->number == kGraphInitializer) checkTensor(field->bytes);
    if (field->number == kGraphNode) checkNode(field->bytes, depth);
  }
}

std::string contentOf(const std::string& file)
{
  const auto size = std::filesystem::file_size(file);
  if (size > kMostBytes)
    throw std::runtime_error(mrpt::format("has more than %ju MB", kMostBytes >> 20));
  std::string content(size, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(content.data(), static_cast<std::streamsize>(size));
  if (!in) throw std::runtime_error("cannot be read");
  return content;
}
}  // namespace

void requireAllNumbers(const std::string& onnxFile)
{
  const std::string content = contentOf(onnxFile);
  ProtobufFields fields(content);
  while (const auto field = fields.next())
    if (field->number == kModelGraph) checkGraph(field->bytes, 0);
}

}  // namespace quadmap
