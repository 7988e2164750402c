#include "tests/hard/cases.hpp"

#include <limits>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::hard {
namespace {

using enum Quantity;

const std::vector<Quantity> strain = {strain_x};
const std::vector<Quantity> stress = {stress_x};
const std::vector<Quantity> stress_and_shear = {stress_x, shear_xy};

/// The case that the others change one thing of: a dragged cylinder over 31 taxels.
struct Start {
  std::size_t count = 31;
  double pitch = 0.5;
  std::vector<double> depths{1.5};
  std::vector<Quantity> reads = strain;
  Material material{1.0, 0.45};
  double alpha = 1e-4;
  double smoothing_length = 1.0;
  std::vector<Contact> contacts{RigidContact{.half_width = 2.0, .friction = 0.3}};
  double noise = 1e-3;  // over the peak
  double scale = 1.0;   // of the readings
  std::vector<double> channel_rms{};
  std::vector<std::size_t> dead{};
};

Case make(std::string name, const Start& start) {
  Case result{.name = std::move(name),
              .array = {start.count, start.pitch, start.depths, start.reads},
              .material = start.material,
              .options = {},
              .alpha = start.alpha,
              .readings = {}};
  const std::size_t channels = start.reads.size() * start.depths.size();
  result.options = {.unknowns = channels > 1 ? std::size_t{2} : std::size_t{1},
                    .smoothing_length = start.smoothing_length,
                    .channel_rms = start.channel_rms,
                    .dead_taxels = start.dead};
  result.readings =
      sampled_readings(result.array, start.material, sample(start.contacts, result.array));
  double peak = 0.0;
  for (const double reading : result.readings) peak = std::max(peak, std::abs(reading));
  for (std::size_t c = 0; c < channels; ++c)
    add_noise(std::span(result.readings).subspan(c * start.count, start.count), start.noise * peak,
              17, c);
  for (double& reading : result.readings) reading *= start.scale;
  return result;
}

std::vector<double> zeros_but(std::size_t count, std::size_t where) {
  std::vector<double> values(count);
  values[where] = 1.0;
  return values;
}

}  // namespace

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&](const std::string& name, const Start& start) {
    all.push_back(make(name, start));
  };
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return std::string(text);
  };

  for (const double alpha : {1.0, 1e-4, 1e-8, 1e-12, 1e-16}) {
    add("alpha " + number(alpha), {.pitch = 0.125, .alpha = alpha});
    add("alpha " + number(alpha) + ", two unknowns",
        {.count = 21, .pitch = 0.125, .reads = stress_and_shear, .alpha = alpha});
  }
  add("depth / pitch 40, alpha 1e-32", {.pitch = 1.5 / 40.0, .alpha = 1e-32});
  for (const double ratio : {1.0, 4.0, 12.0, 40.0})
    add("depth / pitch " + number(ratio), {.pitch = 1.5 / ratio, .alpha = 1e-8});
  for (const std::size_t count : {2U, 3U, 4U, 30U, 41U})
    add("N = " + std::to_string(count), {.count = count});
  add("N = 2, two unknowns", {.count = 2, .reads = stress_and_shear});
  for (const double nu : {0.0, 0.4999, 0.499999, 0.5}) {
    add("nu = " + number(nu), {.material = {1.0, nu}});
    add("nu = " + number(nu) + ", two strains",
        {.count = 21, .reads = {strain_x, strain_y}, .material = {1.0, nu}, .alpha = 1e-10});
  }
  add("two stresses, whose mean shear is invisible",
      {.count = 21, .reads = {stress_x, stress_y}, .alpha = 1e-10});
  add("one strain at two depths, nu = 0.5",
      {.count = 21, .depths = {1.0, 1.5}, .material = {1.0, 0.5}, .alpha = 1e-8});
  add("two nearly equal depths",
      {.count = 21, .depths = {1.5, 1.5 + 1e-9}, .reads = stress, .alpha = 1e-8});
  for (const Base base : {Base::bonded, Base::frictionless}) {
    const std::string on = " on a " + std::string(tactile_net::name(base)) + " base";
    add("sensors at the base, layer h / pitch 6" + on, {.count = 21,
                                                        .depths = {3.0},
                                                        .reads = stress_and_shear,
                                                        .material = {1.0, 0.5, Layer{3.0, base}},
                                                        .alpha = 1e-8});
    add("thin layer, h / pitch 0.5" + on, {.count = 21,
                                           .depths = {0.25},
                                           .reads = stress_and_shear,
                                           .material = {1.0, 0.45, Layer{0.25, base}}});
    add("layer, k h up to 1000" + on, {.count = 21,
                                       .pitch = 0.05,
                                       .depths = {0.1},
                                       .reads = stress,
                                       .material = {1.0, 0.45, Layer{2.4, base}},
                                       .alpha = 1e-6,
                                       .contacts = {RigidContact{.half_width = 0.2}}});
  }
  add("just under the surface, depth 0.01 pitch", {.depths = {0.005}, .reads = stress});
  add("just under the surface, two unknowns",
      {.count = 21, .depths = {0.005}, .reads = stress_and_shear});
  add("load at one taxel", {.contacts = {SampledTractions{-7.5, 0.5, zeros_but(31, 15), {}}}});
  add("load at the last taxel", {.contacts = {SampledTractions{-7.5, 0.5, zeros_but(31, 30), {}}}});
  add("load at the edge", {.contacts = {RigidContact{.center = 7.5, .half_width = 2.0}}});
  add("load wider than the array", {.contacts = {RigidContact{.half_width = 30.0}}});
  add("no load", {.contacts = {}, .noise = 0.0});
  add("contacts that overlap", {.contacts = {RigidContact{.center = -0.5, .half_width = 2.0},
                                             RigidContact{.center = 0.5, .half_width = 1.5}}});
  add("readings times 1e-150", {.scale = 1e-150});
  add("readings times 1e150", {.scale = 1e150});
  add("readings times 1e-150, two unknowns",
      {.count = 21, .reads = stress_and_shear, .scale = 1e-150});
  for (const double scale : {1e-310, 1e-318})
    add("denormal readings, times " + number(scale), {.scale = scale});
  for (const double e : {1e-12, 1e12}) {
    add("E = " + number(e) + ", alpha in its unit",
        {.material = {e, 0.45}, .alpha = 1e-4 / (e * e)});
    add("E = " + number(e) + ", alpha 1e-4 all the same", {.material = {e, 0.45}});
  }
  add("a dead taxel", {.dead = {15}});
  add("a dead taxel, two unknowns", {.count = 21, .reads = stress_and_shear, .dead = {10}});
  add("no noise, alpha 1e-16", {.alpha = 1e-16, .noise = 0.0});
  add("noise 100 %", {.noise = 1.0});
  add("weights 1e8 apart",
      {.count = 21, .reads = {stress_x, strain_x}, .channel_rms = {1e4, 1e-4}});
  add("smoothing length 0", {.alpha = 1e-8, .smoothing_length = 0.0});
  for (const double length : {1e-3, 1e-6, 1e-12}) {
    add("smoothing length " + number(length), {.smoothing_length = length});
    add("smoothing length " + number(length) + ", two unknowns",
        {.count = 21, .reads = stress_and_shear, .smoothing_length = length});
  }
  add("smoothing length 1e6 pitches", {.alpha = 1e-8, .smoothing_length = 5e5});
  for (const double alpha : {1e12, 1e24}) add("alpha " + number(alpha), {.alpha = alpha});
  add("alpha 1e+12, two unknowns", {.count = 21, .reads = stress_and_shear, .alpha = 1e12});
  return all;
}

std::vector<Case> large_cases() {
  std::vector<Case> all;
  for (const std::size_t count : {251U, 1024U})
    all.push_back(make("N = " + std::to_string(count),
                       {.count = count,
                        .reads = stress,
                        .contacts = {RigidContact{.center = 20.0, .half_width = 10.0},
                                     RigidContact{.center = 0.25 * static_cast<double>(count),
                                                  .half_width = 5.0}}}));
  return all;
}

}  // namespace tactile_net::hard
