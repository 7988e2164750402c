#include "tactile_net/sensing/effects/taxel_noise.hpp"

#include "sensing/effects/per_taxel.hpp"
#include "sensing/effects/stream.hpp"

namespace tactile_net {
namespace {

class NoiseOfTaxels final : public SensorEffect {
 public:
  NoiseOfTaxels(const TaxelNoise& noise, const SignalLayout& sensor)
      : rms_(of_readings(noise.rms, sensor, "rms")), channel_(channel_of_readings(sensor)) {
    for (const double rms : rms_) require_not_negative("rms", rms);
    for (std::size_t c = 0; c < sensor.channels.size(); ++c)
      streams_.emplace_back(noise.seed, c, Draws::taxel_noise);
  }
  void apply(const Instant&, std::span<double> readings) override {
    for (std::size_t i = 0; i < readings.size(); ++i)
      readings[i] += rms_[i] * streams_[channel_[i]]();
  }

 private:
  std::vector<double> rms_;
  std::vector<std::size_t> channel_;  // per reading
  std::vector<NormalStream> streams_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const TaxelNoise& noise, const SignalLayout& sensor) {
  if (all_zero(noise.rms)) return nullptr;
  return std::make_unique<NoiseOfTaxels>(noise, sensor);
}

}  // namespace tactile_net
