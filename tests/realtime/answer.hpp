/// @file
/// What an estimator says of a frame, and which structures it may have.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"

namespace tactile_net {

inline constexpr Structure structures[] = {Structure::dense, Structure::low_rank,
                                           Structure::reflections, Structure::reflections_low_rank};

/// An estimate with memory of its own; everything set to what no frame gives.
struct Answer {
  explicit Answer(const ContactEstimator& estimator) : tractions(estimator.tractions(), 17.0) {
    estimate = {.tractions = tractions,
                .time = 1.5,
                .normal_force = 2.5,
                .tangential_force = 3.5,
                .centre = 4.5,
                .angle = 5.5,
                .friction_margin = 6.5,
                .residual_rms = 7.5,
                .contact = true,
                .saturated = true,
                .outlier = 8};
  }
  std::vector<double> tractions;
  ContactEstimate estimate;

  /// Every member bit by bit, NaN too.
  [[nodiscard]] std::vector<std::uint64_t> bits() const {
    std::vector<std::uint64_t> all;
    for (const double value : estimate.tractions)
      all.push_back(std::bit_cast<std::uint64_t>(value));
    for (const double value :
         {estimate.time, estimate.normal_force, estimate.tangential_force, estimate.centre,
          estimate.angle, estimate.friction_margin, estimate.residual_rms})
      all.push_back(std::bit_cast<std::uint64_t>(value));
    all.push_back(estimate.contact);
    all.push_back(estimate.saturated);
    all.push_back(static_cast<std::uint64_t>(estimate.outlier));
    return all;
  }
};

inline Answer answer(ContactEstimator& estimator, std::span<const double> readings,
                     double time = 0.0) {
  Answer result(estimator);
  REQUIRE(estimator.update(readings, result.estimate, time) == FrameStatus::ok);
  return result;
}

inline std::vector<double> scaled(std::vector<double> values, int exponent) {
  for (double& value : values) value = std::ldexp(value, exponent);
  return values;
}

}  // namespace tactile_net
