#pragma once

#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

#include "Commands.h"
#include "common/CommandLine.h"
#include "common/SeveralOutputs.h"
#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
using Text = TCLAP::ValueArg<std::string>;

/** The id of an object as an argument. An unsigned number would be read from "-1" as well. */
struct IdNumber
{
  ObjectId value = 0;
};

inline std::istream& operator>>(std::istream& in, IdNumber& id)
{
  if ((in >> std::ws).peek() == '-') in.setstate(std::ios::failbit);
  return in >> id.value;
}

using Id = TCLAP::ValueArg<IdNumber>;

/** What the sub-commands that change a map have in common. */
struct EditCli
{
  EditCli(const std::string& command, const std::string& description) :
      line("quadmap-map " + command, description, QUADMAP_VERSION)
  {
  }

  /** \return As CommandLine::parse(). \exception cli::UsageError Also when the output has another
   * ending than .quadmap, as what is called .json or .simplemap is not read as a map. */
  bool parse(int argc, char** argv)
  {
    if (!line.parse(argc, argv)) return false;
    const auto extension = std::filesystem::path(output.getValue()).extension();
    if (!extension.empty() && extension != ".quadmap")
      throw cli::UsageError(
          "-o: a map is written as .quadmap, got '" + oneLine(output.getValue()) + "'");
    return true;
  }

  /** Where to tell what was done. Call it before the map is written. */
  std::ostream& messages() { return cli::messagesBeside(output.getValue()); }

  /** Writes the changed map and says so. */
  void write(const CQuadricObjectMap& map)
  {
    std::ostream& out = messages();
    map.saveToFile(output.getValue());
    tellWritten(map, out);
  }

  void tellWritten(const CQuadricObjectMap& map, std::ostream& out)
  {
    out << "wrote " << output.getValue() << " with " << map.confirmedObjects().size()
        << " objects\n";
  }

  cli::CommandLine line;
  TCLAP::UnlabeledValueArg<std::string> file{"MAP", kMapHelp, true, "", "MAP", line.args()};
  Text output{"o",           "output",   "The map that results (.quadmap).", true, "",
              "out.quadmap", line.args()};
};

/** \exception std::runtime_error If the map has no such object; names the file. */
inline void requireObject(const CQuadricObjectMap& map, ObjectId id, const std::string& path)
{
  if (!map.find(id))
    throw std::runtime_error(path + ": has no object with id " + std::to_string(id));
}

}  // namespace quadmap
