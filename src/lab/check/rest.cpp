#include "lab/check/rest.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "numeric/robust.hpp"

namespace tactile_net::lab {
namespace {

constexpr std::size_t least_still = 12;  // triples: fewer do not tell a taxel's noise
constexpr std::size_t least_alike = 5;

using Lines = std::span<const Channel>;

/// The median size of its channel's roughness for every reading, which makes
/// channels of different units alike.
std::vector<double> channel_roughness(std::span<const FrameTriple> triples,
                                      const std::vector<bool>& living, Lines channels) {
  std::vector<double> all(living.size());
  for (const Channel& channel : channels) {
    std::vector<double> sizes;
    for (const FrameTriple& triple : triples)
      for (std::size_t i = channel.first; i < channel.first + channel.count; ++i)
        if (const double d = triple.roughness(i); living[i] && std::isfinite(d))
          sizes.push_back(std::abs(d));
    const double middle = median(std::move(sizes));
    std::fill_n(all.begin() + static_cast<std::ptrdiff_t>(channel.first), channel.count,
                middle > 0.0 ? middle : 1.0);
  }
  return all;
}

/// How rough every triple is in the middle of its readings.
std::vector<double> roughness_of(std::span<const FrameTriple> triples,
                                 const std::vector<bool>& living, Lines channels) {
  const std::vector<double> scale = channel_roughness(triples, living, channels);
  std::vector<double> all;
  for (const FrameTriple& triple : triples) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < living.size(); ++i)
      if (const double d = triple.roughness(i); living[i] && std::isfinite(d))
        sizes.push_back(std::abs(d) / scale[i]);
    all.push_back(median(std::move(sizes)));
  }
  return all;
}

std::vector<std::size_t> alike(std::span<const FrameTriple* const> triples,
                               std::span<const double> frame, double reach,
                               const std::vector<bool>& living, const std::vector<double>& scale) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < triples.size(); ++k)
    if (frame_distance(triples[k]->middle(), frame, living, scale) <= reach) found.push_back(k);
  return found;
}

std::vector<double> median_frame(std::span<const FrameTriple* const> triples,
                                 const std::vector<std::size_t>& some,
                                 const std::vector<bool>& living) {
  std::vector<double> frame(living.size());
  for (std::size_t i = 0; i < living.size(); ++i) {
    if (!living[i]) continue;
    std::vector<double> values;
    for (const std::size_t k : some)
      for (const std::vector<double>& one : triples[k]->frames)
        if (std::isfinite(one[i])) values.push_back(one[i]);
    frame[i] = median(std::move(values));
  }
  return frame;
}

}  // namespace

double frame_distance(std::span<const double> a, std::span<const double> b,
                      const std::vector<bool>& living, const std::vector<double>& scale) {
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < living.size(); ++i) {
    if (!living[i]) continue;
    const double d = (a[i] - (b.empty() ? 0.0 : b[i])) / scale[i];
    if (!std::isfinite(d)) continue;
    squares += d * d;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(squares / count) : std::numeric_limits<double>::infinity();
}

StillNoise still_noise(std::span<const FrameTriple> triples, const std::vector<bool>& living,
                       std::span<const Channel> channels, std::span<const double> steps) {
  StillNoise noise;
  const std::vector<double> roughness = roughness_of(triples, living, channels);
  std::vector<double> rough;  // readings that are cut off have no noise at all
  std::copy_if(roughness.begin(), roughness.end(), std::back_inserter(rough),
               [](double one) { return one > 0.0; });
  const double calm = quantile(rough, 0.1);
  // Where all is noise the wildest triples are hardly rougher than the calmest.
  const double limit =
      quantile(roughness, 0.9) > 3.0 * calm ? 2.0 * calm : std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < triples.size(); ++k)
    if (roughness[k] <= limit) noise.still.push_back(&triples[k]);
  if (noise.still.size() < least_still) return noise;
  noise.steps.assign(steps.begin(), steps.end());

  noise.of_reading.resize(living.size());
  for (const Channel& channel : channels) {
    std::vector<double> of_living;
    for (std::size_t i = channel.first; i < channel.first + channel.count; ++i) {
      std::vector<double> values;
      for (const FrameTriple* triple : noise.still)
        if (const double d = triple->roughness(i); std::isfinite(d)) values.push_back(d);
      noise.of_reading[i] = robust_rms(std::move(values));
      if (living[i]) of_living.push_back(noise.of_reading[i]);
    }
    // Of two the one with less: the other may be broken.
    const auto middle = of_living.begin() + (std::ssize(of_living) - 1) / 2;
    if (!of_living.empty()) std::nth_element(of_living.begin(), middle, of_living.end());
    noise.of_channel.push_back(of_living.empty() ? 0.0 : *middle);
    // A reading beside the middle of two steps takes either, whatever the noise.
    const double half_a_step = 0.5 * steps[noise.least_change.size()];
    noise.least_change.push_back(std::max(noise.of_channel.back(), half_a_step));
    noise.scale.resize(channel.first + channel.count, noise.least_change.back());
  }
  return noise;
}

Rest find_rest(std::span<const FrameTriple* const> triples, const std::vector<bool>& living,
               const StillNoise& noise) {
  const std::vector<double>& scale = noise.scale;
  if (std::find(scale.begin(), scale.end(), 0.0) != scale.end()) return {};

  std::vector<std::pair<double, std::size_t>> by_load;
  for (std::size_t k = 0; k < triples.size(); ++k)
    by_load.emplace_back(frame_distance(triples[k]->middle(), {}, living, scale), k);
  std::sort(by_load.begin(), by_load.end());
  constexpr std::size_t most_tried = 20;
  // Noise that remembers differs more from state to state than from frame to
  // frame.
  for (const double reach : {2.0, 4.0, 8.0})
    for (std::size_t tried = 0; tried < std::min(most_tried, by_load.size()); ++tried) {
      const std::vector<double>& seed = triples[by_load[tried].second]->middle();
      std::vector<std::size_t> near = alike(triples, seed, reach, living, scale);
      if (near.size() < least_alike) continue;
      const std::vector<double> centre = median_frame(triples, near, living);
      near = alike(triples, centre, 0.75 * reach, living, scale);
      if (near.size() < least_alike) continue;
      return {.values = median_frame(triples, near, living), .triples = near};
    }
  return {};
}

}  // namespace tactile_net::lab
