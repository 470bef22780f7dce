#include "quadmap/slam/SimpleMapWriter.h"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

#include "quadmap/obs/GzipStream.h"

namespace quadmap
{
namespace
{
/** Stands for a CSimpleMap in an archive. Version 1 of that class is the number of keyframes, then
 * for each its pose and its sensory frame; later releases of MRPT read it too. */
class StreamedSimpleMap : public mrpt::serialization::CSerializable
{
 public:
  StreamedSimpleMap(
      const std::vector<Keyframe>& keyframes,
      const KeyframeSpool& spool,
      SimpleMapContent content,
      PoseCovarianceChain covariances,
      GzipFileWriter& file) :
      keyframes_(keyframes),
      spool_(spool),
      content_(content),
      covariances_(std::move(covariances)),
      file_(file)
  {
  }

  const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override
  {
    return CLASS_ID(mrpt::maps::CSimpleMap);
  }
  mrpt::rtti::CObject* clone() const override { throw std::logic_error("only for writing"); }

 protected:
  uint8_t serializeGetVersion() const override { return 1; }
  void serializeTo(mrpt::serialization::CArchive& out) const override
  {
    PoseCovarianceChain covariances = covariances_;
    out << static_cast<uint32_t>(keyframes_.size());
    for (std::size_t k = 0; k < keyframes_.size(); ++k)
    {
      out << covariances.next(keyframes_[k].T_map_robot);
      file_.appendMember(
          content_ == SimpleMapContent::Scans ? spool_.scanMember(k) : spool_.objectsMember(k));
    }
  }
  void serializeFrom(mrpt::serialization::CArchive&, uint8_t) override
  {
    throw std::logic_error("only for writing");
  }

 private:
  const std::vector<Keyframe>& keyframes_;
  const KeyframeSpool& spool_;
  SimpleMapContent content_;
  PoseCovarianceChain covariances_;
  GzipFileWriter& file_;  //!< Below the archive, for the members that are compressed already
};

}  // namespace

void writeSimpleMap(
    const std::string& path,
    const std::vector<Keyframe>& keyframes,
    const KeyframeSpool& spool,
    SimpleMapContent content,
    PoseCovarianceChain covariances)
{
  GzipFileWriter file(path);
  auto archive = mrpt::serialization::archiveFrom(file);
  archive << StreamedSimpleMap(keyframes, spool, content, std::move(covariances), file);
  file.commit();
}

}  // namespace quadmap
