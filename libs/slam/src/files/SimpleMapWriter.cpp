#include "files/SimpleMapWriter.h"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

#include "quadmap/base/GzipStream.h"

namespace quadmap
{
namespace
{
/** Writes itself to an archive under the name of another class. The content need not be in memory
 * as one object. */
class StandIn : public mrpt::serialization::CSerializable
{
 public:
  StandIn(const mrpt::rtti::TRuntimeClassId* id, std::uint8_t version) : id_(id), version_(version)
  {
  }
  const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override { return id_; }
  mrpt::rtti::CObject* clone() const override { throw std::logic_error("only for writing"); }

 protected:
  std::uint8_t serializeGetVersion() const override { return version_; }
  void serializeFrom(mrpt::serialization::CArchive&, std::uint8_t) override
  {
    throw std::logic_error("only for writing");
  }

 private:
  const mrpt::rtti::TRuntimeClassId* id_;
  std::uint8_t version_;
};

/** A CSensoryFrame of observations that are already compressed. Version 2 of that class has their
 * number, followed by the observations. */
class StreamedSensoryFrame : public StandIn
{
 public:
  StreamedSensoryFrame(std::vector<KeyframeSpool::Bytes> members, GzipFileWriter& file) :
      StandIn(CLASS_ID(mrpt::obs::CSensoryFrame), 2), members_(std::move(members)), file_(file)
  {
  }

 protected:
  void serializeTo(mrpt::serialization::CArchive& out) const override
  {
    out << static_cast<std::uint32_t>(members_.size());
    for (const auto& member : members_) file_.appendMember(member);
  }

 private:
  std::vector<KeyframeSpool::Bytes> members_;
  GzipFileWriter& file_;  //!< The file below the archive
};

/** A CSimpleMap. Version 1 of that class has the number of keyframes, followed by the pose and the
 * sensory frame of each. Later releases of MRPT read it too. */
class StreamedSimpleMap : public StandIn
{
 public:
  StreamedSimpleMap(
      const std::vector<PoseNode>& nodes,
      const KeyframeSpool& spool,
      SimpleMapContent content,
      const std::vector<mrpt::poses::CPose3DPDFGaussian>& poses,
      GzipFileWriter& file) :
      StandIn(CLASS_ID(mrpt::maps::CSimpleMap), 1),
      nodes_(nodes),
      spool_(spool),
      content_(content),
      poses_(poses),
      file_(file)
  {
  }

 protected:
  void serializeTo(mrpt::serialization::CArchive& out) const override
  {
    out << static_cast<std::uint32_t>(nodes_.size());
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      out << poses_[n] << StreamedSensoryFrame(membersOf(nodes_[n]), file_);
  }

 private:
  std::vector<KeyframeSpool::Bytes> membersOf(const PoseNode& node) const
  {
    std::vector<KeyframeSpool::Bytes> members;
    for (const std::size_t k : node.keyframes)
      if (content_ == SimpleMapContent::Scans)
        members.push_back(spool_.scanMembers(k));
      else if (auto boxes = spool_.objectsMember(k); boxes)
        members.push_back(std::move(*boxes));
    return members;
  }

  const std::vector<PoseNode>& nodes_;
  const KeyframeSpool& spool_;
  SimpleMapContent content_;
  const std::vector<mrpt::poses::CPose3DPDFGaussian>& poses_;
  GzipFileWriter& file_;
};

}  // namespace

void writeSimpleMap(
    const std::string& path,
    const std::vector<PoseNode>& nodes,
    const KeyframeSpool& spool,
    SimpleMapContent content,
    const std::vector<mrpt::poses::CPose3DPDFGaussian>& poses)
{
  GzipFileWriter file(path);
  auto archive = mrpt::serialization::archiveFrom(file);
  archive << StreamedSimpleMap(nodes, spool, content, poses, file);
  file.commit();
}

}  // namespace quadmap
