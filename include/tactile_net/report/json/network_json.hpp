/// @file
/// A circuit's results as JSON; the format is docs/results.md.
#pragma once

#include <string>

#include "tactile_net/decks/deck_file.hpp"
#include "tactile_net/lab/certification.hpp"
#include "tactile_net/lab/macromodel_comparison.hpp"
#include "tactile_net/lab/relaxation.hpp"
#include "tactile_net/lab/simulated_refinement.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::report {

/// The document of `experiment_json` with the network alone.
[[nodiscard]] std::string relaxation_json(const AnyScene& scene, const lab::Relaxation& relaxation);

[[nodiscard]] std::string macromodel_json(const AnyScene& scene,
                                          const lab::MacromodelComparison& comparison);

[[nodiscard]] std::string refinement_json(const AnyScene& scene,
                                          const lab::SimulatedRefinement& refinement);

[[nodiscard]] std::string certificate_json(const lab::Certification& certification);

[[nodiscard]] std::string datasheet_json(const AnyScene& scene, const lab::Datasheet& sheet);

[[nodiscard]] std::string deck_answer_json(const std::string& file,
                                           const decks::DeckAnswer& answer);

}  // namespace tactile_net::report
