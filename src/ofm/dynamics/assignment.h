// The cheapest one-to-one matching.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ofm {

/// Costs of this and above are no match.
inline constexpr double kForbiddenCost = 1e6;

/// For every row of `cost` its column, or -1: as many as possible are matched below kForbiddenCost
/// and, of such matchings, one with the least sum of costs. Costs are finite and at least 0. The
/// Hungarian method by shortest augmenting paths, O(n³) (Kuhn 1955; Jonker and Volgenant 1987).
std::vector<int> SolveAssignment(const Eigen::MatrixXd& cost);

}  // namespace ofm
