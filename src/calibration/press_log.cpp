#include "tactile_net/calibration/press_log.hpp"

#include <cmath>
#include <stdexcept>

#include "numeric/named.hpp"

namespace tactile_net {
namespace {

constexpr Named<DiscProfile> profiles[] = {
    {DiscProfile::sphere, "sphere"}, {DiscProfile::punch, "punch"}, {DiscProfile::cone, "cone"}};

}  // namespace

std::string_view name(DiscProfile profile) noexcept { return name_in<profiles>(profile); }

UnloadedFrames unloaded_frames(const SignalLayout& sensor,
                               const std::vector<std::vector<double>>& frames) {
  if (frames.size() < 2) throw std::invalid_argument("noise takes two unloaded frames at least");
  const std::vector<Site>& where = sensor.readings;
  const std::size_t n = where.size();
  const auto count = static_cast<double>(frames.size());
  UnloadedFrames result{.frames = frames.size(),
                        .mean = std::vector<double>(n),
                        .reading_rms = std::vector<double>(n),
                        .rms = std::vector<double>(sensor.channels.size())};
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (frames[f].size() != n) throw std::invalid_argument("a frame has another length");
    for (std::size_t i = 0; i < n; ++i)  // the mean so far: no sum of large numbers
      result.mean[i] += (frames[f][i] - result.mean[i]) / static_cast<double>(f + 1);
  }
  const auto deviation = [&](std::size_t f, std::size_t i) {
    return frames[f][i] - result.mean[i];
  };
  std::vector<double> per_channel(result.rms.size());
  for (std::size_t i = 0; i < n; ++i) {
    double scale = 0.0;
    for (std::size_t f = 0; f < frames.size(); ++f) scale = std::hypot(scale, deviation(f, i));
    result.reading_rms[i] = scale / std::sqrt(count - 1.0);
    double& pooled = result.rms[where[i].channel];
    pooled = std::hypot(pooled, result.reading_rms[i]);
    per_channel[where[i].channel] += 1.0;
  }
  for (std::size_t c = 0; c < result.rms.size(); ++c) result.rms[c] /= std::sqrt(per_channel[c]);

  // Of standardised deviations: what they share, and what neighbours do.
  double common = 0.0;
  double neighbours = 0.0;
  std::vector<double> z(n);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      z[i] = result.reading_rms[i] > 0.0 ? deviation(f, i) / result.reading_rms[i] : 0.0;
      sum += z[i];
      squares += z[i] * z[i];
    }
    for (const auto& [first, second] : sensor.neighbours) neighbours += z[second] * z[first];
    common += sum * sum - squares;
  }
  const auto size = static_cast<double>(n);
  if (n > 1) result.common_mode = common / ((count - 1.0) * size * (size - 1.0));
  if (!sensor.neighbours.empty())
    result.neighbour_correlation =
        neighbours / (static_cast<double>(sensor.neighbours.size()) * (count - 1.0));
  return result;
}

}  // namespace tactile_net
