/// @file
/// A skin, and what was found on it, as text for people.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/lab/skin_recording.hpp"
#include "tactile_net/lab/skin_run.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/remark_words.hpp"

namespace tactile_net::report {

/// "8 x 8 taxels, pitch 2 mm, reading stress_x, shear_xy at depth 2 mm"
[[nodiscard]] std::string sensor_in_words(const SkinScene& scene);
/// "half space, E = 250 kPa, nu = 0.48"
[[nodiscard]] std::string material_in_words(const SkinScene& scene);
/// One sentence per contact.
[[nodiscard]] std::vector<std::string> contacts_in_words(const SkinScene& scene);
/// "tractions of 12 x 12 cells of 1 mm x 1 mm, normal and tangential"
[[nodiscard]] std::string grid_in_words(const SkinScene& scene, const SurfaceGrid& grid);

/// What is to be said of the readings and their answer.
[[nodiscard]] Sentences remarks_in_words(const lab::SkinExperiment& experiment);

/// How hard, how it is dragged, where, how near to slipping, and how far from the truth.
[[nodiscard]] std::vector<Answer> answers(const lab::SkinExperiment& experiment);

/// The same of a recording: of the frame that presses hardest, and how many can be trusted.
[[nodiscard]] std::vector<Answer> answers(const lab::SkinRecordingAnswer& recording);

/// What was found beside what is true, as cells of a table: force, drag, centre, torsion.
[[nodiscard]] std::vector<std::vector<std::string>> found_cells(
    const lab::SkinExperiment& experiment);

/// How far a circuit's tractions are off the truth; nothing without an answer.
[[nodiscard]] std::string network_errors_in_words(const lab::SkinCircuitResult& network);

/// The answer first, as `answers`; then how it was found, and how far it is to be trusted.
void print_experiment(std::ostream& out, const lab::SkinExperiment& experiment);

}  // namespace tactile_net::report
