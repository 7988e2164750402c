/// @file
/// Whether readings are likelier those of taxels in another order than as they stand. Private.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lab/check/pattern_solver.hpp"

namespace tactile_net::lab {

/// Frames that are asked at most.
inline constexpr std::size_t most_ordered = 8;

class OrderContest {
 public:
  /// A frame in an order: one of those that are numbered from 0.
  using Turned = std::function<std::vector<double>(std::span<const double> frame, std::size_t)>;

  OrderContest(PatternSolver& solver, std::vector<bool> living, std::size_t orders, Turned turned)
      : solver_(solver),
        living_(std::move(living)),
        turned_(std::move(turned)),
        gain_(orders),
        better_(orders) {}

  /// @return whether it can be said
  [[nodiscard]] bool add(std::span<const double> frame) {
    const std::optional<double> stated = solver_.negative_log_evidence(frame, living_);
    if (!stated) return false;
    for (std::size_t order = 0; order < gain_.size(); ++order) {
      const std::optional<double> other =
          solver_.negative_log_evidence(turned_(frame, order), living_);
      if (!other) return false;
      gain_[order] += *stated - *other;
      if (*other < *stated) ++better_[order];
    }
    ++frames_;
    return true;
  }

  /// Of log-likelihoods, of each order.
  [[nodiscard]] const std::vector<double>& gain() const noexcept { return gain_; }
  /// How many frames are likelier so.
  [[nodiscard]] std::size_t better(std::size_t order) const { return better_[order]; }

  /// A frame of which neither order is likelier gains nothing, and a pad that is a little other
  /// than stated does not gain by turning it.
  static constexpr double least_gain = 20.0;
  [[nodiscard]] bool wins(std::size_t order) const {
    return gain_[order] > least_gain && 5 * better_[order] >= 4 * frames_;
  }

 private:
  PatternSolver& solver_;
  std::vector<bool> living_;
  Turned turned_;
  std::vector<double> gain_;
  std::vector<std::size_t> better_;
  std::size_t frames_ = 0;
};

}  // namespace tactile_net::lab
