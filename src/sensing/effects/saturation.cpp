#include "tactile_net/sensing/effects/saturation.hpp"

#include <vector>

#include "sensing/effects/per_taxel.hpp"

namespace tactile_net {
namespace {

class Limits final : public SensorEffect {
 public:
  Limits(const Saturation& saturation, const SignalLayout& sensor) {
    for (const Site& site : sensor.readings) {
      range_.push_back(value_of(saturation.range, site.quantity, "range"));
      require(range_.back().low < range_.back().high, "range", "begin below its end",
              range_.back().low);
    }
  }
  void apply(const Instant&, std::span<double> readings) override {
    readings_ = readings.size();
    limited_ = 0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const auto [low, high] = range_[i];
      if (readings[i] < low)
        readings[i] = low;
      else if (readings[i] > high)
        readings[i] = high;
      else
        continue;
      ++limited_;
    }
  }
  [[nodiscard]] std::optional<CutOffNote> note() const override {
    if (limited_ == 0) return std::nullopt;
    return CutOffNote{"saturation", limited_, readings_};
  }

 private:
  std::vector<Range> range_;  // per reading
  std::size_t limited_ = 0;
  std::size_t readings_ = 0;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const Saturation& saturation,
                                          const SignalLayout& sensor) {
  return std::make_unique<Limits>(saturation, sensor);
}

}  // namespace tactile_net
