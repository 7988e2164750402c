#include "tactile_net/sensing/effects/quantization.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/require.hpp"

namespace tactile_net {
namespace {

class Levels final : public SensorEffect {
 public:
  explicit Levels(const Converter& converter) : converter_(converter) {}
  void apply(const Instant&, std::span<double> readings) override {
    const double step = (converter_.high - converter_.low) / (std::ldexp(1.0, converter_.bits) - 1);
    readings_ = readings.size();
    limited_ = static_cast<std::size_t>(
        std::count_if(readings.begin(), readings.end(), [&](double reading) {
          return reading < converter_.low - 0.5 * step || reading > converter_.high + 0.5 * step;
        }));
    quantize(readings, converter_);
  }
  [[nodiscard]] std::optional<CutOffNote> note() const override {
    if (limited_ == 0) return std::nullopt;
    return CutOffNote{"quantization", limited_, readings_};
  }

 private:
  Converter converter_;
  std::size_t limited_ = 0;
  std::size_t readings_ = 0;
};

}  // namespace

void quantize(std::span<double> readings, const Converter& converter) noexcept {
  const auto [bits, low, high] = converter;
  const double steps = std::ldexp(1.0, bits) - 1.0;
  for (double& reading : readings) {
    const double level = std::round((reading - low) / (high - low) * steps);
    reading = std::lerp(low, high, std::clamp(level, 0.0, steps) / steps);
  }
}

std::unique_ptr<SensorEffect> make_effect(const Converter& converter, const SignalLayout&) {
  require(converter.bits >= 1 && converter.bits <= 32, "bits", "be from 1 to 32", converter.bits);
  require(converter.low < converter.high, "range", "begin below its end", converter.low);
  return std::make_unique<Levels>(converter);
}

}  // namespace tactile_net
