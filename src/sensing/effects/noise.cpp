#include "tactile_net/sensing/effects/noise.hpp"

#include <algorithm>
#include <vector>

#include "sensing/effects/per_taxel.hpp"
#include "sensing/effects/stream.hpp"

namespace tactile_net {
namespace {

class Noise final : public SensorEffect {
 public:
  Noise(const NoiseModel& noise, const SignalLayout& sensor) : channels_(sensor.channels) {
    for (const Channel& channel : channels_) {
      rms_.push_back(value_of(noise.rms, channel.quantity, "rms"));
      require_not_negative("rms", rms_.back());
      streams_.emplace_back(noise.seed, streams_.size(), Draws::noise);
    }
  }
  void apply(const Instant&, std::span<double> readings) override {
    for (std::size_t c = 0; c < rms_.size(); ++c)
      for (double& reading : readings.subspan(channels_[c].first, channels_[c].count))
        reading += rms_[c] * streams_[c]();
  }

 private:
  std::vector<Channel> channels_;
  std::vector<double> rms_;
  std::vector<NormalStream> streams_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const NoiseModel& noise, const SignalLayout& sensor) {
  const bool silent = std::all_of(noise.rms.begin(), noise.rms.end(),
                                  [](const auto& rms) { return rms.second == 0.0; });
  return silent ? nullptr : std::make_unique<Noise>(noise, sensor);
}

void add_noise(std::span<double> readings, double rms, std::uint64_t seed, std::size_t channel) {
  NormalStream draw(seed, channel, Draws::noise);
  for (double& reading : readings) reading += rms * draw();
}

}  // namespace tactile_net
