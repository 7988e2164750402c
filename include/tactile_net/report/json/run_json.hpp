/// @file
/// Results as JSON; the format is docs/results.md.
#pragma once

#include <string>

#include "tactile_net/lab/deck_file.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/report/pages/certificate_page.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string experiment_json(const lab::Experiment& experiment);

/// The same document with the network alone.
[[nodiscard]] std::string relaxation_json(const Scene& scene, const lab::Relaxation& relaxation);

[[nodiscard]] std::string certificate_json(const lab::Certification& certification);

[[nodiscard]] std::string deck_answer_json(const std::string& file, const lab::DeckAnswer& answer);

}  // namespace tactile_net::report
