#include "tactile_net/sensing/effects/sampling.hpp"

#include <vector>

#include "sensing/effects/per_taxel.hpp"

namespace tactile_net {
namespace {

class Window final : public SensorEffect {
 public:
  explicit Window(double aperture) : length_(aperture) {}
  void rest(std::span<double> readings) override {
    before_.assign(readings.begin(), readings.end());
    mean_ = before_;
    open_ = length_;  // the first frame's window lies before the load
  }
  /// The mean so far is moved towards that of the new piece by the piece's share of the time.
  void apply(const Instant& at, std::span<double> readings) override {
    open_ += at.since;
    const double share = open_ > 0.0 ? at.since / open_ : 0.0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const double in = readings[i];
      mean_[i] += share * (0.5 * (before_[i] + in) - mean_[i]);
      before_[i] = in;
      readings[i] = mean_[i];
    }
    if (at.opens) open_ = 0.0;
  }
  [[nodiscard]] bool has_memory() const noexcept override { return true; }

 private:
  double length_;
  double open_ = 0.0;  // how long the window has been open
  std::vector<double> before_;
  std::vector<double> mean_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const Sampling& sampling, const SignalLayout&) {
  require_not_negative("aperture", sampling.aperture);
  if (sampling.aperture == 0.0) return nullptr;
  return std::make_unique<Window>(sampling.aperture);
}

}  // namespace tactile_net
