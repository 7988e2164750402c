/// @file
/// What tests find: by an operator, and by the evidence.
#pragma once

#include <span>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tests/catch.hpp"

namespace tactile_net {

inline std::vector<double> solved(const Reconstruction& inverse, const std::vector<double>& g) {
  std::vector<double> f(inverse.tractions());
  REQUIRE(inverse.solve(g, f) == FrameStatus::ok);
  return f;
}

struct EvidenceAnswer {
  double alpha = 0.0;
  UncertainResultant contact{};
};

/// By the evidence, with the band of its own prior.
inline EvidenceAnswer solve_by_evidence(const LinearProblem& problem,
                                        std::span<const double> readings, double sigma) {
  const TikhonovFamily family(problem);
  const FilterFrame frame = family.analyse(readings);
  EvidenceAnswer answer{.alpha = choose_alone(frame, AlphaRule::evidence, sigma).alpha};
  const TractionCovariance covariance(family, answer.alpha, answer.alpha);
  answer.contact = resultant_of(problem, family.solve(frame, answer.alpha), covariance, sigma);
  return answer;
}

}  // namespace tactile_net
