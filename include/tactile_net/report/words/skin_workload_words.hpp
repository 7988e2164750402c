/// @file
/// What a skin's run would do, as text.
#pragma once

#include <iosfwd>
#include <string>

#include "tactile_net/lab/skin_workload.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string why_in_words(const lab::SkinWorkload::Task& task);

/// Empty where it is left out.
[[nodiscard]] std::string cost_in_words(const lab::SkinWorkload::Task& task);

void print_workload(std::ostream& out, const SkinScene& scene, const lab::SkinWorkload& work);

}  // namespace tactile_net::report
