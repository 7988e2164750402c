#include "tactile_net/sensing/effects/crosstalk.hpp"

#include <algorithm>
#include <vector>

#include "numeric/require.hpp"

namespace tactile_net {
namespace {

class Leaks final : public SensorEffect {
 public:
  Leaks(double fraction, const SignalLayout& sensor)
      : fraction_(fraction), neighbours_(sensor.neighbours), gains_(sensor.readings.size()) {}
  void apply(const Instant&, std::span<double> readings) override {
    std::fill(gains_.begin(), gains_.end(), 0.0);
    for (const auto& [first, second] : neighbours_) {
      const double flow = fraction_ * (readings[first] - readings[second]);
      gains_[first] -= flow;
      gains_[second] += flow;
    }
    for (std::size_t i = 0; i < readings.size(); ++i) readings[i] += gains_[i];
  }

 private:
  double fraction_;
  std::vector<SignalLayout::Neighbours> neighbours_;
  std::vector<double> gains_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const Crosstalk& crosstalk, const SignalLayout& sensor) {
  const double fraction = crosstalk.fraction;
  const double most = 1.0 / static_cast<double>(sensor.most_neighbours);
  require(fraction >= 0.0 && fraction <= most, "fraction", "be from 0 to " + shortest(most),
          fraction);
  if (fraction == 0.0) return nullptr;
  return std::make_unique<Leaks>(crosstalk.fraction, sensor);
}

}  // namespace tactile_net
