/// @file
/// A scene as plain data: what the TOML file says, defaults filled in.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/network/tolerance.hpp"
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

[[nodiscard]] std::string_view name(ForwardModel model) noexcept;
[[nodiscard]] std::string_view name(Method method) noexcept;
[[nodiscard]] std::optional<Method> method_named(std::string_view name) noexcept;

struct ReconstructOptions {
  std::vector<Method> methods{Method::tikhonov};
  std::optional<double> alpha{};          ///< absent: a rule chooses it
  std::optional<AlphaRule> alpha_rule{};  ///< absent: by taxels and noise, lab/scene_problem.hpp
  SurfaceOptions surface{};               ///< where the tractions lie; the reader's: see is_dense
  double smoothing_length = 0.0;          ///< l [m]; default: the first depth
  /// How much heavier the tangential traction's stabiliser is, > 0; absent: as each frame's
  /// readings have it, by `tangential_weights` (inverse/tangential_weight.hpp).
  std::optional<double> tangential_weight = 1.0;
  double noise_gain_limit = 1e8;           ///< dft: largest noise gain that is accepted
  bool nonnegative = false;                ///< tikhonov: f_v >= 0
  std::optional<double> friction_limit{};  ///< tikhonov: |f_t| <= limit f_v; implies f_v >= 0
  /// Under constraints a rule chooses alpha for the tractions that they leave free.
  bool alpha_on_active_set = false;
  /// tikhonov, closed_form and network: each channel's readings have a constant that is not known.
  bool offset = false;
  std::optional<double> contact_friction{};  ///< dft: known mu, f_t constant over the contact
  std::optional<bool> tangential{};          ///< solve for it too; absent: see `unknowns`
};

struct NetworkOptions {
  Realization realization = Realization::ideal;
  /// Of the tractions that the nodes stand for [m], at least the surface's; absent: as that.
  std::optional<double> spacing{};
  RealizationOptions parts{};  ///< scale, op-amps, parasitics
  bool one_volt =
      false;  ///< the scale's volts follow from the answer, whose largest voltage is 1 V
  std::optional<ToleranceOptions> tolerance{};  ///< absent: every component has its exact value
  std::optional<double> settling_accuracy{};    ///< absent: only the operating point
};

/// `SensorEffects` lie between the pad and the file.
struct Scene : SensorEffects {
  std::string file;   ///< name of the file, without its folder
  std::string title;  ///< optional `title` at the top of the file
  /// Present: every number below is in SI, whatever the file has. Absent: any consistent set, as
  /// the file has it.
  std::optional<Units> units;
  SensorArray sensor;
  /// What the numbers in a file of readings mean: [calibration] and [units] in one. Absent: they
  /// are the readings.
  std::optional<Calibration> calibration;
  Material material;
  std::optional<Timing> time;  ///< absent: one frame, of loads that have always been there
  std::size_t frame = 0;  ///< that `run` reconstructs: the reader sets the last, `at_frame` another
  std::vector<Contact> contacts;                ///< as they are at that frame
  std::vector<ContactTrajectory> trajectories;  ///< one per contact, empty where it stands still
  ForwardModel forward = ForwardModel::exact;
  ReconstructOptions reconstruct;
  NetworkOptions network;
};

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
[[nodiscard]] std::vector<double> raw_numbers(const Scene& scene, std::span<const double> readings);

/// Every contact at time t [s], those that stand still as they are.
[[nodiscard]] std::vector<Contact> contacts_at(const Scene& scene, double t);

/// The same scene with another frame to be reconstructed: its contacts are those of that moment.
///
/// @throw std::invalid_argument  there is no such frame
[[nodiscard]] Scene at_frame(Scene scene, std::size_t frame);

/// The effects a scene may name, in the order of the signal path, which is that of the JSON:
/// friction, layer, viscoelasticity, hysteresis, crosstalk, gain_error, offset_error, temperature,
/// low_pass, sampling, noise, taxel_noise, saturation, quantization, stuck_taxels, dead_taxels;
/// each with whether this scene calls for it.
[[nodiscard]] std::vector<std::pair<std::string_view, bool>> effects(const Scene& scene);

/// The stages that the scene's effects put between the pad and the file, at rest.
[[nodiscard]] SignalPath signal_path(const Scene& scene);

/// The moments at which the sensor is gone through up to the scene's frame: its frames; and where
/// an effect remembers, the knots of trajectories and the begins of sampling windows between them.
[[nodiscard]] std::vector<Instant> instants(const Scene& scene);

}  // namespace tactile_net
