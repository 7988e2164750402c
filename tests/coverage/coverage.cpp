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

constexpr double most_reach = half_length - 1.0;  // of two contacts
constexpr double evenness = 10.0;  // half widths from a punch's edge to where it were infinite

/// Taxels a quarter of the depth apart.
SensorArray finest_array(bool strain) {
  return {.count = static_cast<std::size_t>(std::lround(2.0 * half_length / finest_pitch)) + 1,
          .pitch = finest_pitch,
          .depths = {1.0},
          .reads = {strain ? Quantity::strain_x : Quantity::stress_x, Quantity::shear_xy}};
}

std::size_t count_of(const Setting& setting) {
  return static_cast<std::size_t>(2.0 * half_length / setting.pitch) + 1;
}

/// Which of them are the setting's.
std::vector<std::size_t> taxels_of(const Setting& setting) {
  std::vector<double> places = setting.positions;
  if (places.empty())
    for (std::size_t j = 0; j < count_of(setting); ++j)
      places.push_back(centred(j, count_of(setting)) * setting.pitch);
  std::vector<std::size_t> taxels;
  for (const double y : places)
    taxels.push_back(static_cast<std::size_t>(std::lround((y + half_length) / finest_pitch)));
  return taxels;
}

Material pad(bool layer) {
  Material material{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
  if (layer) material.layer = Layer{.thickness = 3.0, .base = Base::bonded};
  return material;
}

bool within(double value, double truth, double deviation) {
  return std::abs(value - truth) <= 2.0 * deviation;
}

}  // namespace

Scene scene_of(const Setting& setting) {
  const bool two = setting.unknowns == 2;
  const std::string first = setting.strain ? "strain_x" : "stress_x";
  std::string toml = "[sensor]\n";
  if (setting.positions.empty()) {
    toml += "count = " + std::to_string(count_of(setting)) + "\npitch = " + shortest(setting.pitch);
  } else {
    toml += "positions = [";
    for (const double y : setting.positions) toml += shortest(y) + ", ";
    toml += "]";
  }
  toml += "\ndepth = " + shortest(setting.stated_depth) + "\nreads = [\"" + first + "\"" +
          (two ? ", \"shear_xy\"" : "") +
          "]\n[material]\nyoungs_modulus = " + shortest(setting.stated_modulus) +
          "\npoisson_ratio = 0.45\n";
  if (setting.layer)
    toml +=
        "layer = { thickness = " + shortest(setting.stated_thickness) + ", base = \"bonded\" }\n";
  if (!setting.dead.empty()) {
    toml += "[dead_taxels]\nindices = [";
    for (const std::size_t taxel : setting.dead) toml += std::to_string(taxel) + ", ";
    toml += "]\n";
  }
  const std::string noise = shortest(setting.noise * setting.stated_noise);
  if (setting.stated)
    toml += "[noise]\n" + setting.of_noise + "rms = " +
            (two ? "{ " + first + " = " + noise + ", shear_xy = " + noise + " }\n" : noise + "\n");
  toml += "[reconstruct]\n" + setting.reconstruct;
  if (setting.grid) toml += "surface = \"grid\"\n";
  return parse_scene(toml, "coverage");
}

SurfaceBasis basis(const Setting& setting) { return scene_of(setting).reconstruct.surface.basis; }

Contacts::Contacts(std::size_t count, const ContactOptions& options) : seed_(options.seed) {
  std::mt19937_64 random((options.place == Place::inside ? 1 : 2) + 2 * options.seed);
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * std::ldexp(static_cast<double>(random() >> 11U), -53);
  };
  const SensorArray array = finest_array(options.strain);
  for (std::size_t i = 0; i < count; ++i) {
    const auto half_width = [&] {
      return uniform(options.half_widths.least, options.half_widths.most);
    };
    RigidContact contact{.half_width = half_width()};
    const double friction = uniform(-most_friction, most_friction);
    const double end = i % 2 == 0 ? half_length : -half_length;
    contact.center = options.place == Place::inside
                         ? uniform(-0.6, 0.6) * half_length
                         : end * (1.0 - uniform(0.0, 1.0) * contact.half_width / half_length);
    if (options.load == Load::even) {
      contact.shape = Shape::punch;
      contact.edge = evenness * contact.half_width;
    } else if (options.load == Load::rigid_punch) {
      contact.shape = Shape::punch;
    }
    std::vector<RigidContact> all{contact};
    if (options.load == Load::two_hertz) {
      RigidContact other{.half_width = half_width(), .force = uniform(0.5, 2.0)};
      const double apart = contact.half_width + uniform(0.5, 4.0) + other.half_width;
      const double reach = 0.5 * (contact.half_width + apart + other.half_width);
      const double first = std::clamp(contact.center, reach - most_reach, most_reach - reach) -
                           reach + contact.half_width;
      all.front().center = first;
      other.center = first + apart;
      all.push_back(other);
    }
    const auto readings = [&](double of_friction) {
      std::vector<Contact> rubbing;
      for (RigidContact one : all) {
        one.friction = of_friction;
        rubbing.emplace_back(one);
      }
      return exact_readings(array, pad(options.layer), rubbing);
    };
    contacts_.push_back(all);
    frictions_.push_back(friction);
    pressed_.push_back(readings(0.0));
    dragged_.push_back(readings(1.0));
    for (std::size_t j = 0; j < dragged_.back().size(); ++j)
      dragged_.back()[j] -= pressed_.back()[j];
  }
}

Contacts::Frame Contacts::frame(std::size_t i, const Setting& setting) const {
  Frame frame{.friction = setting.unknowns == 1 ? 0.0 : frictions_[i]};
  const std::vector<std::size_t> taxels = taxels_of(setting);
  double peak = 0.0;
  for (std::size_t channel = 0; channel < setting.unknowns; ++channel)
    for (const std::size_t taxel : taxels) {
      const std::size_t at = channel * pressed_[i].size() / 2 + taxel;
      frame.readings.push_back(pressed_[i][at] + frame.friction * dragged_[i][at]);
      peak = std::max(peak, std::abs(frame.readings.back()));
    }
  for (RigidContact one : contacts_[i]) {
    one.friction = frame.friction;
    one.force /= peak;
    frame.contacts.emplace_back(one);
    const double force = resultant(frame.contacts.back(), Traction::normal);
    frame.force += force;
    frame.centre += force * one.center;
  }
  frame.centre /= frame.force;
  for (double& reading : frame.readings) reading /= peak;
  for (std::size_t channel = 0; channel < setting.unknowns; ++channel)
    add_noise(std::span(frame.readings).subspan(channel * taxels.size(), taxels.size()),
              setting.noise, i + (seed_ << 32U), channel);
  for (double& reading : frame.readings) reading += setting.offset;
  for (const std::size_t taxel : setting.dead)
    for (std::size_t channel = 0; channel < setting.unknowns; ++channel)
      frame.readings[channel * taxels.size() + taxel] = 0.0;
  return frame;
}

double at_share(const std::vector<double>& ascending, double share) {
  return ascending[static_cast<std::size_t>(share * static_cast<double>(ascending.size() - 1))];
}

Score score(const Setting& setting, const Contacts& contacts) {
  const lab::SceneProblem problem(scene_of(setting));
  const auto solver = lab::make_solver(problem, Method::tikhonov);
  std::vector<double> f(solver->tractions());
  Score score{.frames = contacts.count()};
  std::size_t force = 0, tangential = 0, centre = 0, values = 0;
  for (std::size_t i = 0; i < contacts.count(); ++i) {
    const Contacts::Frame made = contacts.frame(i, setting);
    const lab::FrameResult result = solver->solve(made.readings, f);
    const lab::SceneFrame frame(problem, made.readings);
    const lab::FrameUncertainty bands = lab::uncertainty(frame, f, result);

    const TractionField field = sample(made.contacts, problem.surface());
    std::vector<double> truth = field.normal;
    if (setting.unknowns == 2)
      truth.insert(truth.end(), field.tangential.begin(), field.tangential.end());
    const double normal = made.force;
    const auto& [found, found_tangential, found_centre, angle, covariance] = bands.resultant;
    score.force_errors.push_back(std::abs(found.value - normal) / normal);
    score.force_deviations.push_back(found.deviation / normal);
    score.field_errors.push_back(relative_l2_error(f, truth));
    force += within(found.value, normal, found.deviation);
    if (found_tangential)
      tangential +=
          within(found_tangential->value, made.friction * normal, found_tangential->deviation);
    if (found_centre) centre += within(found_centre->value, made.centre, found_centre->deviation);
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
