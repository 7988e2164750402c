/// @file
/// A circuit's results as a part of a document, the key "network" of docs/results.md. Private.
#pragma once

#include "report/json/described.hpp"
#include "tactile_net/lab/relaxation.hpp"

namespace tactile_net::report {

[[nodiscard]] Json network_json(const lab::Relaxation& relaxation);
[[nodiscard]] Json network_schema();

template <>
struct JsonForm<lab::Relaxation> {
  static Json json(const lab::Relaxation& relaxation) { return network_json(relaxation); }
  static Json schema() { return network_schema(); }
};

}  // namespace tactile_net::report
