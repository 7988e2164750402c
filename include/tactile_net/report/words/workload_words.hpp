/// @file
/// What a scene calls for, for people.
#pragma once

#include <iosfwd>
#include <string>

#include "tactile_net/lab/workload.hpp"

namespace tactile_net::report {

/// "forward model sampled: sums over tractions on a grid"
[[nodiscard]] std::string why_in_words(const lab::Workload::Task& task);

/// "QR and SVD of 243 x 162, once; about 2.62e+04 operations a frame"; empty where it is left out.
[[nodiscard]] std::string cost_in_words(const lab::Workload::Task& task);

/// What the effect does in this scene, or what its absence saves.
[[nodiscard]] std::string effect_in_words(const lab::Workload::Effect& effect,
                                          const SensedScene& scene);

void print_workload(std::ostream& out, const Scene& scene, const lab::Workload& work);
void print_workload(std::ostream& out, const SkinScene& scene, const lab::Workload& work);

}  // namespace tactile_net::report
