/// @file
/// What cannot be told apart, experiment by experiment: exact null directions and no others.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tactile_net/calibration/press_fit.hpp"
#include "tests/calibration/simulated_log.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

struct Experiment {
  const char* what;
  std::vector<Quantity> reads{Quantity::stress_x};
  int pad = 1;  // 0: half plane, 1: bonded, 2: frictionless
  bool forces = true, centres = true, widths = true, rods = false;
  bool shift = false, pitch = false;
  bool one_place = false;
  std::size_t presses = 20;
  GainSharing gains = GainSharing::reading;
  std::size_t dimension = 0;
  std::vector<PadParameter> hidden{};
  bool common_gain_hidden = false;
};

using enum Quantity;
using enum PadParameter;

const std::vector<Experiment> experiments{
    {.what = "stresses, half plane",
     .pad = 0,
     .dimension = 2,
     .hidden = {poisson_ratio, youngs_modulus}},
    {.what = "stresses, frictionless base",
     .pad = 2,
     .dimension = 2,
     .hidden = {poisson_ratio, youngs_modulus}},
    {.what = "stresses, bonded layer", .dimension = 1, .hidden = {youngs_modulus}},
    {.what = "two stresses, bonded layer",
     .reads = {stress_x, shear_xy},
     .dimension = 1,
     .hidden = {youngs_modulus}},
    {.what = "strain, half plane",
     .reads = {strain_x},
     .pad = 0,
     .dimension = 1,
     .hidden = {youngs_modulus},
     .common_gain_hidden = true},
    {.what = "two strains, bonded layer",
     .reads = {strain_x, strain_y},
     .dimension = 1,
     .hidden = {youngs_modulus},
     .common_gain_hidden = true},
    {.what = "strain and stress, own gains",
     .reads = {strain_x, stress_x},
     .dimension = 1,
     .hidden = {youngs_modulus},
     .common_gain_hidden = true},
    {.what = "strain and stress, common gains",
     .reads = {strain_x, stress_x},
     .gains = GainSharing::taxel,
     .dimension = 0},
    {.what = "forces unknown",
     .forces = false,
     .dimension = 2,
     .hidden = {youngs_modulus},
     .common_gain_hidden = true},
    {.what = "centres unknown",
     .centres = false,
     .shift = true,
     .dimension = 2,
     .hidden = {youngs_modulus, shift}},
    {.what = "centres known", .shift = true, .dimension = 1, .hidden = {youngs_modulus}},
    {.what = "pitch, centres and widths unknown",
     .centres = false,
     .widths = false,
     .pitch = true,
     .dimension = 2,
     .hidden = {youngs_modulus, depth, thickness, pitch},
     .common_gain_hidden = true},
    {.what = "pitch unknown, centres known",
     .widths = false,
     .pitch = true,
     .dimension = 1,
     .hidden = {youngs_modulus}},
    {.what = "one press",
     .presses = 1,
     .dimension = 4,
     .hidden = {youngs_modulus, depth, thickness, poisson_ratio},
     .common_gain_hidden = true},
    {.what = "one press, one gain",
     .presses = 1,
     .gains = GainSharing::channel,
     .dimension = 1,
     .hidden = {youngs_modulus}},
    {.what = "many at one place, different widths",
     .one_place = true,
     .dimension = 1,
     .hidden = {youngs_modulus}},
    {.what = "rods of known radius, stress, half plane",
     .pad = 0,
     .widths = false,
     .rods = true,
     .dimension = 1,
     .hidden = {youngs_modulus, poisson_ratio}},
    {.what = "rods of known radius, strain, half plane",
     .reads = {strain_x},
     .pad = 0,
     .widths = false,
     .rods = true,
     .dimension = 0},
    {.what = "the same, centres unknown",
     .reads = {strain_x},
     .pad = 0,
     .centres = false,
     .widths = false,
     .rods = true,
     .dimension = 0},
};

}  // namespace

TEST_CASE("null directions are those of theory, no more and no less") {
  for (const Experiment& e : experiments) {
    SimulatedLog made = simulated_log(31, {.presses = e.presses,
                                           .knows_width = e.widths,
                                           .knows_centre = e.centres,
                                           .knows_force = e.forces,
                                           .reads = e.reads,
                                           .layer = e.pad > 0});
    if (e.pad == 2) made.nominal.layer->base = Base::frictionless;
    for (Press& press : made.log.presses) {
      if (e.rods) press.radius = 2e-3 + 1e-3 * static_cast<double>(press.number % 5);
      if (e.one_place) press.position.value = 1e-3;
    }
    CalibrationOptions options;
    options.gains = e.gains;
    if (e.shift) options.shift_sd = 1e-3;
    if (e.pitch) options.pitch_sd = 0.1;
    options.most_iterations = 2;  // a null space is one everywhere
    options.starts = {1.0};
    const PressFit fit = fit_presses(made.model(), made.log, options);
    CAPTURE(e.what);
    CHECK(fit.null_directions.size() == e.dimension);
    for (const NullDirection& direction : fit.null_directions) {
      double largest = 0.0;
      for (const double value : direction.pad) largest = std::max(largest, std::abs(value));
      CHECK(*std::find_if(direction.pad.begin(), direction.pad.end(),
                          [&](double value) { return std::abs(value) >= 0.5 * largest; }) >= 0.0);
      for (const double gain : direction.gains) CHECK((gain == 0.0 || std::abs(gain) > 1e-12));
    }
    for (std::size_t i = 0; i < pad_parameter_count; ++i) {
      double part = 0.0;
      for (const NullDirection& direction : fit.null_directions)
        part = std::hypot(part, direction.pad[i]);
      const bool hidden =
          std::count(e.hidden.begin(), e.hidden.end(), static_cast<PadParameter>(i)) > 0;
      CAPTURE(name(static_cast<PadParameter>(i)), part);
      CHECK((part > 1e-3) == hidden);
    }
    CHECK((fit.mean_gain.front().verdict == ValueVerdict::not_identifiable) ==
          e.common_gain_hidden);
  }
}

TEST_CASE("a strain that the base holds at zero tells nothing of its gains") {
  SimulatedLog made =
      simulated_log(32, {.reads = {Quantity::stress_x, Quantity::strain_y}, .depth = 3e-3});
  made.nominal_depth = 3e-3;
  made.nominal.layer->thickness = 3e-3;
  made.log.unloaded.rms[1] = 1e-3;
  CalibrationOptions options;
  options.at_base = true;
  options.starts = {1.0};
  const PressFit fit = fit_presses(made.model(), made.log, options);
  std::size_t known = 0;
  for (std::size_t j = 41; j < 82; ++j) {
    CHECK(fit.gain[j].verdict != ValueVerdict::identified);
    known += fit.gain[j - 41].verdict == ValueVerdict::identified ? 1U : 0U;
  }
  CHECK(known > 30);
}

}  // namespace tactile_net
