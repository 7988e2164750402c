/// @file
/// A scene as plain data: what the TOML file says, defaults filled in.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
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
#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/effects.hpp"

namespace tactile_net {

/// `rms` is one number for every quantity, or a table per quantity: then the rows of the problem
/// are divided by it.
struct NoiseModel {
  std::map<Quantity, double> rms;  ///< of every quantity that is read [unit of the reading], >= 0
  bool weights_rows = false;       ///< `rms` was given as a table
  std::uint64_t seed = 1;
};

enum class ForwardModel { sampled, exact };
enum class Method { dft, tikhonov, closed_form, network };

[[nodiscard]] std::string_view name(ForwardModel model) noexcept;
[[nodiscard]] std::string_view name(Method method) noexcept;
[[nodiscard]] std::optional<Method> method_named(std::string_view name) noexcept;

struct ReconstructOptions {
  std::vector<Method> methods{Method::tikhonov};
  std::optional<double> alpha{};             ///< absent: `alpha_rule` chooses it
  AlphaRule alpha_rule = AlphaRule::rgcv;    ///< where `alpha` is absent
  double smoothing_length = 0.0;             ///< l [m]; default: the first depth
  double noise_gain_limit = 1e8;             ///< dft: largest noise gain that is accepted
  bool nonnegative = false;                  ///< tikhonov: f_v >= 0
  std::optional<double> friction_limit{};    ///< tikhonov: |f_t| <= limit f_v; implies f_v >= 0
  std::optional<double> contact_friction{};  ///< dft: known mu, f_t constant over the contact
  std::optional<bool> tangential{};          ///< solve for it too; absent: see `unknowns`
};

struct NetworkOptions {
  Realization realization = Realization::ideal;
  RealizationOptions parts{};                   ///< scale, op-amps, parasitics
  std::optional<ToleranceOptions> tolerance{};  ///< absent: every component has its exact value
  std::optional<double> settling_accuracy{};    ///< absent: only the operating point
};

struct Scene {
  std::string file;   ///< name of the file, without its folder
  std::string title;  ///< optional `title` at the top of the file
  SensorArray sensor;
  Material material;
  std::vector<Contact> contacts;
  std::optional<NoiseModel> noise;
  std::optional<Converter> quantization;
  std::vector<std::size_t> dead_taxels;
  ForwardModel forward = ForwardModel::sampled;
  ReconstructOptions reconstruct;
  NetworkOptions network;
};

/// How many tractions a scene solves for: 2, normal and tangential, if the array reads more than
/// one channel and the scene calls for it: by `tangential`, by a friction limit, by a contact with
/// friction, or by having no contact, as scenes for recorded readings.
[[nodiscard]] std::size_t unknowns(const Scene& scene);

/// The effects a scene may name, in the order of the JSON: layer, friction, noise, quantization,
/// dead_taxels; each with whether this scene calls for it.
[[nodiscard]] std::vector<std::pair<std::string_view, bool>> effects(const Scene& scene);

}  // namespace tactile_net
