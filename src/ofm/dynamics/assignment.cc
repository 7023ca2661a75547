#include "ofm/dynamics/assignment.h"

#include <algorithm>
#include <limits>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// Dual prices and the matching so far; index 0 of each list is a place of its own, which holds the
/// row that is being added.
struct Matching {
  explicit Matching(Eigen::Index rows, Eigen::Index columns)
      : row_price(rows + 1, 0), column_price(columns + 1, 0), row_of(columns + 1, 0) {}

  std::vector<double> row_price, column_price;
  std::vector<Eigen::Index> row_of;  // of a column; 0 = free
};

/// Adds `row` (from 1) along the shortest augmenting path.
void AddRow(const Eigen::MatrixXd& cost, Eigen::Index row, Matching& m) {
  const Eigen::Index columns = cost.cols();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> distance(columns + 1, kInfinity);
  std::vector<Eigen::Index> previous(columns + 1, 0);
  std::vector<char> done(columns + 1, 0);
  m.row_of[0] = row;
  Eigen::Index column = 0;
  while (m.row_of[column] != 0) {
    done[column] = 1;
    const Eigen::Index from = m.row_of[column];
    Eigen::Index nearest = 0;
    double step = kInfinity;
    for (Eigen::Index j = 1; j <= columns; ++j) {
      if (done[j] != 0) continue;
      const double reduced = cost(from - 1, j - 1) - m.row_price[from] - m.column_price[j];
      if (reduced < distance[j]) {
        distance[j] = reduced;
        previous[j] = column;
      }
      if (distance[j] < step) {
        step = distance[j];
        nearest = j;
      }
    }
    for (Eigen::Index j = 0; j <= columns; ++j) {
      if (done[j] != 0) {
        m.row_price[m.row_of[j]] += step;
        m.column_price[j] -= step;
      } else {
        distance[j] -= step;
      }
    }
    column = nearest;
  }
  for (; column != 0; column = previous[column]) m.row_of[column] = m.row_of[previous[column]];
}

}  // namespace

std::vector<int> SolveAssignment(const Eigen::MatrixXd& cost) {
  OFM_CHECK(cost.size() == 0 || (cost.allFinite() && cost.minCoeff() >= 0));
  std::vector<int> column_of(static_cast<std::size_t>(cost.rows()), -1);
  if (cost.size() == 0) return column_of;
  const bool is_tall = cost.rows() > cost.cols();
  // One that is forbidden must cost more than any number of others saves.
  const Eigen::MatrixXd wide =
      (is_tall ? Eigen::MatrixXd(cost.transpose()) : cost).cwiseMin(kForbiddenCost);
  Matching matching(wide.rows(), wide.cols());
  for (Eigen::Index row = 1; row <= wide.rows(); ++row) AddRow(wide, row, matching);
  for (Eigen::Index j = 1; j <= wide.cols(); ++j) {
    const Eigen::Index i = matching.row_of[j];
    if (i == 0 || wide(i - 1, j - 1) >= kForbiddenCost) continue;
    const Eigen::Index row = is_tall ? j - 1 : i - 1, column = is_tall ? i - 1 : j - 1;
    column_of[static_cast<std::size_t>(row)] = static_cast<int>(column);
  }
  return column_of;
}

}  // namespace ofm
