#include "tactile_net/lab/identify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "lab/survey_assumptions.hpp"
#include "lab/unseen_width.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/resolution.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/sensing/aperture.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::lab {
namespace {

/// Alternatives are decomposed on at most so many taxels, 81 of which take 20 ms and 802 a second;
/// an odd count stays odd, since its parity decides what is singular.
constexpr std::size_t most_compared_taxels = 121;
std::size_t compared_taxels(std::size_t count) {
  return count <= most_compared_taxels ? count : most_compared_taxels - 1 + count % 2;
}

/// The largest reading that a ripple of normal traction of unit amplitude causes, whatever its
/// wavelength. A channel that a layer's base keeps from reading anything has the half plane's, so
/// that its rounding is not taken for a signal.
double largest_response(const Scene& scene, const Channel& channel) {
  const Aperture aperture(channel.width, channel.depth);
  const auto largest = [&](const Material& material) {
    double most = 0.0;
    for (std::size_t j = 1; j <= scene.sensor.count / 2; ++j) {
      const double k = 2.0 * std::numbers::pi * static_cast<double>(j) /
                       (static_cast<double>(scene.sensor.count) * scene.sensor.pitch);
      most = std::max(
          most, std::abs(aperture.transform(k) * pad_transform(channel.quantity, Traction::normal,
                                                               material, channel.depth, k)));
    }
    return most;
  };
  Material half_plane = scene.material;
  half_plane.layer.reset();
  const double of_pad = largest(scene.material);
  const double of_half_plane = largest(half_plane);
  return of_pad > 1e-9 * of_half_plane ? of_pad : of_half_plane;
}

/// 0 without a contact.
double peak_traction(const Scene& scene) {
  double peak = 0.0;
  for (const double f : sample(scene.contacts, surface(scene)).normal)
    peak = std::max(peak, std::abs(f));
  return peak;
}

/// As the templates of survey_assumptions.hpp take it.
auto response_of(const Scene& scene) {
  return [&scene](const Channel& channel) { return largest_response(scene, channel); };
}

/// The depths at which every taxel reads: of uneven taxels the first stands for all.
std::vector<double> depths_of(const SensorArray& array) {
  return is_even(array) ? array.depths : std::vector{array.depths.front()};
}

SensorArray first_of(SensorArray array, std::size_t taxels) {
  if (taxels >= array.count) return array;
  if (!is_even(array)) {
    array.taxels.resize(taxels);
    return uneven_array(std::move(array.taxels));
  }
  array.count = taxels;
  return array;
}

/// What the array tells of the scene; singular values are of `taxels` of its taxels.
SensorChoice study(const Scene& scene, const SensorArray& array, std::size_t taxels,
                   const AssumedNoise& noise, double traction) {
  SensorChoice choice{.reads = array.reads, .depths = depths_of(array)};
  const std::vector<Channel> all = channels(array);
  choice.unknowns = all.size() > 1 && scene.reconstruct.tangential.value_or(true) ? 2 : 1;
  LineProblemOptions options{.unknowns = choice.unknowns,
                             .unknown_offsets = scene.reconstruct.offset};
  for (const Channel& channel : all)
    options.channel_rms.push_back(assumed_rms(scene, noise, channel, traction, response_of(scene)));
  const std::vector<Resolution> waves = resolutions(array, scene.material, options);
  for (const Resolution& one : waves)
    choice.resolutions.push_back(
        {.wavenumber_y = 2.0 * std::numbers::pi / one.wavelength,
         .of_wave = {one.normal, one.tangential, std::numeric_limits<double>::infinity()}});
  const HiddenWaves mean{
      .direction = WaveDirection::mean,
      .normal = !std::isfinite(waves.front().normal),
      .divergence = choice.unknowns == 2 && !std::isfinite(waves.front().tangential)};
  if (mean.count() > 0) choice.hidden.push_back(mean);
  for (const SkinRipple ripple : ripples_of(choice.unknowns)) {
    const auto wavelength = resolvable_wavelength(
        waves, ripple == SkinRipple::pressure ? Traction::normal : Traction::tangential_y,
        traction);
    choice.wavelengths[static_cast<std::size_t>(ripple)] = {{wavelength, {}, wavelength}};
  }

  choice.unseen =
      unseen_width(array, scene.material, options.channel_rms, scene.dead_taxels, traction);

  const SensorArray decomposed = first_of(array, array.count * taxels / scene.sensor.count);
  if (taxels == array.count) options.dead_taxels = scene.dead_taxels;
  options.surface = one_value_per_taxel(decomposed);
  const Identifiability& all_told = choice.identifiability.emplace(
      identifiability(make_problem(decomposed, scene.material, options)));
  choice.array = {.tractions = all_told.singular_values.size(),
                  .hidden = all_told.null_space.dimension,
                  .condition = all_told.condition,
                  .noise_gain = all_told.noise_gain};
  return choice;
}

/// Taxels that all read the same, at each depth; uneven ones in their places and as much deeper
/// than the first depth as they are.
SensorArray reading(const SensorArray& array, const std::vector<Quantity>& reads,
                    const std::vector<double>& depths) {
  if (is_even(array)) return {array.count, array.pitch, depths, reads, array.width};
  std::vector<Taxel> taxels;
  for (const Taxel& taxel : array.taxels)
    for (const double depth : depths)
      taxels.push_back({.y = taxel.y,
                        .depth = taxel.depth * (depth / array.depths.front()),
                        .reads = reads,
                        .width = taxel.width});
  return uneven_array(std::move(taxels));
}

/// The scene's sensors, and what else stands in their place.
class SensorComparison {
 public:
  SensorComparison(const Scene& scene, Survey& survey, Observer& observer)
      : scene_(scene), survey_(survey), observer_(observer) {}

  void own() {
    observer_.step({Step::Kind::sensors});
    survey_.own =
        study(scene_, scene_.sensor, scene_.sensor.count, survey_.noise, survey_.traction);
    const double k = 2.0 * std::numbers::pi / survey_.wave;
    for (const Channel& channel : channels(scene_.sensor)) {
      const double rms =
          assumed_rms(scene_, survey_.noise, channel, survey_.traction, response_of(scene_));
      WaveShare share{channel.quantity, channel.depth, {}};
      for (const SkinRipple ripple : ripples_of(survey_.own.unknowns)) {
        const Traction part =
            ripple == SkinRipple::pressure ? Traction::normal : Traction::tangential_y;
        share.signal[static_cast<std::size_t>(ripple)] =
            survey_.traction / rms *
            std::abs(Aperture(channel.width, channel.depth).transform(k) *
                     pad_transform(channel.quantity, part, scene_.material, channel.depth, k));
      }
      survey_.shares.push_back(without_rounding(share));
    }
  }

  /// Every quantity and every pair at the scene's first depth, every quantity at two depths.
  void in_place() {
    const double depth = scene_.sensor.depths.front();
    for (const Quantity quantity : line_quantities) add({quantity}, {depth});
    for (std::size_t i = 0; i < line_quantities.size(); ++i)
      for (std::size_t j = i + 1; j < line_quantities.size(); ++j)
        add({line_quantities[i], line_quantities[j]}, {depth});
    const std::vector<double> two = depths_of(scene_.sensor).size() == 2
                                        ? scene_.sensor.depths
                                        : std::vector<double>{0.5 * depth, depth};
    for (const Quantity quantity : line_quantities) add({quantity}, two);
  }

  /// The two best pairs at other depths.
  void best_pairs_elsewhere() {
    std::vector<const SensorChoice*> pairs;
    const auto is_pair = [](const SensorChoice& choice) {
      return choice.reads.size() == 2 && choice.depths.size() == 1;
    };
    if (is_pair(survey_.own)) pairs.push_back(&survey_.own);
    for (const SensorChoice& choice : survey_.alternatives)
      if (is_pair(choice)) pairs.push_back(&choice);
    std::stable_sort(pairs.begin(), pairs.end(), [](auto a, auto b) { return tells_more(*a, *b); });
    const std::array best = {pairs[0]->reads, pairs[1]->reads};
    const auto& layer = scene_.material.layer;
    for (const std::vector<Quantity>& reads : best)
      for (const double factor : {0.5, 1.5, 2.0})
        if (!layer || factor * deepest() <= layer->thickness)
          add(reads, {factor * scene_.sensor.depths.front()});
  }

 private:
  [[nodiscard]] double deepest() const {
    const std::vector<double>& depths = scene_.sensor.depths;
    return *std::max_element(depths.begin(), depths.end());
  }

  void add(const std::vector<Quantity>& reads, const std::vector<double>& depths) {
    const SensorArray& sensor = scene_.sensor;
    if (same(reads, sensor.reads) && depths == depths_of(sensor)) return;
    observer_.step({Step::Kind::alternative, survey_.alternatives.size() + 1});
    survey_.alternatives.push_back(study(scene_, reading(sensor, reads, depths), survey_.rows,
                                         survey_.noise, survey_.traction));
  }

  const Scene& scene_;
  Survey& survey_;
  Observer& observer_;
};

Advice advice_of(const Survey& survey) {
  const SensorChoice& own = survey.own;
  const auto worth = [&](const SensorChoice& choice) {
    if (choice.unknowns != own.unknowns) return true;
    return tells_more(choice, own) && ((hides_anything(own) && !hides_anything(choice)) ||
                                       coarsest(choice) < 0.9 * coarsest(own));
  };
  const auto best = [&](const auto& counts) { return best_of(survey, counts, worth); };
  const auto shares = [&](const SensorChoice& choice) {
    return std::any_of(own.reads.begin(), own.reads.end(), [&](Quantity quantity) {
      return std::find(choice.reads.begin(), choice.reads.end(), quantity) != choice.reads.end();
    });
  };
  Advice advice{.exchange = best([&](const SensorChoice& choice) {
                  return choice.depths == own.depths && choice.reads.size() == own.reads.size() &&
                         choice.unknowns == own.unknowns &&
                         (own.reads.size() == 1 || shares(choice));
                })};
  const auto here = best([&](const SensorChoice& choice) {
    return choice.unknowns == 2 && choice.depths.size() == 1 &&
           choice.depths.front() == own.depths.front();
  });
  const auto any = best([](const SensorChoice& choice) { return choice.unknowns == 2; });
  if (here != advice.exchange) advice.pair_here = here;
  if (any != advice.exchange && any != here) advice.best = any;
  return advice;
}

void check_positive(const char* name, const std::optional<double>& value) {
  if (value && (!(*value > 0.0) || !std::isfinite(*value)))
    throw std::invalid_argument(std::string(name) + " is " + shortest(*value) +
                                ": must be > 0 and finite");
}

}  // namespace

void check(const SurveyOptions& options) {
  check_positive("traction", options.traction);
  check_positive("relative_noise", options.relative_noise);
}

bool needs_traction(const Scene& scene, const SurveyOptions& options) {
  return lacks_traction(scene, options, peak_traction);
}

double traction_behind(const Scene& scene, std::span<const double> largest) {
  return traction_of(scene, largest, response_of(scene));
}

Survey identify(const Scene& scene, const SurveyOptions& options, Observer& observer) {
  check(options);
  Survey result{.traction = assumed_traction(scene, options, peak_traction),
                .rows = compared_taxels(scene.sensor.count)};
  result.is_whole = result.rows == scene.sensor.count;
  result.noise = assumed_noise(scene, options, result.traction, response_of(scene));
  const std::vector<double> depths = depths_of(scene.sensor);
  const double least = *std::min_element(depths.begin(), depths.end());
  // Twice as long as a skin's: of 2 pi depth a shear reads nothing of the drag.
  result.wave = length_of_wave(2.0 * least, scene.sensor.pitch);
  SensorComparison comparison(scene, result, observer);
  comparison.own();
  comparison.in_place();
  comparison.best_pairs_elsewhere();
  result.reasons = hidden_reasons(scene, result.own);
  result.advice = advice_of(result);
  return result;
}

}  // namespace tactile_net::lab
