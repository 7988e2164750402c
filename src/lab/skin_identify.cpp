#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "lab/skin_unseen_width.hpp"
#include "lab/survey_assumptions.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/elasticity/space/skin_transform.hpp"

namespace tactile_net::lab {
namespace {

using std::numbers::pi;

/// Singular values are judged on lattices of at most so many taxels a side, the scene's own of so
/// many tractions in all; an odd count stays odd, since its parity decides what is singular.
constexpr std::size_t most_side = 12;
constexpr std::size_t most_compared_tractions = 2048;

constexpr double wave_angle = pi / 6.0;  // oblique: what an axis or a diagonal hides shows

std::size_t compared_side(std::size_t count) {
  return count <= most_side ? count : most_side - count % 2;
}

/// The largest reading that a ripple of normal traction of unit amplitude causes, whatever its
/// wave. A channel that a layer's base keeps from reading anything has the half space's, so that
/// its rounding is not taken for a signal.
double largest_response(const SkinArray& skin, const Material& material, Quantity quantity,
                        double depth) {
  const auto largest = [&](const Material& body) {
    double most = 0.0;
    const auto take = [&](double k_y, double k_z) {
      most = std::max(most,
                      std::abs(skin_transform(quantity, Traction::normal, body, depth, k_y, k_z)));
    };
    const double length = std::max(static_cast<double>(skin.rows) * skin.pitch_y,
                                   static_cast<double>(skin.columns) * skin.pitch_z);
    const double longest = std::max(length, 2.0 * pi * depth);
    for (double wave = longest; wave > 0.01 * longest; wave *= 0.8)
      for (const double angle : {0.0, 0.25 * pi, 0.5 * pi})
        take(2.0 * pi / wave * std::cos(angle), 2.0 * pi / wave * std::sin(angle));
    return most;
  };
  Material half_space = material;
  half_space.layer.reset();
  const double of_pad = largest(material);
  const double of_half_space = largest(half_space);
  return of_pad > 1e-9 * of_half_space ? of_pad : of_half_space;
}

/// 0 without a contact.
double peak_skin_traction(const SkinScene& scene) {
  if (scene.contacts.empty()) return 0.0;
  const SurfaceGrid cells = grid(scene);
  const std::vector<double> means = cell_means(scene.contacts, cells);
  double peak = 0.0;
  for (std::size_t i = 0; i < cells.count(); ++i) peak = std::max(peak, std::abs(means[i]));
  return peak;
}

/// As the templates of survey_assumptions.hpp take it.
auto response_of(const SkinScene& scene) {
  return [&scene](const Channel& channel) {
    return largest_response(scene.sensor, scene.material, channel.quantity, channel.depth);
  };
}

/// With singular values small enough to be decomposed at once.
SkinArray compared(SkinArray skin, std::size_t rows, std::size_t columns) {
  if (!is_even(skin)) return skin;
  skin.rows = rows;
  skin.columns = columns;
  return skin;
}

/// Taxels that all read the same, at each of the depths; uneven ones in their places and as much
/// deeper than the least depth as they are.
SkinArray reading(const SkinArray& skin, const std::vector<Quantity>& reads,
                  const std::vector<double>& factors) {
  SkinArray other = skin;
  const double least = least_depth(skin);
  if (is_even(skin)) {
    other.reads = reads;
    other.depths.clear();
    for (const double factor : factors) other.depths.push_back(factor * least);
    return other;
  }
  std::vector<Taxel> taxels;
  for (std::size_t i = 0; i < skin.taxels.size(); ++i)
    for (std::size_t d = 0; d < factors.size(); ++d) {
      const Taxel& taxel = skin.taxels[i];
      taxels.push_back({std::to_string(i) + "@" + std::to_string(d), taxel.y, taxel.z,
                        taxel.depth * factors[d], reads});
    }
  return uneven_skin(std::move(taxels));
}

/// The scene's sensors, and what else stands in their place.
class SkinComparison {
 public:
  SkinComparison(const SkinScene& scene, Survey& survey, Observer& observer)
      : scene_(scene), survey_(survey), observer_(observer) {}

  void own() {
    observer_.step({Step::Kind::sensors});
    survey_.own = *study(scene_.sensor, true);
    const std::vector<Channel> all = channels(scene_.sensor);
    const SkinProblemOptions options = options_of(scene_.sensor, survey_.own.unknowns);
    const double k = 2.0 * pi / survey_.wave;
    const double c = std::cos(wave_angle);
    const double s = std::sin(wave_angle);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto of = [&](Traction component) {
        return survey_.traction / options.channel_rms[i] *
               skin_transform(all[i].quantity, component, scene_.material, all[i].depth, k * c,
                              k * s);
      };
      WaveShare share{all[i].quantity, all[i].depth, {}};
      share.signal[0] = std::abs(of(Traction::normal));
      if (survey_.own.unknowns == 3) {
        const std::complex<double> y = of(Traction::tangential_y);
        const std::complex<double> z = of(Traction::tangential_z);
        share.signal[1] = std::abs(c * y + s * z);
        share.signal[2] = std::abs(c * z - s * y);
      }
      survey_.shares.push_back(without_rounding(share));  // of the turn
    }
  }

  /// The scene's own quantities and depths apart, then what skins read elsewhere, at its least
  /// depth, and what pressure alone tells at several depths.
  void in_place() {
    using enum Quantity;
    const std::vector<Quantity>& reads = scene_.sensor.reads;
    const std::vector<double> own_depths = factors();
    if (reads.size() > 1)
      for (const Quantity quantity : reads) add({quantity}, own_depths);
    if (own_depths.size() > 1)
      for (const double factor : own_depths) add(reads, {factor});
    const std::vector<std::vector<Quantity>> sets = {
        {stress_x},
        {stress_x, shear_xy},
        {shear_xy, shear_xz},
        {stress_x, shear_xy, shear_xz},
        {stress_x, stress_y, stress_z},
        {stress_x, stress_y, stress_z, shear_yz},
        {strain_x, strain_y, strain_z},
        {strain_x, shear_strain_xy, shear_strain_xz},
        {strain_y, strain_z, shear_strain_yz},
        {displacement_y, displacement_z},
        {displacement_x, displacement_y, displacement_z}};
    for (const auto& set : sets) add(set, {1.0});
    add({stress_x}, {1.0, 1.5});
    add({stress_x}, {1.0, 1.5, 2.0});
    add({shear_xy, shear_xz}, {1.0, 1.5});
    if (own_depths.size() == 1) add(reads, {1.0, 1.5});
  }

  /// The two best at other depths.
  void best_elsewhere() {
    std::vector<const SensorChoice*> order;
    for (const SensorChoice& choice : survey_.alternatives)
      if (choice.depths.size() == 1 || !is_even(scene_.sensor)) order.push_back(&choice);
    if (factors().size() == 1) order.push_back(&survey_.own);
    std::stable_sort(order.begin(), order.end(), [](auto a, auto b) { return tells_more(*a, *b); });
    std::vector<std::vector<Quantity>> best;
    for (std::size_t i = 0; i < std::min<std::size_t>(order.size(), 2); ++i)
      best.push_back(order[i]->reads);
    for (const auto& reads : best)
      for (const double factor : {0.5, 1.5, 2.0}) add(reads, {factor});
  }

 private:
  /// Depths over the least one.
  [[nodiscard]] std::vector<double> factors() const {
    if (!is_even(scene_.sensor)) return {1.0};
    std::vector<double> all = scene_.sensor.depths;
    for (double& depth : all) depth /= least_depth(scene_.sensor);
    std::sort(all.begin(), all.end());
    return all;
  }

  [[nodiscard]] SkinProblemOptions options_of(const SkinArray& skin, std::size_t components) const {
    SkinProblemOptions options{.components = components};
    for (const Channel& channel : channels(skin))
      options.channel_rms.push_back(
          assumed_rms(scene_, survey_.noise, channel, survey_.traction, response_of(scene_)));
    return options;
  }

  /// Nothing of sensors that this material does not let read.
  [[nodiscard]] std::optional<SensorChoice> study(const SkinArray& skin, bool is_own) const {
    SensorChoice choice{.reads = skin.reads, .depths = skin.depths};
    choice.unknowns =
        channel_count(skin) > 1 && scene_.reconstruct.tangential.value_or(true) ? 3 : 1;
    SkinProblemOptions options = options_of(skin, choice.unknowns);
    if (!is_own) {
      try {
        check(skin, scene_.material, options);
      } catch (const std::invalid_argument&) {
        return std::nullopt;
      }
    }
    choice.resolutions = skin_resolutions(skin, scene_.material, options);
    for (const SkinRipple ripple : ripples_of(choice.unknowns))
      for (std::size_t d = 0; d < 3; ++d)
        choice.wavelengths[static_cast<std::size_t>(ripple)][d] = resolvable_wavelength(
            choice.resolutions, ripple,
            std::array{WaveDirection::along_y, WaveDirection::along_z, WaveDirection::any}[d],
            survey_.traction);
    const double k = 2.0 * pi / survey_.wave;
    choice.wave_condition = wave_observability(skin, scene_.material, options,
                                               k * std::cos(wave_angle), k * std::sin(wave_angle))
                                .condition;
    choice.unseen =
        skin_unseen_width(skin, scene_.material, options.channel_rms,
                          is_own || is_even(skin) ? scene_.dead_taxels : std::vector<std::size_t>{},
                          survey_.traction);
    if (is_own && survey_.is_whole) options.dead_taxels = scene_.dead_taxels;
    SkinObservability told =
        observability(is_even(skin) ? compared(skin, survey_.rows, survey_.columns) : skin,
                      scene_.material, options);
    choice.hidden = std::move(told.hidden);
    choice.array = told.finite;
    return choice;
  }

  void add(const std::vector<Quantity>& reads, const std::vector<double>& depth_factors) {
    const SkinArray skin = reading(scene_.sensor, reads, depth_factors);
    const auto is_there = [&](const SensorChoice& choice) {
      if (!same(choice.reads, skin.reads) || choice.depths.size() != skin.depths.size())
        return false;
      for (std::size_t i = 0; i < skin.depths.size(); ++i)
        if (std::abs(choice.depths[i] - skin.depths[i]) > 1e-9 * skin.depths[i]) return false;
      return true;
    };
    const auto& others = survey_.alternatives;
    if (is_there(survey_.own) || std::any_of(others.begin(), others.end(), is_there)) return;
    observer_.step({Step::Kind::alternative, others.size() + 1});
    if (auto choice = study(skin, false)) survey_.alternatives.push_back(std::move(*choice));
  }

  const SkinScene& scene_;
  Survey& survey_;
  Observer& observer_;
};

}  // namespace

bool needs_traction(const SkinScene& scene, const SurveyOptions& options) {
  return lacks_traction(scene, options, peak_skin_traction);
}

double traction_behind(const SkinScene& scene, std::span<const double> largest) {
  return traction_of(scene, largest, response_of(scene));
}

Survey identify(const SkinScene& scene, const SurveyOptions& options, Observer& observer) {
  check(options);
  Survey result{.traction = assumed_traction(scene, options, peak_skin_traction),
                .rows = scene.sensor.rows,
                .columns = scene.sensor.columns};
  if (is_even(scene.sensor) && 3 * taxel_count(scene.sensor) > most_compared_tractions) {
    result.rows = compared_side(scene.sensor.rows);
    result.columns = compared_side(scene.sensor.columns);
    result.is_whole = result.rows == scene.sensor.rows && result.columns == scene.sensor.columns;
  }
  result.noise = assumed_noise(scene, options, result.traction, response_of(scene));
  result.wave = length_of_wave(least_depth(scene.sensor),
                               std::max(scene.sensor.pitch_y, scene.sensor.pitch_z));
  SkinComparison comparison(scene, result, observer);
  comparison.own();
  comparison.in_place();
  comparison.best_elsewhere();
  const SensorChoice& own = result.own;
  const auto worth = [&](const SensorChoice& choice) {
    return tells_more(choice, own) &&
           (choice.unknowns > own.unknowns || hidden_waves(choice) < hidden_waves(own) ||
            coarsest(choice) < 0.9 * coarsest(own));
  };
  Advice& advice = result.advice;
  advice.exchange = best_of(
      result,
      [&](const SensorChoice& choice) {
        return choice.depths == own.depths && choice.reads.size() <= own.reads.size();
      },
      worth);
  advice.best = best_of(
      result, [](const SensorChoice&) { return true; }, worth);
  if (advice.best == advice.exchange) advice.best.reset();
  return result;
}

}  // namespace tactile_net::lab
