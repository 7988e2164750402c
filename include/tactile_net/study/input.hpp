/// @file
/// What every method of a study starts from: one frame, its exact solution, and what noise does.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::study {

struct StudyInput {
  /// Of a skin with the frame's own tangential weight, where the scene has it estimated.
  std::variant<lab::SceneProblem, lab::SkinSceneProblem> problem{lab::SceneProblem(Scene{})};
  double alpha = 0.0;  ///< the scene's or its rule's: all methods share it
  /// What presses [Pa]: the normal traction of every place, then each tangential one, as far as
  /// there are; none: nothing is known of it.
  std::vector<std::vector<double>> truth{};
  std::vector<double> readings{};
  /// f*, of a QR, without the scene's constraints; `agreement` from the one by singular values.
  std::vector<double> solution{};
  double agreement = 0.0;
  double solution_error = 0.0;  ///< |f* - truth| / |truth|; NaN without a contact
  double noise_rms = 0.0;       ///< of a reading, as for `noise_floor`
  bool noise_stated = false;    ///< by the scene; else one hundredth of the largest reading
  double noise_floor = 0.0;     ///< what that noise does to f*: root mean square, over |f*|

  [[nodiscard]] bool is_skin() const noexcept {
    return std::holds_alternative<lab::SkinSceneProblem>(problem);
  }
  /// @pre  it is of a line
  [[nodiscard]] const lab::SceneProblem& line() const { return std::get<0>(problem); }
  /// @pre  it is of a skin
  [[nodiscard]] const lab::SkinSceneProblem& skin() const { return std::get<1>(problem); }

  /// `use` of the scene, a line's or a skin's.
  [[nodiscard]] decltype(auto) with_scene(const auto& use) const {
    return std::visit([&](const auto& one) -> decltype(auto) { return use(one.scene()); }, problem);
  }
  [[nodiscard]] const std::string& file() const {
    return with_scene([](const auto& scene) -> const std::string& { return scene.file; });
  }
  [[nodiscard]] const std::optional<Units>& units() const {
    return with_scene([](const auto& scene) -> const std::optional<Units>& { return scene.units; });
  }
  [[nodiscard]] const std::optional<Constraints>& constraints() const {
    return std::visit(
        [](const auto& one) -> const std::optional<Constraints>& { return one.constraints(); },
        problem);
  }

  /// The smallest error that can be told: both references may err by more than they differ.
  [[nodiscard]] double resolution() const noexcept { return 10.0 * agreement; }
};

/// @throw std::invalid_argument  the scene cannot be studied: every reading is zero, ...
[[nodiscard]] StudyInput study_input(const AnyScene& scene);

}  // namespace tactile_net::study
