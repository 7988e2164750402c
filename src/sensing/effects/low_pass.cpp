#include "tactile_net/sensing/effects/low_pass.hpp"

#include <vector>

#include "sensing/effects/first_order_lag.hpp"
#include "sensing/effects/per_taxel.hpp"

namespace tactile_net {
namespace {

class Lagging final : public SensorEffect {
 public:
  explicit Lagging(double time_constant) : time_constant_(time_constant) {}
  void rest(std::span<double> readings) override {
    before_.assign(readings.begin(), readings.end());
    out_ = before_;
  }
  void apply(const Instant& at, std::span<double> readings) override {
    const FirstOrderLag lag = first_order_lag(at.since, time_constant_);
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const double in = readings[i];
      readings[i] = out_[i] = lag.keep * out_[i] + lag.before * before_[i] + lag.now * in;
      before_[i] = in;
    }
  }
  [[nodiscard]] bool has_memory() const noexcept override { return true; }

 private:
  double time_constant_;
  std::vector<double> before_;  // what came in last
  std::vector<double> out_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const LowPass& low_pass, const SignalLayout&) {
  require_not_negative("time_constant", low_pass.time_constant);
  if (low_pass.time_constant == 0.0) return nullptr;
  return std::make_unique<Lagging>(low_pass.time_constant);
}

}  // namespace tactile_net
