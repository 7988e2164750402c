/// @file
/// Tikhonov's method for every alpha at once, of an array too long for one decomposition.
///
/// What a reading tells of a traction, and what a traction's band depends on, lies within a few
/// depths. So a long regular array is looked at in sections of 48 depths that overlap, each with
/// the kernel and the dead taxels of its place, under tapers t_s that add up to 1 at every taxel
/// and are 0 over the last sixth of a section. For a function F of the influence matrix H, such as
/// the residual's square,
///
///     g' F(H) g  ~  sum_s (t_s g)' F(H_s) g,    tr F(H)  ~  sum_s tr(t_s F(H_s))
///
/// Both are sums over the sections' generalised singular values, which is all that the rules for
/// alpha ask for. Sections without a dead taxel have one and the same decomposition. Against one of
/// the whole array alpha differs by up to 1e-4 of itself, bands by 1e-5 (the tests hold ten times
/// that); ncp is judged by Welch's periodogram instead, some 20 % off in alpha. The tractions
/// themselves are not approximated: fft_tikhonov.hpp.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/filter_frame.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

class LongArrayFamily {
 public:
  /// One decomposition of a section's size, and one for each other pattern of dead taxels in a
  /// section. An array of at most a section's length is one section: then nothing is approximated.
  ///
  /// @throw std::invalid_argument  as `make_problem`
  LongArrayFamily(const SensorArray& array, const Material& material,
                  const LineProblemOptions& options);
  /// Number of sections.
  [[nodiscard]] std::size_t sections() const noexcept;

  /// The frame for the rules for alpha, with `shares`. O(readings x section).
  ///
  /// @throw std::invalid_argument  readings have the wrong size or are not finite
  [[nodiscard]] FilterFrame analyse(std::span<const double> readings) const;

  /// Standard deviation of every traction per unit of noise [Pa], by the sections that it lies in.
  ///
  /// @throw std::invalid_argument  alpha or prior_alpha is not > 0 and finite
  [[nodiscard]] std::vector<double> deviations(double alpha, double prior_alpha) const;

  /// tr H: how many of the readings' degrees of freedom the tractions of one alpha use up.
  [[nodiscard]] double degrees_of_freedom(double alpha) const noexcept;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;  // frames share it
};

}  // namespace tactile_net
