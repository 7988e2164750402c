#include "tactile_net/sensing/effects/hysteresis.hpp"

#include <algorithm>

#include "sensing/effects/per_taxel.hpp"

namespace tactile_net {
namespace {

class Plays final : public SensorEffect {
 public:
  Plays(const Hysteresis& hysteresis, const SignalLayout& sensor)
      : weights_(hysteresis.weights), channel_(channel_of_readings(sensor)) {
    double all = 0.0;
    for (const double weight : weights_) {
      require_positive("weight", weight);
      all += weight;
    }
    require(all <= 1.0 + 1e-12, "weights", "add up to 1 at most", all);
    for (const Channel& channel : sensor.channels) {
      thresholds_.push_back(value_of(hysteresis.thresholds, channel.quantity, "thresholds"));
      require(thresholds_.back().size() == weights_.size(), "thresholds", "be as many as weights",
              thresholds_.back().size());
      for (const double threshold : thresholds_.back())
        require_not_negative("threshold", threshold);
    }
    plays_.assign(channel_.size() * weights_.size(), 0.0);
  }
  void rest(std::span<double>) override {}
  void apply(const Instant&, std::span<double> readings) override {
    auto play = plays_.begin();
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const std::vector<double>& thresholds = thresholds_[channel_[i]];
      const double in = readings[i];
      for (std::size_t k = 0; k < weights_.size(); ++k, ++play) {
        *play = std::clamp(*play, in - thresholds[k], in + thresholds[k]);
        readings[i] += weights_[k] * (*play - in);
      }
    }
  }
  [[nodiscard]] bool has_memory() const noexcept override { return true; }

 private:
  std::vector<double> weights_;
  std::vector<std::size_t> channel_;             // per reading
  std::vector<std::vector<double>> thresholds_;  // per channel
  std::vector<double> plays_;                    // readings x operators
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const Hysteresis& hysteresis,
                                          const SignalLayout& sensor) {
  if (all_zero(hysteresis.thresholds)) return nullptr;
  return std::make_unique<Plays>(hysteresis, sensor);
}

}  // namespace tactile_net
