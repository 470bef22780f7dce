#pragma once

#include <Eigen/Dense>
#include <map>
#include <string>
#include <vector>

namespace mrpt::config
{
class CConfigFile;
}

namespace quadmap
{
/** Where objects of a class usually are. */
enum class UsualSupport
{
  Floor,
  Object,  //!< On a table, a shelf, another object
  Wall,
  Any
};

/** What is known about a class of objects before seeing one. */
struct LabelProperties
{
  std::string name;               //!< Canonical spelling (COCO's)
  double shapeExponent = 1.5;     //!< q of h_q: 1 cuboid ... 2 ellipsoid
  bool dominantDirection = true;  //!< False: round or shapeless, its yaw means nothing
  /** Tables, cabinets: its top is a level surface, and what is above stands on it. */
  bool levelTop = false;
  UsualSupport support = UsualSupport::Any;
  Eigen::Vector3d typicalSize = Eigen::Vector3d(0.5, 0.5, 0.5);  //!< Full sizes (x, y, z up) [m]
  double sizeSpread = 1.0;                //!< Standard deviation of the logarithm of a size [-]
  std::vector<std::string> confusedWith;  //!< Canonical names a detector mistakes it for
  bool known = false;                     //!< False: not in the table, the values above are neutral
};

/** The classes of a detector, under all their usual spellings. Read from an INI file: one section
 * per class; the file in share/quadmap documents the keys. */
class LabelTable
{
 public:
  LabelTable() = default;  //!< No class is known

  /** \exception std::runtime_error If the file cannot be read or a value is out of range; the
   *  message names file, section and key. */
  static LabelTable fromFile(const std::string& path);

  /** The table installed with the library (see findShareFile). */
  static LabelTable installed();

  /** Canonical name of a spelling. Case, blanks, '_', '-' and an instance number at the end
   *  ("chair_2") play no part; an unknown label is returned as it is. */
  std::string canonical(const std::string& label) const;

  /** Neutral properties (known = false) for labels that are not in the table. */
  LabelProperties properties(const std::string& label) const;

  /** Can a detector take one for the other? True for equal labels, and for pairs of which either
   *  entry lists the other as confused. */
  bool compatible(const std::string& a, const std::string& b) const;

  const std::map<std::string, LabelProperties>& all() const { return byName_; }

 private:
  explicit LabelTable(const mrpt::config::CConfigFile& config);
  void addSpelling(const std::string& spelling, const std::string& name);

  std::map<std::string, LabelProperties> byName_;
  std::map<std::string, std::string> canonicalByKey_;
};

/** Full path of a data file of the project ("labels.ini", "scenes/home.ini"): looked up in
 * $QUADMAP_SHARE_DIR, then ../share/quadmap beside the library, then the source tree.
 * \exception std::runtime_error If there is no such file; names the places tried. */
std::string findShareFile(const std::string& name);

}  // namespace quadmap
