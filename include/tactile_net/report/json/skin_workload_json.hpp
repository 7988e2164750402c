/// @file
/// What a skin's run would do, as JSON (kind `explain`).
#pragma once

#include <string>

#include "tactile_net/lab/skin_workload.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string workload_json(const SkinScene& scene, const lab::SkinWorkload& work);

}  // namespace tactile_net::report
