#include "tactile_net/sensing/effects/offset_error.hpp"

#include "sensing/effects/per_taxel.hpp"
#include "sensing/effects/stream.hpp"

namespace tactile_net {
namespace {

class Offsets final : public SensorEffect {
 public:
  Offsets(const OffsetError& error, const SignalLayout& sensor) {
    if (!error.values.empty()) {
      offset_ = of_readings(error.values, sensor, "values");
      return;
    }
    for (std::size_t c = 0; const Channel& channel : sensor.channels) {
      NormalStream draw(error.seed, c++, Draws::offset_error);
      const double rms = value_of(error.rms, channel.quantity, "rms");
      require_not_negative("rms", rms);
      for (std::size_t j = 0; j < channel.count; ++j) offset_.push_back(rms * draw());
    }
  }
  void apply(const Instant&, std::span<double> readings) override {
    for (std::size_t i = 0; i < readings.size(); ++i) readings[i] += offset_[i];
  }

 private:
  std::vector<double> offset_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const OffsetError& error, const SignalLayout& sensor) {
  const bool none = std::all_of(error.rms.begin(), error.rms.end(),
                                [](const auto& rms) { return rms.second == 0.0; });
  if (none && all_zero(error.values)) return nullptr;
  return std::make_unique<Offsets>(error, sensor);
}

}  // namespace tactile_net
