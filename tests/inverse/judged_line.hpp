/// @file
/// A line of taxels, and the judge of what they read.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"

namespace tactile_net {

/// One or two channels over a half plane, and the judge of what they read.
struct JudgedLine {
  SensorArray array{.count = 21, .pitch = 1.0, .depths = {1.5}, .reads = {Quantity::stress_x}};
  Material pad{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
  std::size_t unknowns = 1;
  double noise = 1e-3;
  bool stated = true;

  static JudgedLine two_tractions() {
    JudgedLine bench;
    bench.array.reads.push_back(Quantity::shear_xy);
    bench.unknowns = 2;
    return bench;
  }

  [[nodiscard]] LinearProblem problem() const {
    return make_problem(
        array, pad,
        {.unknowns = unknowns, .smoothing_length = 1.5, .surface = {.basis = SurfaceBasis::hats}});
  }
  [[nodiscard]] DataLimits limits() const {
    const double end = 0.25 * static_cast<double>(array.count - 1) * array.pitch;
    DataLimits limits{.largest_traction = pad.youngs_modulus, .inner = std::pair(-end, end)};
    if (stated) limits.noise_rms = noise;
    limits.largest_readings.assign(reading_count(array), pad.youngs_modulus);
    return limits;
  }
  [[nodiscard]] std::vector<double> frame(const RigidContact& contact, std::size_t number) const {
    std::vector<double> readings = exact_readings(array, pad, std::vector<Contact>{contact});
    add_noise(readings, noise, number, 0);
    return readings;
  }
  [[nodiscard]] DataVerdict judge(const std::vector<double>& readings) const {
    const LinearProblem p = problem();
    return DataJudge(p, limits()).judge(readings, tikhonov_solve(p, 1e-5, readings));
  }
};

inline RigidContact contact_at(double place, double friction = 0.0) {
  return {.center = place, .half_width = 2.0, .force = 0.4, .friction = friction};
}

inline std::vector<DataDoubt> only(DataDoubt doubt) { return {doubt}; }

}  // namespace tactile_net
