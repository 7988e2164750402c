#include "tactile_net/sensing/effects/quantization.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sensing/effects/per_taxel.hpp"

namespace tactile_net {
namespace {

struct Converter {
  int bits;
  double low, high;
};

double step_of(const Converter& converter) {
  return (converter.high - converter.low) / (std::ldexp(1.0, converter.bits) - 1.0);
}

void quantize(std::span<double> readings, const Converter& converter) noexcept {
  const auto [bits, low, high] = converter;
  const double steps = std::ldexp(1.0, bits) - 1.0;
  for (double& reading : readings) {
    const double level = std::round((reading - low) / (high - low) * steps);
    reading = std::lerp(low, high, std::clamp(level, 0.0, steps) / steps);
  }
}

class Levels final : public SensorEffect {
 public:
  Levels(std::vector<Channel> channels, std::vector<Converter> converters)
      : channels_(std::move(channels)), converters_(std::move(converters)) {
    for (const auto& [bits, low, high] : converters_) {
      require(bits >= 1 && bits <= 32, "bits", "be from 1 to 32", bits);
      require(low < high, "range", "begin below its end", low);
    }
  }
  void apply(const Instant&, std::span<double> readings) override {
    readings_ = readings.size();
    limited_ = 0;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const auto own = readings.subspan(channels_[c].first, channels_[c].count);
      const auto& [bits, low, high] = converters_[c];
      const double step = step_of(converters_[c]);
      limited_ += static_cast<std::size_t>(
          std::count_if(own.begin(), own.end(),
                        [lowest = low - 0.5 * step, highest = high + 0.5 * step](double reading) {
                          return reading < lowest || reading > highest;
                        }));
      quantize(own, converters_[c]);
    }
  }
  [[nodiscard]] std::optional<CutOffNote> note() const override {
    if (limited_ == 0) return std::nullopt;
    return CutOffNote{"quantization", limited_, readings_};
  }

 private:
  std::vector<Channel> channels_;
  std::vector<Converter> converters_;  // of each channel
  std::size_t limited_ = 0;
  std::size_t readings_ = 0;
};

}  // namespace

double step(const Quantization& quantization, Quantity quantity) {
  const auto& [low, high] = quantization.range.at(quantity);
  return step_of({quantization.bits, low, high});
}

std::unique_ptr<SensorEffect> make_effect(const Quantization& quantization,
                                          const SignalLayout& sensor) {
  std::vector<Converter> converters;
  for (const Channel& channel : sensor.channels) {
    const auto& [low, high] = value_of(quantization.range, channel.quantity, "range");
    converters.push_back({quantization.bits, low, high});
  }
  return std::make_unique<Levels>(sensor.channels, std::move(converters));
}

}  // namespace tactile_net
