#include "quadmap/base/ErrorText.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

using namespace quadmap;

namespace
{
std::string messageOf(const std::string& text) { return rootMessage(std::runtime_error(text)); }
}  // namespace

TEST(ErrorText, IsOneLineOfPrintableLetters)
{
  EXPECT_EQ(messageOf("a\nb\r\n\n c\td \n"), "a b c d");
  EXPECT_EQ(messageOf("red \x1b[31m bell \x07 end"), "red ?[31m bell ? end");
  EXPECT_EQ(oneLine("nul" + std::string(1, '\0')), "nul?");
  EXPECT_EQ(messageOf("my  file"), "my  file") << "names may have several spaces";
  EXPECT_EQ(
      messageOf("Gr\xc3\xbc\xc3\x9f"
                "e \xe2\x82\xac \xf0\x9f\x98\x80"),
      "Gr\xc3\xbc\xc3\x9f"
      "e \xe2\x82\xac \xf0\x9f\x98\x80");
  EXPECT_EQ(messageOf("cut \xe2\x82"), "cut ??");
  EXPECT_EQ(messageOf("escape \xc2\x9b overlong \xc0\xaf"), "escape ?? overlong ??");
  EXPECT_EQ(messageOf(" \n "), "unknown error");
}

TEST(ErrorText, IsBoundedAndKeepsBothEnds)
{
  const std::string text = messageOf("start " + std::string(10'000'000, 'x') + " end");
  EXPECT_LT(text.size(), 1100u);
  EXPECT_EQ(text.rfind("start ", 0), 0u);
  EXPECT_EQ(text.substr(text.size() - 4), " end");
}

TEST(ErrorText, TellsWhatMrptQuotes)
{
  const std::string head =
      "==== MRPT exception ====\nMessage:  Exception while parsing typed object 'X' from Y\n"
      "Original exception:\n";
  const std::string tail =
      "\nLocation: ./CArchive.cpp:475: [void f()]\nCall stack backtrace:\n[0 ]";
  EXPECT_EQ(messageOf(head + "archive: too many objects" + tail), "archive: too many objects");
  EXPECT_EQ(
      messageOf(head + "==== MRPT exception ====\nMessage:  no such version" + tail + tail),
      "no such version");
}

TEST(ErrorText, TellsTheCauseWithoutPlacesInTheSource)
{
  EXPECT_EQ(
      messageOf("==== MRPT exception ====\nMessage:  Assert\nLocation: a.h:3\n"
                "Message:  the cause\nLocation: b.h:4\nCall stack: ...\n"),
      "the cause");
  EXPECT_EQ(
      messageOf(
          "OpenCV(4.6.0) ./alloc.cpp:73: error: (-4:Insufficient memory) Failed to allocate 9 "
          "bytes in function 'OutOfMemoryError'\n"),
      "Failed to allocate 9 bytes");
  const std::string outer =
      "OpenCV(4.6.0) ./onnx_importer.cpp:1021: error: (-2:Unspecified error) in function "
      "'handleNode'\n> Node [Conv@ai.onnx]:(onnx_node!Conv_6) parse error: ";
  EXPECT_EQ(
      messageOf(outer + "no data\n> \n"),
      "Node [Conv@ai.onnx]:(onnx_node!Conv_6) parse error: no data");
  EXPECT_EQ(
      messageOf(
          outer + "OpenCV(4.6.0) ./convolution_layer.cpp:383: error: (-215:Assertion failed) "
                  "inputs.size() != 0 in function 'getMemoryShapes'\n> \n"),
      "inputs.size() != 0")
      << "the innermost one";
  EXPECT_EQ(
      messageOf("==== MRPT exception ====\n"
                "Message:  Exception while parsing typed object 'quadmap::X' from a stream\n"
                "Original exception:\narchive: a text is too long\n"
                "Location: ./CArchive.cpp:475: [void f()\nCall stack backtrace:\n"),
      "archive: a text is too long");
  EXPECT_EQ(
      rootMessage(std::filesystem::filesystem_error(
          "cannot remove", "x/y", std::make_error_code(std::errc::permission_denied))),
      "x/y: Permission denied");
}
