/// @file
/// A skin, and what was found on it, as text for people.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/remark_words.hpp"

namespace tactile_net::report {

/// "8 x 8 taxels, pitch 2 mm, reading stress_x, shear_xy at depth 2 mm"; of a curved skin also
/// "below a ball of radius 30 mm", "in a hole of ...", "below a curved surface, radii of ..."
[[nodiscard]] std::string sensor_in_words(const SkinScene& scene);
/// "half space, E = 250 kPa, nu = 0.48"; a layer that is taken for flat, though it is curved, says
/// so
[[nodiscard]] std::string material_in_words(const SkinScene& scene);
/// One sentence per contact.
[[nodiscard]] std::vector<std::string> contacts_in_words(const SkinScene& scene);
/// "tractions of 12 x 12 cells of 1 mm x 1 mm, normal and tangential"
[[nodiscard]] std::string grid_in_words(const SkinScene& scene, const SurfaceGrid& grid);

/// "force (0.05 ± 0.01, 0.05 ± 0.01, -0.45 ± 0.02) N in the sensor's axes", of a curved skin.
[[nodiscard]] std::string space_force_in_words(const SpaceWrench& space, const SkinScene& scene);
/// The same with "; moment about (0, 0, 0) ...; centre (...) mm below the surface's (...) mm".
[[nodiscard]] std::string space_wrench_in_words(const SpaceWrench& space, const SkinScene& scene);

/// What a skin's recording answers: of the frame that presses hardest, and how many can be trusted.
/// @pre  a frame has an answer
[[nodiscard]] std::vector<Answer> skin_answers(const lab::RecordingOverview& recording);

/// What was found beside what is true, as cells of a table: force, drag, centre, torsion.
/// @pre  the first result has an answer
[[nodiscard]] std::vector<std::vector<std::string>> found_cells(const lab::Experiment& experiment);

/// "p 5 %, q_y 7 %, q_z 8 % of it": how far tractions are off the truth, over the true pressure.
[[nodiscard]] std::string errors_in_words(const lab::MethodResult& result);

}  // namespace tactile_net::report
