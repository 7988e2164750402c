#include "tactile_net/sensing/effects/gain_error.hpp"

#include "sensing/effects/per_taxel.hpp"
#include "sensing/effects/stream.hpp"

namespace tactile_net {
namespace {

class Gains final : public SensorEffect {
 public:
  Gains(const GainError& error, const SignalLayout& sensor) {
    if (!error.values.empty()) require_one_per_taxel(error.values, sensor, "values");
    require_not_negative("rms", error.rms);
    std::vector<NormalStream> draws;  // per channel
    for (const Site& site : sensor.readings) {
      if (site.channel == draws.size())
        draws.emplace_back(error.seed, site.channel, Draws::gain_error);
      factor_.push_back(
          1.0 + (error.values.empty() ? error.rms * draws.back()() : error.values[site.taxel]));
    }
  }
  void apply(const Instant&, std::span<double> readings) override {
    for (std::size_t i = 0; i < readings.size(); ++i) readings[i] *= factor_[i];
  }

 private:
  std::vector<double> factor_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const GainError& error, const SignalLayout& sensor) {
  if (error.rms == 0.0 && all_zero(error.values)) return nullptr;
  return std::make_unique<Gains>(error, sensor);
}

}  // namespace tactile_net
