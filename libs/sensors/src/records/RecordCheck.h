#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <stdexcept>
#include <string>
#include <type_traits>

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
    std::string name;       //!< Of the class, see classNamed()
    int version = 0;
    std::size_t versionAt = 0;  //!< Index of the byte with the version
  };
  Head headAfterFirstByte();

  /** The name of the class that MRPT finds by a name in a file, without namespaces. MRPT has
   * several names for some classes. For a class that MRPT does not know it is the name in the file.
   */
  static std::string classNamed(const std::string& writtenName);
  /** The name in these bytes: for MRPT it ends at a zero. */
  std::string writtenNameAt(std::size_t begin, std::size_t length);

  /** Whether the layouts of the class are known here. */
  static bool knows(const std::string& className);
  /** Whether objects of the class are read, by MRPT alone where their layout is not known. */
  static bool reads(const std::string& className);
  /** Whether an object of the class may be read where one only seems to begin, as no few bytes take
   * much memory. quadmap's own reader of boxes checks their counts. */
  static bool mayTry(const std::string& className);

  /** What follows the head of an object. \exception std::runtime_error If a size cannot be right,
   * or the version is not one of those that are known. */
  void content(const Head& head);
  /** The same for an object that begins there, of which the first byte and the name were copied, if
   * the layout of its class is known. Other classes are left to MRPT.
   *  \exception std::runtime_error Also for a class of which no objects are read. */
  void contentAfterName(std::size_t begin);

  /** Any object of a class of which objects are read. */
  void object();
  /** An object of this class. \return Its version. */
  int objectOf(const char* className);

  bool flag();    //!< Made 0 or 1, as MRPT takes the byte for a bool; it once wrote any other
  void text();    //!< A text with its length
  void matrix();  //!< A CMatrixF as an object, once called CMatrix
  void image();   //!< A CImage as an object, whose pixels are needed
  std::uint64_t pixels(std::uint64_t rows, std::uint64_t columns) const;  //!< Checked product
  std::uint32_t count(std::uint32_t most, const char* what);              //!< Checked number

  /** \param what A text, or a function that makes it. Records are many: a text that nobody needs
   * would take longer than all else.
   *  \exception std::runtime_error With that text, when the condition does not hold. */
  template <typename What>
  static void require(bool condition, const What& what)
  {
    if (condition) return;
    if constexpr (std::is_invocable_v<What>)
      throw std::runtime_error(what());
    else
      throw std::runtime_error(what);
  }

  /** MRPT's reading of the object that begins there, after its content was checked. */
  mrpt::serialization::CSerializable::Ptr readByMrpt(std::size_t begin);
  /** The same for an object whose layout is not known here: memory is limited meanwhile.
   *  \exception std::runtime_error Also for a class of which no objects are read. */
  mrpt::serialization::CSerializable::Ptr readUnknown(const Head& head);

  static constexpr unsigned kHeadMark = 0x80;  //!< Added by MRPT to the length of a class name

  RecordBytes& bytes;
  const RecordLimits& limits;
  /** Whether the pixels of the next images are needed. Else what a JPEG holds is left out. */
  bool needsPixels = false;
  /** Whether objects of unknown layouts are refused, of which MRPT may take much memory. */
  bool refusesUnknown = false;
  /** Why the first image that cannot be decoded cannot. An empty one was put in its place. */
  std::string damage;

 private:
  Head headAfterName(std::size_t begin);
  void endOfObject();

  int depth_ = 0, unknownDepth_ = 0;
};

}  // namespace quadmap
