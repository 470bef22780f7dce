#include "quadmap/constellation/Moves.h"

#include "quadmap/constellation/ConstellationMatch.h"
#include "quadmap/estimation/Assignment.h"

namespace quadmap
{
std::vector<Move> movesBetween(
    const std::vector<const MapObject*>& gone,
    const std::vector<const MapObject*>& came,
    const LabelTable& labels,
    const ConstellationOptions& options)
{
  const auto rows = static_cast<Eigen::Index>(gone.size());
  const auto columns = static_cast<Eigen::Index>(came.size());
  constexpr double kNoMove = 1e6;  // more than any way [m]
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(rows, columns + rows, kNoMove);
  for (std::size_t r = 0; r < gone.size(); ++r)
    for (std::size_t c = 0; c < came.size(); ++c)
      if (areAlike(*gone[r], *came[c], labels, options))
        cost(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
            (gone[r]->object.center() - came[c]->object.center()).norm();
  std::vector<Move> moves;
  const auto columnOf = optimalAssignment(cost);
  for (std::size_t r = 0; r < columnOf.size(); ++r)
  {
    const double way = cost(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(columnOf[r]));
    if (way < kNoMove) moves.push_back({gone[r]->id, came[columnOf[r]]->id, way});
  }
  return moves;
}

}  // namespace quadmap
