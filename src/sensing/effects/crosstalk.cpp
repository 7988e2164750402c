#include "tactile_net/sensing/effects/crosstalk.hpp"

#include "numeric/require.hpp"

namespace tactile_net {
namespace {

class Leaks final : public SensorEffect {
 public:
  Leaks(double fraction, std::size_t count) : fraction_(fraction), count_(count) {}
  void apply(const Instant&, std::span<double> readings) override {
    for (; !readings.empty(); readings = readings.subspan(count_)) {
      double from_left = 0.0;
      for (std::size_t j = 0; j < count_; ++j) {
        const double to_right = j + 1 < count_ ? fraction_ * (readings[j] - readings[j + 1]) : 0.0;
        readings[j] += from_left - to_right;
        from_left = to_right;
      }
    }
  }

 private:
  double fraction_;
  std::size_t count_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const Crosstalk& crosstalk, const SensorArray& array) {
  const double fraction = crosstalk.fraction;
  require(fraction >= 0.0 && fraction <= 0.5, "fraction", "be from 0 to 0.5", fraction);
  if (fraction == 0.0) return nullptr;
  return std::make_unique<Leaks>(crosstalk.fraction, array.count);
}

}  // namespace tactile_net
