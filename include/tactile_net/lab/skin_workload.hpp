/// @file
/// What `run` does of a skin's scene, and why: what workload.hpp is for lines.
///
///     for (const lab::SkinWorkload::Task& task : lab::workload(scene).tasks) use(task.what);
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/scene/scene_effects.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::lab {

struct SkinWorkload {
  enum class Computation {
    readings,    ///< from contacts, through the forward model
    history,     ///< frames before the one that is reconstructed
    tangential,  ///< two more unknowns in every cell
    weights,     ///< of the drags against the pressure, by the readings
    tikhonov,
    alpha_rule,
    constraints,   ///< friction's cones, or p >= 0
    bands,         ///< how far tractions and forces may be off
    data_verdict,  ///< whether any contact explains the readings
    report,
  };
  /// Why a computation is needed, or why it is left out.
  enum class Reason {
    exact_model,
    sampled_model,
    no_time,
    first_frame,
    frames_before,
    three_tractions,
    one_channel,
    tangential_excluded,
    no_drag,
    weight_unknown,  ///< tangential_weight = "evidence"
    weight_given,
    one_traction,
    matrix_held,
    matrix_too_large,
    rule_chooses,   ///< alpha, by `Task::rule`
    prior_by_rule,  ///< alpha is given; what sizes the bands is not
    limits_stated,
    no_limits,
    forces_have_deviations,
    noise_stated,
    no_noise,
    report_requested,
    no_report,
  };
  /// What it takes.
  enum class Cost {
    kernel_values,        ///< some hundred for each of `count` readings and each contact
    sum,                  ///< of `count` tractions for each reading, by FFT where they are many
    moments,              ///< `count` of them
    unknowns,             ///< `count` of them
    families,             ///< a decomposition for each weight tried
    classes,              ///< of a matrix of `rows` x `count`
    tiles,                ///< conjugate gradients for `count` tractions
    one_rule,             ///< over the singular values
    probes,               ///< and a run a frame
    multipliers,          ///< ADMM with one decomposition
    projected_gradients,  ///< by FFT
    class_sums,           ///< over the decomposition
    solves,               ///< a force or moment each, and some cells
    contact_search,       ///< where tractions that only press leave too much
    drawing,
  };
  struct Task {
    Computation what = Computation::readings;
    bool done = false;
    Reason why = Reason::exact_model;
    std::optional<AlphaRule> rule{};
    std::optional<Cost> cost{};  ///< absent where it is left out
    std::size_t count = 0;
    std::size_t rows = 0;
  };

  std::vector<const SceneEffect*> effects{};  ///< simulated, in the order of the signal path
  std::vector<Task> tasks{};                  ///< every computation once, in their order

  [[nodiscard]] const Task& task(Computation what) const {
    return tasks[static_cast<std::size_t>(what)];
  }
};

/// The name as tables and JSON spell it: "data_verdict".
[[nodiscard]] std::string_view name(SkinWorkload::Computation computation) noexcept;

/// Computes nothing but counts.
///
/// @param report  files are written
/// @throw std::invalid_argument  as `grid`
[[nodiscard]] SkinWorkload workload(const SkinScene& scene, bool report = false);

}  // namespace tactile_net::lab
