#include "cloud/Cluster.h"

#include "cloud/Precision.h"

namespace quadmap
{
bool isFragment(const Cluster& cluster, const Cluster& main)
{
  constexpr double kWhole = 0.85;  // of the box, filled by a main part that needs no others
  return main.fill < kWhole && cluster.count >= static_cast<int>(kFewestCells) &&
         cluster.leaking == 0 && cluster.nearest > main.nearest - kEndSlack &&
         cluster.farthest < main.farthest + kEndSlack;
}

bool isFront(const Cluster& cluster, const Cluster& main, const Eigen::Vector2d& down)
{
  constexpr double kMinBreadth = 0.7;  // of the main part's
  const Span across = main.across(down);
  return cluster.leaking == 0 &&
         across.common(cluster.across(down)) > kMinBreadth * across.length() &&
         cluster.lowest(down) > main.lowest(down) && cluster.farthest < main.farthest;
}

}  // namespace quadmap
