/// @file
/// How far one frame's tractions may be from the truth.
#pragma once

#include <span>
#include <vector>

#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/lab/method.hpp"

namespace tactile_net::lab {

struct FrameUncertainty {
  NoiseEstimate noise{};
  UncertainResultant resultant{};
  std::vector<double> deviation{};  ///< of every traction [Pa]
};

/// @param facts  of the solver that found `tractions`
/// @param gml    the rule's choice on these readings: the size of the prior, if its verdict is ok
[[nodiscard]] FrameUncertainty uncertainty_of(const Scene& scene, const InverseProblem& problem,
                                              std::span<const double> readings,
                                              std::span<const double> tractions,
                                              const FrameFacts& facts, const AlphaChoice& gml);

/// What a user should know of it, or nothing.
[[nodiscard]] std::string model_error_in_words(const NoiseEstimate& noise);

}  // namespace tactile_net::lab
