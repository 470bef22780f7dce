#include "quadmap/surfaces/SurfacePatch.h"

namespace quadmap
{
Eigen::Vector3f transformed(const Eigen::Vector3f& p_b, const mrpt::poses::CPose3D& T_a_b)
{
  double x, y, z;
  T_a_b.composePoint(p_b.x(), p_b.y(), p_b.z(), x, y, z);
  return Eigen::Vector3d(x, y, z).cast<float>();
}

SurfacePatch transformed(const SurfacePatch& patch_b, const mrpt::poses::CPose3D& T_a_b)
{
  SurfacePatch out = {patch_b.kind, patch_b.plane.transformed(T_a_b), {}, patch_b.isFurniture};
  out.samples.reserve(patch_b.samples.size());
  for (const auto& p : patch_b.samples) out.samples.push_back(transformed(p, T_a_b));
  return out;
}

}  // namespace quadmap
