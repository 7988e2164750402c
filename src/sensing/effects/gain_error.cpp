#include "tactile_net/sensing/effects/gain_error.hpp"

#include "sensing/effects/per_taxel.hpp"
#include "sensing/effects/stream.hpp"

namespace tactile_net {
namespace {

class Gains final : public SensorEffect {
 public:
  Gains(const GainError& error, const SensorArray& array) {
    if (!error.values.empty()) require_one_per_taxel(error.values, array, "values");
    require_not_negative("rms", error.rms);
    for (std::size_t c = 0; c < channel_count(array); ++c) {
      NormalStream draw(error.seed, c, Draws::gain_error);
      for (std::size_t j = 0; j < array.count; ++j)
        factor_.push_back(1.0 + (error.values.empty() ? error.rms * draw() : error.values[j]));
    }
  }
  void apply(const Instant&, std::span<double> readings) override {
    for (std::size_t i = 0; i < readings.size(); ++i) readings[i] *= factor_[i];
  }

 private:
  std::vector<double> factor_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const GainError& error, const SensorArray& array) {
  if (error.rms == 0.0 && all_zero(error.values)) return nullptr;
  return std::make_unique<Gains>(error, array);
}

}  // namespace tactile_net
