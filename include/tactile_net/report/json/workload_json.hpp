/// @file
/// What a scene calls for, as a document for machines.
#pragma once

#include <string>

#include "tactile_net/lab/workload.hpp"

namespace tactile_net::report {

/// What `run --explain --json` writes.
[[nodiscard]] std::string workload_json(const Scene& scene, const lab::Workload& work);
[[nodiscard]] std::string workload_json(const SkinScene& scene, const lab::Workload& work);

}  // namespace tactile_net::report
