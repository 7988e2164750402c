/// @file
/// Bands that do not take the load to be everywhere: where may it press, and how hard?
///
/// `TractionCovariance`'s prior says that tractions are equally large all over the surface. Where a
/// taxel lies over every depth that hardly matters. On a coarse array it makes bands too wide where
/// nothing presses, beyond the array's ends above all, and too narrow where something does, as the
/// quiet taxels lower the size that they share with the loud one.
///
/// Here the load lies in a window of the surface and nowhere else; in the window L f is white,
/// with the variance sigma^2 / alpha. Nobody knows the window or its alpha: every window of a
/// dictionary and every alpha on a scale count as much as the readings make them likely,
///
///     p  ~  exp(-1/2 [ g'(I - H) g / sigma^2 - log det(I - H) ]),  H of that window and alpha,
///
/// a priori each width as often as another, each place of one width, each decade of alpha. The
/// error of given tractions is then the mixture's (law of total variance; Hoeting and others 1999)
///
///     C = sum p [ C_p + (f_p - f)(f_p - f)' ],  f_p and C_p the posterior's mean and covariance.
///
/// Two deviations hold force, centre and tractions of contacts inside the array and over its ends
/// as docs/internals/numerics.md has measured.
///
///     const LoadWindows windows(problem, depth);  // once
///     const RootCovariance covariance = windows.covariance(readings, f, alpha, noise_rms);
///     resultant_of(problem, f, covariance, noise_rms).normal.deviation;  // uncertainty.hpp
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

class LoadWindows {
 public:
  /// The whole surface, and windows of up to nine widths from `narrowest` on, each sqrt(2) times
  /// the one before, a quarter of the width apart, with their middles between the first and the
  /// last taxel: O(n) of them. As much as some ten decompositions of the whole problem.
  ///
  /// @param narrowest  [m], > 0; one depth, or three to four where taxels are dense and tell widths
  /// @throw std::invalid_argument  narrowest is not > 0 and finite
  LoadWindows(const LinearProblem& problem, double narrowest);
  ~LoadWindows();
  LoadWindows(LoadWindows&&) noexcept;
  LoadWindows& operator=(LoadWindows&&) noexcept;

  /// Number of windows.
  [[nodiscard]] std::size_t count() const noexcept;

  /// Covariance of the error of `tractions`, per unit of `noise_rms` squared. O(readings^2) for
  /// each window, and O(n readings) for each that is likely.
  ///
  /// @param readings   one per row of the problem, as the frame's
  /// @param tractions  any estimate from them: [Pa]
  /// @param alpha      of the estimate: its degrees of freedom are the covariance's
  /// @param noise_rms  of one weighted reading, > 0
  /// @throw std::invalid_argument  a size does not fit, a value is not finite or out of its range
  [[nodiscard]] RootCovariance covariance(std::span<const double> readings,
                                          std::span<const double> tractions, double alpha,
                                          double noise_rms) const;

 private:
  struct Windows;
  std::unique_ptr<const Windows> windows_;
};

}  // namespace tactile_net
