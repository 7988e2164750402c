/// @file
/// A circuit's results as a part of a document. Private.
#pragma once

#include "report/json/values.hpp"
#include "tactile_net/lab/relaxation.hpp"

namespace tactile_net::report {

/// The key "network" of docs/results.md.
[[nodiscard]] Json network_json(const lab::Relaxation& relaxation);

}  // namespace tactile_net::report
