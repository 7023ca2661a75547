#include "ofm/dynamics/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "ofm/base/random.h"

namespace ofm {
namespace {

/// Matches made and what they cost, in order of preference.
struct Result {
  int matches = 0;
  double cost = 0;
  bool operator<(const Result& other) const {
    return matches != other.matches ? matches > other.matches : cost < other.cost - 1e-9;
  }
};

Result Value(const Eigen::MatrixXd& cost, const std::vector<int>& column_of) {
  Result result;
  for (std::size_t i = 0; i < column_of.size(); ++i) {
    if (column_of[i] < 0) continue;
    const double value = cost(static_cast<Eigen::Index>(i), column_of[i]);
    if (value >= kForbiddenCost) continue;
    ++result.matches;
    result.cost += value;
  }
  return result;
}

/// The best of all matchings: rows are padded with columns that match nothing.
Result BruteForce(const Eigen::MatrixXd& cost) {
  const int rows = static_cast<int>(cost.rows()), columns = static_cast<int>(cost.cols());
  std::vector<int> order(rows + columns);
  std::iota(order.begin(), order.end(), 0);
  Result best{-1, 0};
  do {
    std::vector<int> column_of;
    for (int i = 0; i < rows; ++i) column_of.push_back(order[i] < columns ? order[i] : -1);
    best = std::min(best, Value(cost, column_of));
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(Assignment, EqualsBruteForce) {
  RandomEngine engine = MakeRandomEngine(5, 0);
  for (int round = 0; round < 60; ++round) {
    const auto rows = 1 + UniformIndex(engine, 4), columns = 1 + UniformIndex(engine, 4);
    Eigen::MatrixXd cost(rows, columns);
    for (Eigen::Index i = 0; i < cost.size(); ++i) {
      cost(i) = UniformReal(engine) < 0.3 ? kForbiddenCost : 10 * UniformReal(engine);
    }
    const auto column_of = SolveAssignment(cost);
    const Result found = Value(cost, column_of), best = BruteForce(cost);
    EXPECT_EQ(found.matches, best.matches) << cost;
    EXPECT_NEAR(found.cost, best.cost, 1e-9) << cost;
  }
}

TEST(Assignment, NoColumnIsGivenTwice) {
  RandomEngine engine = MakeRandomEngine(6, 0);
  for (const auto& [rows, columns] : {std::pair{40, 25}, std::pair{25, 40}, std::pair{30, 30}}) {
    Eigen::MatrixXd cost(rows, columns);
    for (Eigen::Index i = 0; i < cost.size(); ++i) cost(i) = UniformReal(engine);
    std::multiset<int> used;
    for (const int column : SolveAssignment(cost)) {
      if (column >= 0) used.insert(column);
    }
    EXPECT_EQ(used.size(), static_cast<std::size_t>(std::min(rows, columns)));
    EXPECT_EQ(std::set<int>(used.begin(), used.end()).size(), used.size());
  }
}

TEST(Assignment, TheNearestIsNotAlwaysRight) {
  const Eigen::MatrixXd cost = (Eigen::MatrixXd(2, 2) << 1, 2, 1.1, 9).finished();
  EXPECT_EQ(SolveAssignment(cost), (std::vector<int>{1, 0}));
}

TEST(Assignment, WhatIsForbiddenIsNotMatched) {
  EXPECT_EQ(SolveAssignment(Eigen::MatrixXd::Constant(2, 3, kForbiddenCost)),
            (std::vector<int>{-1, -1}));
}

TEST(Assignment, NothingMatchesNothing) {
  EXPECT_TRUE(SolveAssignment(Eigen::MatrixXd(0, 3)).empty());
  EXPECT_EQ(SolveAssignment(Eigen::MatrixXd(2, 0)), (std::vector<int>{-1, -1}));
}

TEST(Assignment, NegativeAndNonFiniteCostsAreAProgrammersError) {
  EXPECT_THROW(SolveAssignment(Eigen::MatrixXd::Constant(1, 1, -1)), std::logic_error);
  EXPECT_THROW(
      SolveAssignment(Eigen::MatrixXd::Constant(1, 1, std::numeric_limits<double>::quiet_NaN())),
      std::logic_error);
}

}  // namespace
}  // namespace ofm
