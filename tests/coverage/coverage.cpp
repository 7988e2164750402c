#include "tests/coverage/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::coverage {
namespace {

constexpr double half_length = 8.0;  // of the array
constexpr double finest_pitch = 0.25;
constexpr double most_friction = 0.6;

SensorArray array_of(double pitch, std::size_t unknowns) {
  SensorArray array{.count = static_cast<std::size_t>(std::lround(2.0 * half_length / pitch)) + 1,
                    .pitch = pitch,
                    .depths = {1.0},
                    .reads = {Quantity::stress_x}};
  if (unknowns == 2) array.reads.push_back(Quantity::shear_xy);
  return array;
}

Material pad(bool layer) {
  Material material{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
  if (layer) material.layer = Layer{.thickness = 3.0, .base = Base::bonded};
  return material;
}

/// From text, for the reader's defaults.
Scene scene_of(const Setting& setting) {
  const SensorArray array = array_of(setting.pitch, setting.unknowns);
  const std::string noise = shortest(setting.noise);
  const bool two = setting.unknowns == 2;
  std::string toml = "[sensor]\ncount = " + std::to_string(array.count) +
                     "\npitch = " + shortest(array.pitch) + "\ndepth = 1.0\n" +
                     (two ? "reads = [\"stress_x\", \"shear_xy\"]\n" : "reads = [\"stress_x\"]\n") +
                     "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n";
  if (setting.layer) toml += "layer = { thickness = 3.0, base = \"bonded\" }\n";
  if (setting.stated)
    toml += "[noise]\nrms = " +
            (two ? "{ stress_x = " + noise + ", shear_xy = " + noise + " }\n" : noise + "\n");
  toml += "[reconstruct]\n" + setting.reconstruct;
  if (setting.grid) toml += "surface = \"grid\"\n";
  return parse_scene(toml, "coverage");
}

bool within(double value, double truth, double deviation) {
  return std::abs(value - truth) <= 2.0 * deviation;
}

}  // namespace

SurfaceBasis basis(const Setting& setting) { return scene_of(setting).reconstruct.surface.basis; }

Contacts::Contacts(std::size_t count, Place place, bool layer, const HalfWidths& half_widths) {
  std::mt19937_64 random(place == Place::inside ? 1 : 2);
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * std::ldexp(static_cast<double>(random() >> 11U), -53);
  };
  const SensorArray array = array_of(finest_pitch, 2);
  for (std::size_t i = 0; i < count; ++i) {
    RigidContact contact{.half_width = uniform(half_widths.least, half_widths.most)};
    contact.friction = uniform(-most_friction, most_friction);
    const double end = i % 2 == 0 ? half_length : -half_length;
    contact.center = place == Place::inside
                         ? uniform(-0.6, 0.6) * half_length
                         : end * (1.0 - uniform(0.0, 1.0) * contact.half_width / half_length);
    const auto readings = [&](double friction) {
      RigidContact one = contact;
      one.friction = friction;
      return exact_readings(array, pad(layer), std::vector<Contact>{one});
    };
    contacts_.push_back(contact);
    pressed_.push_back(readings(0.0));
    dragged_.push_back(readings(1.0));
    for (std::size_t j = 0; j < dragged_.back().size(); ++j)
      dragged_.back()[j] -= pressed_.back()[j];
  }
}

Contacts::Frame Contacts::frame(std::size_t i, const Setting& setting) const {
  Frame frame{.contact = contacts_[i]};
  if (setting.unknowns == 1) frame.contact.friction = 0.0;
  const std::size_t all = array_of(finest_pitch, 1).count;
  const auto stride = static_cast<std::size_t>(std::lround(setting.pitch / finest_pitch));
  double peak = 0.0;
  for (std::size_t channel = 0; channel < setting.unknowns; ++channel)
    for (std::size_t j = 0; j < all; j += stride) {
      const std::size_t at = channel * all + j;
      frame.readings.push_back(pressed_[i][at] + frame.contact.friction * dragged_[i][at]);
      peak = std::max(peak, std::abs(frame.readings.back()));
    }
  frame.contact.force = 1.0 / peak;
  for (double& reading : frame.readings) reading /= peak;
  return frame;
}

double at_share(const std::vector<double>& ascending, double share) {
  return ascending[static_cast<std::size_t>(share * static_cast<double>(ascending.size() - 1))];
}

Score score(const Setting& setting, const Contacts& contacts) {
  const lab::SceneProblem problem(scene_of(setting));
  const auto solver = lab::make_solver(problem, Method::tikhonov);
  const std::size_t taxels = problem.scene().sensor.count;
  std::vector<double> f(solver->tractions());
  Score score{.frames = contacts.count()};
  std::size_t force = 0, tangential = 0, centre = 0, values = 0;
  for (std::size_t i = 0; i < contacts.count(); ++i) {
    Contacts::Frame made = contacts.frame(i, setting);
    for (std::size_t channel = 0; channel < setting.unknowns; ++channel)
      add_noise(std::span(made.readings).subspan(channel * taxels, taxels), setting.noise, i,
                channel);
    for (double& reading : made.readings) reading += setting.offset;
    const lab::FrameResult result = solver->solve(made.readings, f);
    const lab::SceneFrame frame(problem, made.readings);
    const lab::FrameUncertainty bands = lab::uncertainty(frame, f, result);

    const TractionField field = sample(std::vector<Contact>{made.contact}, problem.surface());
    std::vector<double> truth = field.normal;
    if (setting.unknowns == 2)
      truth.insert(truth.end(), field.tangential.begin(), field.tangential.end());
    const double normal = made.contact.force;
    const auto& [found, found_tangential, found_centre, angle, covariance] = bands.resultant;
    score.force_errors.push_back(std::abs(found.value - normal) / normal);
    score.force_deviations.push_back(found.deviation / normal);
    score.field_errors.push_back(relative_l2_error(f, truth));
    force += within(found.value, normal, found.deviation);
    if (found_tangential)
      tangential += within(found_tangential->value, made.contact.friction * normal,
                           found_tangential->deviation);
    if (found_centre)
      centre += within(found_centre->value, made.contact.center, found_centre->deviation);
    for (std::size_t j = 0; j < f.size(); ++j) values += within(f[j], truth[j], bands.deviation[j]);
  }
  for (auto* list : {&score.force_errors, &score.force_deviations, &score.field_errors})
    std::sort(list->begin(), list->end());
  const auto frames = static_cast<double>(score.frames);
  score.force_within = static_cast<double>(force) / frames;
  score.tangential_within = static_cast<double>(tangential) / frames;
  score.centre_within = static_cast<double>(centre) / frames;
  score.field_within = static_cast<double>(values) / frames / static_cast<double>(f.size());
  return score;
}

}  // namespace tactile_net::coverage
