/// @file
/// What is left of a problem's rows where some taxels are left out of it. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "inverse/weighting.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/sensing/site.hpp"

namespace tactile_net {

/// Of a problem, what says which readings there are.
struct RowLayout {
  std::vector<double> weights{};
  std::vector<Site> sites{};
  bool unknown_offsets = false;
};

/// Rows of the whole problem, P W g and P W K, into those without the taxels, as `leave_out` has
/// them: where offsets are unknown what is left of a channel has another constant.
class RestOfRows {
 public:
  RestOfRows(const RowLayout& whole, std::span<const std::size_t> taxels)
      : RestOfRows(whole, rows_of(whole, taxels)) {}

  /// @param rows  of the whole problem; those that are gone are 0 afterwards
  [[nodiscard]] Eigen::VectorXd operator()(Eigen::VectorXd rows) const {
    for (const Eigen::Index row : gone_) rows(row) = 0.0;
    return rest_.projected(rows);
  }
  /// Places of what is left out.
  [[nodiscard]] const std::vector<Eigen::Index>& gone() const noexcept { return gone_; }
  /// M, symmetric and positive definite: with rows A of the whole problem, A_g those that go and B
  /// those that are left, B'B = A'A - A_g' M^-1 A_g. It is 1 but where offsets are unknown.
  [[nodiscard]] const Eigen::MatrixXd& metric() const noexcept { return metric_; }

 private:
  RestOfRows(const RowLayout& whole, std::vector<Eigen::Index> gone)
      : gone_(std::move(gone)), rest_(weighting_of(without(whole, gone_))) {
    Eigen::MatrixXd shares = weighting_of(whole).constants()(gone_, Eigen::indexing::all);
    // Of a channel that goes as a whole no constant is left to change.
    for (Eigen::Index c = 0; c < shares.cols(); ++c)
      if (rest_.constants().col(c).squaredNorm() == 0.0) shares.col(c).setZero();
    const auto count = std::ssize(gone_);
    metric_ = Eigen::MatrixXd::Identity(count, count) - shares * shares.transpose();
  }
  static std::vector<Eigen::Index> rows_of(const RowLayout& whole,
                                           std::span<const std::size_t> taxels) {
    std::vector<Eigen::Index> rows;
    for (std::size_t row = 0; row < whole.sites.size(); ++row)
      if (std::find(taxels.begin(), taxels.end(), whole.sites[row].taxel) != taxels.end())
        rows.push_back(static_cast<Eigen::Index>(row));
    return rows;
  }
  static Weighting weighting_of(const RowLayout& rows) {
    return {rows.weights, rows.sites, rows.unknown_offsets};
  }
  static RowLayout without(RowLayout rows, const std::vector<Eigen::Index>& gone) {
    for (const Eigen::Index row : gone) rows.weights[static_cast<std::size_t>(row)] = 0.0;
    return rows;
  }

  std::vector<Eigen::Index> gone_;
  Weighting rest_;
  Eigen::MatrixXd metric_{};
};

}  // namespace tactile_net
