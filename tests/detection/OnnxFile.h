#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace quadmap
{
/** Makes small ONNX files: the parts of onnx.proto in the wire format of Protocol Buffers. */
namespace onnx
{
inline std::string integer(std::uint64_t value)
{
  std::string bytes;
  for (; value >= 128; value >>= 7) bytes += static_cast<char>(value | 128);
  return bytes + static_cast<char>(value);
}

inline std::string number(unsigned field, std::uint64_t value)
{
  return integer(field << 3) + integer(value);
}

inline std::string text(unsigned field, const std::string& bytes)
{
  return integer(field << 3 | 2) + integer(bytes.size()) + bytes;
}

constexpr unsigned kFloat = 1, kInt64 = 7;  // types of numbers

/** A tensor whose numbers are in the field. The usual one is raw_data. */
inline std::string tensor(
    const std::vector<std::uint64_t>& sizes,
    unsigned type,
    const std::string& numbers,
    unsigned field = 9)
{
  std::string bytes;
  for (const auto size : sizes) bytes += number(1, size);
  return bytes + number(2, type) + text(8, "w") + text(field, numbers);
}

inline std::string rawIntegers(const std::vector<std::int64_t>& values)
{
  std::string bytes(8 * values.size(), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

inline std::string node(
    const std::string& operation,
    const std::vector<std::string>& inputs,
    const std::string& output,
    const std::string& attribute = "")
{
  std::string bytes;
  for (const auto& input : inputs) bytes += text(1, input);
  bytes += text(2, output) + text(3, operation + output) + text(4, operation);
  return attribute.empty() ? bytes : bytes + text(5, attribute);
}

inline std::string valueInfo(const std::string& name, const std::vector<std::uint64_t>& sizes)
{
  std::string shape;
  for (const auto size : sizes) shape += text(1, number(1, size));
  return text(1, name) + text(2, text(1, number(1, kFloat) + text(2, shape)));
}

/** A network with input "in" of 320 x 320 pixels, output "out" and one constant, "w". */
inline std::string file(const std::vector<std::string>& nodes, const std::string& initializer)
{
  std::string graph;
  for (const auto& n : nodes) graph += text(1, n);
  graph += text(2, "g");
  if (!initializer.empty()) graph += text(5, initializer);
  graph += text(11, valueInfo("in", {1, 3, 320, 320})) + text(12, valueInfo("out", {1, 84, 2100}));
  return number(1, 7) + text(7, graph) + text(8, number(2, 12));
}
}  // namespace onnx
}  // namespace quadmap
