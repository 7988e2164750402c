/// @file
/// What a family of solutions is made of. Private.
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

#include "inverse/standard_form.hpp"
#include "inverse/weighting.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"

namespace tactile_net {

struct TikhonovFamily::Factors {
  /// @param condition  of L, at most
  Factors(const LinearProblem& problem, StandardForm standard, double condition);

  /// The transform of readings to frequencies, which the rule ncp alone asks for.
  struct Spectra {
    Eigen::MatrixXd fourier;  // cosines, then sines, channel by channel
    Eigen::MatrixXd of_u;     // of u's columns
  };
  /// Made when it is first asked for. Thread-safe.
  [[nodiscard]] const Spectra& spectra() const;

  std::size_t line;  // readings whose spectrum is taken together
  Weighting weighting;
  double stabiliser_condition;
  StandardForm form;
  std::vector<double> gamma;

 private:
  mutable std::once_flag spectra_made_{};
  mutable Spectra spectra_{};
};

}  // namespace tactile_net
