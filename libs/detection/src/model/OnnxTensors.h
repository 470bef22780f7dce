#pragma once

#include <string>

namespace quadmap
{
/** OpenCV takes whatever is in memory for the numbers that a tensor of an ONNX file lacks, and
 * makes room for as many as its dimensions state.
 *
 *  \exception std::runtime_error If a constant tensor of the network does not hold as many numbers
 *  as its dimensions state, or the file is damaged. */
void requireAllNumbers(const std::string& onnxFile);

}  // namespace quadmap
