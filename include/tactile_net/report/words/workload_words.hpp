/// @file
/// What a scene calls for, for people.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "tactile_net/lab/workload.hpp"

namespace tactile_net::report {

/// "the rule gcv"; of none that is named "the default rule".
[[nodiscard]] std::string rule_in_words(std::optional<AlphaRule> rule);

/// "forward model sampled: the sum over the taxels"
[[nodiscard]] std::string why_in_words(const lab::Workload::Task& task);

/// "QR and SVD of 243 x 162, once; about 2.62e+04 operations a frame"; empty where it is left out.
[[nodiscard]] std::string cost_in_words(const lab::Workload::Task& task);

/// What the effect does in this scene, or what its absence saves.
[[nodiscard]] std::string effect_in_words(const lab::Workload::Effect& effect, const Scene& scene);

void print_workload(std::ostream& out, const Scene& scene, const lab::Workload& work);

}  // namespace tactile_net::report
