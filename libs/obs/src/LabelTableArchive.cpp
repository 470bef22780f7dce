#include <mrpt/serialization/CArchive.h>

#include "LabelCounts.h"
#include "quadmap/base/ArchiveFields.h"
#include "quadmap/obs/LabelTable.h"

// A stored table: the number of classes and each class with its properties, then the number of
// spellings and each as its key and the class it stands for.
namespace quadmap
{
namespace
{
using mrpt::serialization::CArchive;

void writeProperties(CArchive& out, const LabelProperties& p)
{
  writeText(out, p.name);
  out << p.shapeExponent << p.dominantDirection << p.levelTop;
  out << static_cast<std::uint8_t>(p.support);
  writeVector(out, p.typicalSize);
  out << p.sizeSpread;
  out.WriteAs<std::uint32_t>(p.confusedWith.size());
  for (const auto& other : p.confusedWith) writeText(out, other);
}

LabelProperties readProperties(CArchive& in)
{
  LabelProperties p;
  p.known = true;
  p.name = readText(in);
  p.shapeExponent = readScalar<double>(in);
  p.dominantDirection = readBool(in);
  p.levelTop = readBool(in);
  p.support = readEnum(in, UsualSupport::Any, "the usual support of a label");
  p.typicalSize = readVector(in);
  p.sizeSpread = readScalar<double>(in);
  for (auto n = readCount(in, kMaxConfused, "confused labels"); n > 0; --n)
    p.confusedWith.push_back(readText(in));
  requireStored(
      p.shapeExponent >= 1 && p.shapeExponent <= 2, "a label's shape exponent is not in [1, 2]");
  requireStored(!p.name.empty(), "a label has no name");
  requireStored(
      p.typicalSize.allFinite() && p.typicalSize.minCoeff() >= LabelLimits::kSmallestSize &&
          p.typicalSize.maxCoeff() <= LabelLimits::kLargestSize,
      "a label's size is not in [0.01, 100] m");
  requireStored(
      p.sizeSpread >= LabelLimits::kSmallestSpread && p.sizeSpread <= LabelLimits::kLargestSpread,
      "a label's size spread is not in [0.01, 3]");
  return p;
}

}  // namespace

void LabelTable::writeTo(CArchive& out) const
{
  out.WriteAs<std::uint32_t>(byName_.size());
  for (const auto& [name, properties] : byName_) writeProperties(out, properties);
  out.WriteAs<std::uint32_t>(canonicalByKey_.size());
  for (const auto& [key, name] : canonicalByKey_)
  {
    writeText(out, key);
    writeText(out, name);
  }
}

LabelTable LabelTable::readFrom(CArchive& in)
{
  LabelTable table;
  for (auto n = readCount(in, kMaxClasses, "labels"); n > 0; --n)
  {
    const LabelProperties properties = readProperties(in);
    requireStored(
        table.byName_.emplace(properties.name, properties).second, "a label stands there twice");
  }
  for (auto n = readCount(in, kMaxSpellings, "spellings"); n > 0; --n)
  {
    const auto key = readText(in);
    const auto name = readText(in);
    requireStored(table.byName_.count(name) != 0, "a spelling stands for no label");
    table.canonicalByKey_[key] = name;
  }
  return table;
}

}  // namespace quadmap
