#include <gtest/gtest.h>

#include "../detection/OnnxFile.h"
#include "../obs/TemporaryFolder.h"
#include "Fuzz.h"
#include "model/OnnxTensors.h"

using namespace quadmap;

TEST(Fuzz, OnnxTensors)
{
  using namespace onnx;
  const TemporaryFolder folder;
  constexpr unsigned kInt8 = 3, kInt32Data = 5;
  const std::string weights = tensor({2, 3}, kFloat, std::string(24, 'x'));
  const std::string packed = tensor({2}, kInt8, integer(1) + integer(100), kInt32Data);
  const std::string constant = node("Constant", {}, "c", text(5, weights));
  const std::string inner = node("If", {}, "i", text(6, text(1, constant)) + text(10, packed));
  const std::string valid = file(
      {inner, constant, node("Add", {"in", "w"}, "out")},
      tensor({1, 2}, kInt64, rawIntegers({1, -1})));
  FuzzRun run;
  run.words = {
      integer(~std::uint64_t{0}),
      number(1, std::uint64_t{1} << 40),
      text(5, ""),
      text(6, constant),
      number(2, 20),
      std::string(12, '\xff')};
  run.mostlyHarmless = true;  // names and numbers are not looked at
  fuzz(
      valid, run,
      [&](const std::string& bytes) { requireAllNumbers(folder.write("m.onnx", bytes)); });
}
