/// @file
/// Results as JSON; the format is docs/results.md.
#pragma once

#include <string>

#include "certificate_report.hpp"
#include "deck_file.hpp"
#include "experiment.hpp"

namespace tactile_net::tool {

[[nodiscard]] std::string experiment_json(const Experiment& experiment);

/// The same document with the network alone.
[[nodiscard]] std::string relaxation_json(const Scene& scene, const Relaxation& relaxation);

[[nodiscard]] std::string certificate_json(const Certification& certification);

[[nodiscard]] std::string deck_answer_json(const std::string& file, const DeckAnswer& answer);

}  // namespace tactile_net::tool
