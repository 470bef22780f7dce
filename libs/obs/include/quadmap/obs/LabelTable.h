#pragma once

#include <Eigen/Dense>
#include <map>
#include <string>
#include <vector>

namespace mrpt::config
{
class CConfigFile;
}
namespace mrpt::serialization
{
class CArchive;
}

namespace quadmap
{
/** What objects of a label usually stand on or hang on. */
enum class UsualSupport
{
  Floor,
  Object,  //!< On a table, a shelf, another object; nothing is made of it that is not of Any
  Wall,
  Any
};

/** What a label table may say, whichever file it comes from. Sizes and spreads beyond these are no
 * object's, and what is computed from them would overflow. */
struct LabelLimits
{
  static constexpr double kSmallestSize = 0.01, kLargestSize = 100;    //!< [m]
  static constexpr double kSmallestSpread = 0.01, kLargestSpread = 3;  //!< See sizeSpread [-]
};

/** Sizes of things are usual within so many spreads of their kind's typical size. */
constexpr double kUsualSpreads = 2.0;

/** What is known about the objects of a label before one is seen. */
struct LabelProperties
{
  std::string name;               //!< Canonical spelling (COCO's)
  double shapeExponent = 1.5;     //!< q of the support function: 1 cuboid ... 2 ellipsoid
  bool dominantDirection = true;  //!< False when the yaw means nothing, as of cups
  /** The top is a horizontal surface, and what is above it stands on it, as on tables. */
  bool levelTop = false;
  UsualSupport support = UsualSupport::Any;
  Eigen::Vector3d typicalSize = Eigen::Vector3d(0.5, 0.5, 0.5);  //!< Full sizes (x, y, z up) [m]
  double sizeSpread = 1.0;                //!< Standard deviation of the logarithm of a size [-]
  std::vector<std::string> confusedWith;  //!< Canonical names that a detector mistakes it for
  bool known = false;                     //!< False when the table has no such label

  /** ln(larger / smaller) in spreads of the label's sizes: doc/mathematics.md, (9.5) [-]. */
  double spreadsBetween(double smaller, double larger) const
  {
    return std::log(larger / smaller) / sizeSpread;
  }
};

/** The labels of a detector, under all their usual spellings. They are read from an INI file with
 * one section per label. The file in share/quadmap documents the keys. */
class LabelTable
{
 public:
  LabelTable() = default;  //!< A table that knows no label

  /** \exception std::runtime_error If the file cannot be read or a value is out of range; the
   *  message names file, section and key. */
  static LabelTable fromFile(const std::string& path);

  /** The table installed with the library (see findShareFile in quadmap/base/ShareFiles.h). */
  static LabelTable installed();

  /** Canonical name of a spelling. Case, blanks, '_', '-' and an instance number at the end
   *  ("chair_2") play no part; an unknown label is returned as it is. */
  std::string canonical(const std::string& label) const;

  /** Neutral properties (known = false) for labels that are not in the table. */
  LabelProperties properties(const std::string& label) const;

  /** Whether a detector may take one label for the other. It is true for equal labels, and for
   * pairs of which one lists the other in `confusedWith`. */
  bool compatible(const std::string& a, const std::string& b) const;

  /** This table with the classes of another one that it does not have. Where both give a spelling
   * a meaning, this one's counts. */
  LabelTable completedBy(const LabelTable& other) const;

  const std::map<std::string, LabelProperties>& all() const { return byName_; }

  /** All spellings, in lower case and without blanks, '_' and '-', with their canonical names. */
  const std::map<std::string, std::string>& spellings() const { return canonicalByKey_; }

  /** Writes all classes and spellings to a stream, for readFrom(). */
  void writeTo(mrpt::serialization::CArchive& out) const;

  /** \exception std::runtime_error If the stream ends early or holds no table. */
  static LabelTable readFrom(mrpt::serialization::CArchive& in);

 private:
  explicit LabelTable(const mrpt::config::CConfigFile& config);
  void addSpelling(const std::string& spelling, const std::string& name);

  std::map<std::string, LabelProperties> byName_;
  std::map<std::string, std::string> canonicalByKey_;
};

}  // namespace quadmap
