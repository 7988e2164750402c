/// @file
/// What a family of solutions is made of. Private.
#pragma once

#include <memory>
#include <vector>

#include "inverse/standard_form.hpp"
#include "inverse/weighting.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"

namespace tactile_net {

struct TikhonovFamily::Factors {
  /// @param condition  of L, at most
  Factors(const InverseProblem& problem, StandardForm standard, double condition);

  std::size_t line;  // readings whose spectrum is taken together
  Weighting weighting;
  double stabiliser_condition;
  StandardForm form;
  std::vector<double> gamma;
  Eigen::MatrixXd fourier;                         // cosines, then sines, channel by channel
  std::shared_ptr<const Eigen::MatrixXd> spectra;  // of u's columns
};

}  // namespace tactile_net
