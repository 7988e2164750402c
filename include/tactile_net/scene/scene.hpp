/// @file
/// A scene as plain data: what the TOML file says, defaults filled in.
#pragma once

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/network/allocation.hpp"
#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/network/refinement_options.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/scene/macromodel.hpp"
#include "tactile_net/scene/sensor_effects.hpp"
#include "tactile_net/scene/timing.hpp"
#include "tactile_net/scene/units.hpp"
#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/calibration.hpp"
#include "tactile_net/sensing/moving_contact.hpp"
#include "tactile_net/sensing/signal_path.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {

enum class ForwardModel { sampled, exact };
enum class Method { dft, tikhonov, closed_form, network };

template <>
struct Enumerators<Method> {
  static constexpr Enumerator<Method> all[] = {
      {Method::dft, "dft", "Division by the kernel's discrete Fourier transform."},
      {Method::tikhonov, "tikhonov", "Regularised least squares, by an orthogonal decomposition."},
      {Method::closed_form, "closed_form", "The same by an explicit inverse."},
      {Method::network, "network", "The same by an analog circuit, in the simulator."}};
};

/// What the tractions are.
enum class AnswerKind { mixture, alpha };

template <>
struct Enumerators<AnswerKind> {
  static constexpr Enumerator<AnswerKind> all[] = {
      {AnswerKind::mixture, "mixture",
       "The mean of all that the readings leave possible, with its quantiles as bands."},
      {AnswerKind::alpha, "alpha", "The minimiser of the functional of one alpha."}};
};

[[nodiscard]] std::string_view name(ForwardModel model) noexcept;
[[nodiscard]] std::string_view name(Method method) noexcept;
[[nodiscard]] std::string_view name(AnswerKind kind) noexcept;
[[nodiscard]] std::optional<Method> method_named(std::string_view name) noexcept;

/// What the reconstructions of lines and of skins have in common.
struct SharedReconstructOptions {
  std::optional<double> alpha{};          ///< absent: a rule chooses it
  std::optional<AlphaRule> alpha_rule{};  ///< absent: by readings and noise, `default_rule`
  /// How much heavier the tangential traction's stabiliser is, > 0; absent: as each frame's
  /// readings have it, by `tangential_weights` (inverse/tangential_weight.hpp).
  std::optional<double> tangential_weight = 1.0;
  std::optional<bool> tangential{};  ///< solve for it too; absent: see `unknowns`, `components`
  bool nonnegative = false;          ///< f_v >= 0
  std::optional<double> friction_limit{};  ///< |f_t| <= limit f_v; implies f_v >= 0
  bool offset = false;  ///< each channel's readings have a constant that is not known
  /// Absent: the mixture where no alpha and no rule for it is stated and, of skins, its windows do
  /// not take long; else one alpha's.
  std::optional<AnswerKind> answer{};
};

/// Constraints and offsets are for tikhonov, closed_form and network: dft knows neither.
struct ReconstructOptions : SharedReconstructOptions {
  std::vector<Method> methods{Method::tikhonov};
  SurfaceOptions surface{};          ///< where the tractions lie; the reader's: see is_dense
  double smoothing_length = 0.0;     ///< l [m]; default: the first depth
  double noise_gain_limit = 1e8;     ///< dft: largest noise gain that is accepted
  bool alpha_on_active_set = false;  ///< a rule chooses alpha for what constraints leave free
  std::optional<double> contact_friction{};  ///< dft: known mu, f_t constant over the contact
};

struct OpAmpPart;

/// What 95 of 100 builds of a circuit are to stay within; absent: no matter.
struct DatasheetLimits {
  std::optional<double> error{};           ///< of the answer at rest, relative, > 0
  std::optional<double> offset{};          ///< without readings, over the answer, > 0
  std::optional<double> settling{};        ///< [s], > 0
  std::optional<double> noise{};           ///< over the answer, > 0
  std::optional<double> supply_current{};  ///< [A], > 0
};

struct NetworkOptions {
  Realization realization = Realization::ideal;
  /// Of the tractions that the nodes stand for [m], at least the surface's; absent: as that.
  std::optional<double> spacing{};
  RealizationOptions parts{};  ///< scale, op-amps, parasitics
  /// Of `parts.opamp.input_capacitance` what is the op-amp's own [F]; the rest is a board's.
  std::optional<double> own_input_capacitance{};
  /// That the scene names, whose figures `parts.opamp` begins with; null: none. One of
  /// `opamp_parts`.
  const OpAmpPart* opamp_part = nullptr;
  std::optional<double> supply{};  ///< of the op-amps, between their pins [V]; absent: not stated
  MacromodelOptions macromodel{};
  /// What is paid for resistors and op-amps; absent: typical prices.
  std::optional<std::vector<PartClass>> resistor_classes{};
  std::optional<double> opamp_price{};
  bool one_volt =
      false;  ///< the scale's volts follow from the answer, whose largest voltage is 1 V
  std::optional<ToleranceOptions> tolerance{};  ///< absent: every component has its exact value
  std::optional<double> settling_accuracy{};    ///< absent: only the operating point
  DatasheetLimits limits{};                     ///< that a datasheet is judged by
  std::optional<RefinementOptions> refine{};    ///< absent: the answer is not refined
};

/// What scenes of lines and of skins have in common. `SensorEffects` lie between the pad and the
/// file.
struct SharedScene : SensorEffects {
  std::string file{};   ///< name of the file, without its folder
  std::string title{};  ///< optional `title` at the top of the file
  /// Present: every number below is in SI, whatever the file has. Absent: any consistent set, as
  /// the file has it.
  std::optional<Units> units{};
  /// What the numbers in a file of readings mean: [calibration] and [units] in one. Absent: they
  /// are the readings.
  std::optional<Calibration> calibration{};
  Material material{};
  std::optional<Timing> time{};  ///< absent: one frame, of loads that have always been there
  std::size_t frame = 0;  ///< that `run` reconstructs: the reader sets the last, `at_frame` another
  ForwardModel forward = ForwardModel::exact;
  NetworkOptions network{};
  double interval_level = 0.95;  ///< the probability inside intervals, between 0 and 1
};

struct Scene : SharedScene {
  SensorArray sensor{};
  std::vector<Contact> contacts{};                ///< as they are at that frame
  std::vector<ContactTrajectory> trajectories{};  ///< one per contact, empty where it stands still
  ReconstructOptions reconstruct{};
};

/// A scene of a line or of a skin.
template <typename Kind>
concept SceneKind = std::derived_from<Kind, SharedScene>;

/// How many tractions a scene solves for: 2, normal and tangential, if the array reads more than
/// one channel and the scene calls for it: by `tangential`, by a friction limit, by a contact with
/// friction at any time, or by having no contact, as scenes for recorded readings.
[[nodiscard]] std::size_t unknowns(const Scene& scene);

/// Where those tractions lie. @throw std::invalid_argument  as `surface_of`
[[nodiscard]] Surface surface(const Scene& scene);

/// The same scene, its surface as coarse as the circuit's nodes.
///
/// @throw std::invalid_argument  the nodes are to have a spacing, and the tractions lie at the
///                               taxels
[[nodiscard]] Scene of_circuit(Scene scene);

/// Of a circuit with a spacing of its own: resistors grow with their square.
inline constexpr std::size_t most_circuit_nodes = 1024;

/// Readings as a file of this scene has them: in its units, before its calibration. What
/// `frames::ReadingsFile` makes of them is the readings again.
[[nodiscard]] std::vector<double> raw_numbers(const SharedScene& scene,
                                              std::span<const double> readings);

/// Every contact at time t [s], those that stand still as they are.
[[nodiscard]] auto contacts_at(const SceneKind auto& scene, double t) {
  auto contacts = scene.contacts;
  for (std::size_t i = 0; i < scene.trajectories.size(); ++i)
    if (!scene.trajectories[i].empty()) contacts[i] = contact_at(scene.trajectories[i], t);
  return contacts;
}

/// The same scene with another frame to be reconstructed: its contacts are those of that moment.
///
/// @throw std::invalid_argument  there is no such frame
template <SceneKind Kind>
[[nodiscard]] Kind at_frame(Kind scene, std::size_t frame) {
  check_frame(scene.time, frame);
  scene.frame = frame;
  if (scene.time) scene.contacts = contacts_at(scene, scene.time->time(frame));
  return scene;
}

/// The effects a scene may name, in the order of the signal path, which is that of the JSON:
/// friction, layer, viscoelasticity, hysteresis, crosstalk, gain_error, offset_error, temperature,
/// low_pass, sampling, noise, taxel_noise, saturation, quantization, stuck_taxels, dead_taxels;
/// each with whether this scene calls for it.
[[nodiscard]] std::vector<std::pair<std::string_view, bool>> effects(const Scene& scene);

/// The stages that the scene's effects put between the pad and the file, at rest.
[[nodiscard]] SignalPath signal_path(const Scene& scene);

/// The moments at which the sensor is gone through up to the scene's frame: its frames; and where
/// an effect remembers, the knots of trajectories and the begins of sampling windows between them.
[[nodiscard]] std::vector<Instant> instants(const SceneKind auto& scene) {
  std::vector<double> knots;
  for (const auto& trajectory : scene.trajectories)
    for (const auto& knot : trajectory) knots.push_back(knot.time);
  return instants(scene, signal_path(scene), scene.time, scene.frame, knots);
}

}  // namespace tactile_net
