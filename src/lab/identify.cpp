#include "tactile_net/lab/identify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::lab {
namespace {

/// Alternatives are decomposed on at most so many taxels, 81 of which take 20 ms and 802 a second;
/// an odd count stays odd, since its parity decides what is singular.
constexpr std::size_t most_taxels = 121;
std::size_t compared_taxels(std::size_t count) {
  return count <= most_taxels ? count : most_taxels - 1 + count % 2;
}

/// The largest reading that a ripple of normal traction of unit amplitude causes, whatever its
/// wavelength. A channel that a layer's base keeps from reading anything has the half plane's, so
/// that its rounding is not taken for a signal.
double largest_response(const Scene& scene, const Channel& channel) {
  const auto largest = [&](const Material& material) {
    double most = 0.0;
    for (std::size_t j = 1; j <= scene.sensor.count / 2; ++j) {
      const double k = 2.0 * std::numbers::pi * static_cast<double>(j) /
                       (static_cast<double>(scene.sensor.count) * scene.sensor.pitch);
      most = std::max(most, std::abs(pad_transform(channel.quantity, Traction::normal, material,
                                                   channel.depth, k)));
    }
    return most;
  };
  Material half_plane = scene.material;
  half_plane.layer.reset();
  const double of_pad = largest(scene.material);
  const double of_half_plane = largest(half_plane);
  return of_pad > 1e-9 * of_half_plane ? of_pad : of_half_plane;
}

double stated_rms(const Scene& scene, Quantity quantity) {
  if (!scene.noise) return 0.0;
  const auto stated = scene.noise->rms.find(quantity);
  return stated == scene.noise->rms.end() ? 0.0 : stated->second;
}

double peak_traction(const Scene& scene) {
  double peak = 0.0;
  for (const double f : sample(scene.contacts, scene.sensor).normal)
    peak = std::max(peak, std::abs(f));
  return peak > 0.0 ? peak : 1.0;
}

/// The noise that every channel is taken to have.
class AssumedNoise {
 public:
  AssumedNoise(const Scene& scene, const SurveyOptions& options, double traction)
      : scene_(scene), traction_(traction), use_stated_(!options.relative_noise) {
    double share = 0.0;
    for (const Channel& channel : channels(scene.sensor))
      share = std::max(share, stated_rms(scene, channel.quantity) /
                                  (traction * largest_response(scene, channel)));
    relative_ = options.relative_noise.value_or(share > 0.0 ? share : 0.01);
    const std::string relative = brief(100.0 * relative_) +
                                 " % of the largest reading that a ripple of that normal traction "
                                 "causes";
    words_ = use_stated_ && share > 0.0
                 ? "the scene's rms; for quantities without one the same share, " + relative
                 : relative;
  }

  [[nodiscard]] double operator()(const Channel& channel) const {
    const double stated = use_stated_ ? stated_rms(scene_, channel.quantity) : 0.0;
    return stated > 0.0 ? stated : relative_ * traction_ * largest_response(scene_, channel);
  }
  [[nodiscard]] const std::string& in_words() const noexcept { return words_; }

 private:
  const Scene& scene_;
  double traction_;
  bool use_stated_;
  double relative_ = 0.0;
  std::string words_;
};

SensorChoice study(const Scene& scene, const SensorArray& array, std::size_t taxels,
                   const AssumedNoise& noise, double traction) {
  SensorChoice choice{.reads = array.reads, .depths = array.depths};
  const std::vector<Channel> all = channels(array);
  choice.unknowns = all.size() > 1 && scene.reconstruct.tangential.value_or(true) ? 2 : 1;
  ProblemOptions options{.unknowns = choice.unknowns};
  for (const Channel& channel : all) options.channel_rms.push_back(noise(channel));
  choice.resolutions = resolutions(array, scene.material, options);
  choice.normal = resolvable_wavelength(choice.resolutions, Traction::normal, traction);
  if (choice.unknowns == 2)
    choice.tangential = resolvable_wavelength(choice.resolutions, Traction::tangential, traction);

  SensorArray decomposed = array;
  decomposed.count = taxels;
  if (taxels == array.count) options.dead_taxels = scene.dead_taxels;
  choice.identifiability = identifiability(make_problem(decomposed, scene.material, options));
  return choice;
}

bool same(std::vector<Quantity> a, std::vector<Quantity> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

}  // namespace

bool hides_mean(const SensorChoice& choice, Traction component) {
  const Resolution& mean = choice.resolutions.front();
  return !std::isfinite(component == Traction::normal ? mean.normal : mean.tangential);
}

double coarsest(const SensorChoice& choice) {
  const double none = std::numeric_limits<double>::infinity();
  return std::max(choice.normal.value_or(none),
                  choice.unknowns == 2 ? choice.tangential.value_or(none) : 0.0);
}

bool tells_more(const SensorChoice& a, const SensorChoice& b) {
  const auto key = [](const SensorChoice& choice) {
    return std::tuple(hides_mean(choice, Traction::normal) ||
                          (choice.unknowns == 2 && hides_mean(choice, Traction::tangential)),
                      coarsest(choice), choice.identifiability.null_space.dimension > 0,
                      choice.identifiability.condition);
  };
  return key(a) < key(b);
}

Survey identify(const Scene& scene, const SurveyOptions& options, Observer& observer) {
  Survey result{.traction = options.traction.value_or(peak_traction(scene)),
                .taxels = compared_taxels(scene.sensor.count)};
  const AssumedNoise noise(scene, options, result.traction);
  result.noise = noise.in_words();
  observer.step({Step::Kind::sensors});
  result.own = study(scene, scene.sensor, scene.sensor.count, noise, result.traction);

  const auto add = [&](std::vector<Quantity> reads, std::vector<double> depths) {
    if (same(reads, scene.sensor.reads) && depths == scene.sensor.depths) return;
    const SensorArray array{scene.sensor.count, scene.sensor.pitch, std::move(depths),
                            std::move(reads)};
    observer.step({Step::Kind::alternative, result.alternatives.size() + 1});
    result.alternatives.push_back(study(scene, array, result.taxels, noise, result.traction));
  };
  const double depth = scene.sensor.depths.front();
  for (const Quantity quantity : quantities) add({quantity}, {depth});
  for (std::size_t i = 0; i < quantities.size(); ++i)
    for (std::size_t j = i + 1; j < quantities.size(); ++j)
      add({quantities[i], quantities[j]}, {depth});
  const std::vector<double> two = scene.sensor.depths.size() == 2
                                      ? scene.sensor.depths
                                      : std::vector<double>{0.5 * depth, depth};
  for (const Quantity quantity : quantities) add({quantity}, two);

  std::vector<const SensorChoice*> pairs;
  const auto is_pair = [](const SensorChoice& choice) {
    return choice.reads.size() == 2 && choice.depths.size() == 1;
  };
  if (is_pair(result.own)) pairs.push_back(&result.own);
  for (const SensorChoice& choice : result.alternatives)
    if (is_pair(choice)) pairs.push_back(&choice);
  std::stable_sort(pairs.begin(), pairs.end(), [](auto a, auto b) { return tells_more(*a, *b); });
  const std::array best = {pairs[0]->reads, pairs[1]->reads};
  for (const std::vector<Quantity>& reads : best)
    for (const double factor : {0.5, 1.5, 2.0})
      if (!scene.material.layer || factor * depth <= scene.material.layer->thickness)
        add(reads, {factor * depth});
  return result;
}

std::string in_words(const SensorChoice& choice) {
  std::vector<std::string> reads;
  std::vector<std::string> depths;
  for (const Quantity quantity : choice.reads) reads.emplace_back(name(quantity));
  for (const double depth : choice.depths) depths.push_back(brief(depth));
  return report::join(reads, ", ") + " at " + report::join(depths, " and ");
}

std::string hidden_in_short(const SensorChoice& choice) {
  const ModeSpace& space = choice.identifiability.null_space;
  if (space.dimension == 0) return "-";
  if (space.dimension > 1) {
    std::string text = std::to_string(space.dimension) + " modes";
    if (space.longest > 0.0)
      text += ", wavelengths " + brief(space.shortest) + " to " +
              (std::isinf(space.longest) ? "k = 0" : brief(space.longest));
    return text;
  }
  const TractionMode& mode = space.modes.front();
  return std::string(mode.normal_share >= 0.5 ? "normal" : "tangential") + ", " +
         (!mode.wavelength   ? "k = 0"
          : mode.alternating ? "alternating"
                             : "wavelength " + brief(*mode.wavelength));
}

}  // namespace tactile_net::lab
