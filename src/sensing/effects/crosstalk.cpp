#include "tactile_net/sensing/effects/crosstalk.hpp"

#include "numeric/require.hpp"

namespace tactile_net {
namespace {

class Leaks final : public SensorEffect {
 public:
  Leaks(double fraction, const SensorArray& array)
      : fraction_(fraction), channels_(channels(array)) {}
  void apply(const Instant&, std::span<double> readings) override {
    for (const Channel& channel : channels_) {
      const auto line = readings.subspan(channel.first, channel.count);
      double from_left = 0.0;
      for (std::size_t j = 0; j < line.size(); ++j) {
        const double to_right = j + 1 < line.size() ? fraction_ * (line[j] - line[j + 1]) : 0.0;
        line[j] += from_left - to_right;
        from_left = to_right;
      }
    }
  }

 private:
  double fraction_;
  std::vector<Channel> channels_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const Crosstalk& crosstalk, const SensorArray& array) {
  const double fraction = crosstalk.fraction;
  require(fraction >= 0.0 && fraction <= 0.5, "fraction", "be from 0 to 0.5", fraction);
  if (fraction == 0.0) return nullptr;
  return std::make_unique<Leaks>(crosstalk.fraction, array);
}

}  // namespace tactile_net
