#include "tactile_net/sensing/effects/temperature.hpp"

#include <algorithm>
#include <vector>

#include "sensing/effects/per_taxel.hpp"

namespace tactile_net {
namespace {

class Drifting final : public SensorEffect {
 public:
  Drifting(const TemperatureDrift& drift, const SignalLayout& sensor)
      : gain_(drift.gain), change_(drift.change) {
    require(change_.times.size() == change_.values.size() && !change_.times.empty(), "change",
            "hold one value per time, and one at least", change_.values.size());
    for (const Site& site : sensor.readings)
      offset_.push_back(value_of(drift.offset, site.quantity, "offset"));
  }
  void apply(const Instant& at, std::span<double> readings) override {
    const double change = change_(at.time);
    for (std::size_t i = 0; i < readings.size(); ++i)
      readings[i] += change * (gain_ * readings[i] + offset_[i]);
  }

 private:
  double gain_;
  PiecewiseLinear change_;
  std::vector<double> offset_;  // per reading
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const TemperatureDrift& drift,
                                          const SignalLayout& sensor) {
  const bool steady =
      drift.gain == 0.0 && std::all_of(drift.offset.begin(), drift.offset.end(),
                                       [](const auto& offset) { return offset.second == 0.0; });
  if (steady || all_zero(drift.change.values)) return nullptr;
  return std::make_unique<Drifting>(drift, sensor);
}

}  // namespace tactile_net
