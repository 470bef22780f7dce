#pragma once

#include <functional>
#include <string>

#include "quadmap/sensors/CheckedReader.h"
#include "records/RecordBytes.h"

namespace quadmap
{
/** Follows the layout of a stored object and checks the sizes it states. Each method copies its
 * part of the object into the bytes. */
class RecordCheck
{
 public:
  RecordCheck(RecordBytes& b, const RecordLimits& l) : bytes(b), limits(l) {}

  /** The head of an object, of which the first byte was copied already. */
  struct Head
  {
    std::size_t begin = 0;  //!< Index of the object's first byte
    std::string name;       //!< Of the class, without its namespaces
    int version = 0;
    std::size_t versionAt = 0;  //!< Index of the byte with the version
  };
  Head headAfterFirstByte();

  /** Whether the layouts of the class are known here. */
  static bool knows(const std::string& className);

  /** What follows the head of an object. \exception std::runtime_error If a size cannot be right,
   * or the version is not one of those that are known. */
  void content(const Head& head);

  /** Any object, which may be of an unknown class. */
  void object();
  /** An object of this class. \return Its version. */
  int objectOf(const char* className);

  void text();    //!< A text with its length
  void matrix();  //!< A CMatrixF as an object, once called CMatrix
  void image();   //!< A CImage as an object
  std::uint64_t pixels(std::uint64_t rows, std::uint64_t columns) const;  //!< Checked product
  std::uint32_t count(std::uint32_t most, const char* what);              //!< Checked number

  /** \exception std::runtime_error With `what`, when the condition does not hold. */
  static void require(bool condition, const std::string& what);

  RecordBytes& bytes;
  const RecordLimits& limits;

 private:
  void readByMrpt(const Head& head);
  void endOfObject();

  int depth_ = 0;
};

}  // namespace quadmap
