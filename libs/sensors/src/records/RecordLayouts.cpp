#include "records/RecordLayouts.h"

#include <mrpt/obs/CObservationIMU.h>

namespace quadmap
{
namespace
{
using Head = RecordCheck::Head;

constexpr std::uint64_t kDouble = sizeof(double), kWord = 4;

/** So many observations or actions are never in one record, and MRPT makes room for them first. */
constexpr std::uint32_t kMostMembers = 1000;
/** Samples of a motion; MRPT takes 300 itself. */
constexpr std::uint32_t kMostParticles = 100000;
constexpr std::uint32_t kMostRays = 1000000;

void followPose3D(RecordCheck& c, const Head& head)
{
  constexpr std::uint64_t kQuaternionForm = 7, kMatrixForm = 12;  // numbers of either form
  c.bytes.copy((head.version == 2 ? kQuaternionForm : kMatrixForm) * kDouble);
}

void followPose2D(RecordCheck& c, const Head&) { c.bytes.copy(3 * kDouble); }

void followPose3DGaussian(RecordCheck& c, const Head&)
{
  c.objectOf("CPose3D");
  c.bytes.copy(21 * kDouble);  // the upper half of a 6x6 matrix
}

void followMatrix(RecordCheck& c, const Head&)
{
  const std::uint64_t rows = c.bytes.number<std::uint32_t>();
  const std::uint64_t columns = c.bytes.number<std::uint32_t>();
  c.bytes.copy(c.pixels(rows, columns) * kFloat);
}

void followCamera(RecordCheck& c, const Head& head)
{
  c.bytes.copy(
      kDouble + 8 * kDouble + 4 * kDouble + 2 * kWord);  // focal length, lens, fx to cy, size
  if (head.version >= 5) c.text();
  if (head.version >= 6) c.bytes.copy(1);
}

void followSensoryFrame(RecordCheck& c, const Head&)
{
  for (auto n = c.count(kMostMembers, "observations"); n > 0; --n) c.object();
}

void followActions(RecordCheck& c, const Head&)
{
  for (auto n = c.count(kMostMembers, "actions"); n > 0; --n) c.object();
}

void followMovement3D(RecordCheck& c, const Head& head)
{
  constexpr std::uint32_t kVelocities = 6;
  c.bytes.copy(kWord);
  c.objectOf("CPose3DPDFGaussian");
  c.bytes.copy(c.count(kVelocities, "velocities"));
  c.bytes.copy(c.count(kVelocities, "velocities") * kFloat);
  if (head.version >= 1) c.bytes.copy(kTime);
}

/** The odometry's increment and its noise. By Thrun's model MRPT draws the particles that are
 * stated here while it reads an action. Nobody looks at them (see thrunCovariance()): one is
 * enough. */
void motionModel(RecordCheck& c, int version)
{
  constexpr std::uint32_t kGaussian = 0;
  c.objectOf("CPose2D");
  const bool drawsParticles = c.bytes.number<std::uint32_t>() != kGaussian;
  c.bytes.copy(6 * kFloat);
  c.count(kMostParticles, "particles");
  if (drawsParticles) c.bytes.replaceFrom(c.bytes.size() - kWord, {1, 0, 0, 0});
  c.bytes.copy((version >= 5 ? 6 : 4) * kFloat);
}

void followMovement2D(RecordCheck& c, const Head& head)
{
  // MRPT takes two floats of version 3 for doubles, and other bytes for the number of particles.
  RecordCheck::require(head.version != 3, "holds a motion in a form that MRPT misreads");
  constexpr std::uint32_t kFromOdometry = 0;
  if (c.bytes.number<std::uint32_t>() == kFromOdometry)
    motionModel(c, head.version);
  else
    c.object();
  const bool hasVelocities = c.flag();
  if (head.version < 7)
    c.bytes.copy(2 * kFloat);
  else if (hasVelocities)
    c.bytes.copy(3 * kDouble);
  const bool hasTicks = c.flag();
  if (head.version < 7 || hasTicks) c.bytes.copy(2 * kWord);
  if (head.version >= 6) c.bytes.copy(kTime);
}

void followRobotPose(RecordCheck& c, const Head& head)
{
  c.objectOf("CPose3DPDFGaussian");
  c.text();
  c.bytes.copy(kTime);
  if (head.version >= 1) c.objectOf("CPose3D");
}

void followOdometry(RecordCheck& c, const Head& head)
{
  c.objectOf("CPose2D");
  c.text();
  c.bytes.copy(kTime);
  if (head.version == 0) return;
  const bool hasTicks = c.flag();
  if (hasTicks || head.version < 2) c.bytes.copy(2 * kWord);
  const bool hasVelocities = c.flag();
  if (head.version < 2)
    c.bytes.copy(2 * kFloat);
  else if (hasVelocities)
    c.bytes.copy(3 * kDouble);
}

void followLaserScan(RecordCheck& c, const Head& head)
{
  c.bytes.copy(kFloat + 1 + kFloat);
  c.objectOf("CPose3D");
  if (head.version < 6) c.matrix();
  const std::uint64_t rays = c.count(kMostRays, "rays");
  c.bytes.copy(rays * (kFloat + 1));  // ranges, and whether they are valid
  c.bytes.copy(kFloat + kTime + kFloat);
  if (head.version >= 5)
  {
    c.text();
    c.bytes.copy(kDouble);
  }
  if (head.version >= 7 && c.flag()) c.bytes.copy(rays * kWord);
}

void followImageObservation(RecordCheck& c, const Head&)
{
  c.objectOf("CPose3D");
  c.objectOf("TCamera");
  c.objectOf("CImage");
  c.bytes.copy(kTime);
  c.text();
}

void followImu(RecordCheck& c, const Head&)
{
  c.objectOf("CPose3D");
  c.bytes.copy(mrpt::obs::COUNT_IMU_DATA_FIELDS + kTime);
  c.bytes.copy(mrpt::obs::COUNT_IMU_DATA_FIELDS * kDouble);
  c.text();
}

}  // namespace

const std::map<std::string, Layout>& layouts()
{
  static const std::map<std::string, Layout> table = {
      {                "CPose3D",            {2, 3, true, followPose3D}},
      {                "CPose2D",            {1, 1, true, followPose2D}},
      {     "CPose3DPDFGaussian",    {1, 1, true, followPose3DGaussian}},
      {               "CMatrixF",           {0, 0, false, followMatrix}},
      {                "CMatrix",           {0, 0, false, followMatrix}},
      {                "TCamera",            {4, 6, true, followCamera}},
      {                 "CImage",            {6, 9, false, followImage}},
      {          "CSensoryFrame",     {2, 2, false, followSensoryFrame}},
      {      "CActionCollection",          {0, 0, false, followActions}},
      { "CActionRobotMovement3D",        {0, 1, true, followMovement3D}},
      { "CActionRobotMovement2D",        {3, 7, true, followMovement2D}},
      {  "CObservationRobotPose",         {0, 1, true, followRobotPose}},
      {   "CObservationOdometry",          {0, 2, true, followOdometry}},
      {"CObservation2DRangeScan",         {4, 7, true, followLaserScan}},
      {"CObservation3DRangeScan",       {2, 10, false, followRangeScan}},
      {      "CObservationImage", {4, 4, false, followImageObservation}},
      {        "CObservationIMU",               {4, 4, true, followImu}},
  };
  return table;
}

}  // namespace quadmap
