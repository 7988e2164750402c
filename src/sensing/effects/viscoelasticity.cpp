#include "tactile_net/sensing/effects/viscoelasticity.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "sensing/effects/creep.hpp"
#include "sensing/effects/first_order_lag.hpp"
#include "sensing/effects/per_taxel.hpp"

namespace tactile_net {
namespace {

using Spectrum = std::map<double, double>;  // relaxation time -> fraction > 0

/// The zero of 1 - sum g_i lambda / (lambda - tau_i) between `own` and the next longer relaxation
/// time, as lambda / own - 1: the zero may lie very near.
double zero_beyond(const Spectrum& spectrum, Spectrum::const_iterator own) {
  const double tau = own->first;
  double total = 0.0;
  for (const auto& [time, fraction] : spectrum) total += fraction;
  const auto next = std::next(own);
  double low = 0.0;
  double high = (next == spectrum.end() ? 1.0 / (1.0 - total) : next->first / tau) - 1.0;
  for (int i = 0; i < 200; ++i) {
    const double d = 0.5 * (low + high);
    double value = 1.0 - own->second * (1.0 + d) / d;
    for (auto other = spectrum.begin(); other != spectrum.end(); ++other)
      if (other != own) value -= other->second / (1.0 - other->first / (tau * (1.0 + d)));
    (value < 0.0 ? low : high) = d;
  }
  return high;
}

class Creeping final : public SensorEffect {
 public:
  Creeping(std::vector<CreepTerm> terms, const SignalLayout& sensor) : terms_(std::move(terms)) {
    for (const Channel& channel : sensor.channels)
      if (creeps(channel.quantity))
        blocks_.push_back({channel.first, std::vector<double>(channel.count),
                           std::vector<double>(terms_.size() * channel.count)});
  }
  void rest(std::span<double>) override {}
  void apply(const Instant& at, std::span<double> readings) override {
    std::vector<FirstOrderLag> lags;
    for (const CreepTerm& term : terms_) lags.push_back(first_order_lag(at.since, term.time));
    for (Block& block : blocks_)
      for (std::size_t j = 0; j < block.before.size(); ++j) {
        double& reading = readings[block.first + j];
        const double in = reading;
        for (std::size_t i = 0; i < terms_.size(); ++i) {
          double& state = block.states[j * terms_.size() + i];
          state = lags[i].keep * state + lags[i].before * block.before[j] + lags[i].now * in;
          reading += terms_[i].compliance * state;
        }
        block.before[j] = in;
      }
  }
  [[nodiscard]] bool has_memory() const noexcept override { return true; }

 private:
  struct Block {  // one channel of strains, or of displacements
    std::size_t first = 0;
    std::vector<double> before{};
    std::vector<double> states{};  // count x terms
  };
  std::vector<CreepTerm> terms_;
  std::vector<Block> blocks_;
};

}  // namespace

double relaxation(std::span<const PronyTerm> terms, double t) noexcept {
  double modulus = 1.0;
  for (const PronyTerm& term : terms) modulus += term.fraction * std::expm1(-t / term.time);
  return modulus;
}

std::vector<CreepTerm> creep_terms(std::span<const PronyTerm> terms) {
  double all = 0.0;
  for (const PronyTerm& term : terms) {
    require_not_negative("fraction", term.fraction);
    require_positive("time", term.time);
    all += term.fraction;
  }
  require(all < 1.0, "fractions", "add up to less than 1", all);
  Spectrum spectrum;
  for (const PronyTerm& term : terms)
    if (term.fraction > 0.0) spectrum[term.time] += term.fraction;
  std::vector<CreepTerm> result;
  for (auto own = spectrum.begin(); own != spectrum.end(); ++own) {
    const double d = zero_beyond(spectrum, own);
    const double lambda = own->first * (1.0 + d);
    // The residue: c = lambda / (d/ds of the Carson transform at -1/lambda).
    double slope = 0.0;
    for (auto other = spectrum.begin(); other != spectrum.end(); ++other) {
      const double u = other == own ? d / (1.0 + d) : 1.0 - other->first / lambda;
      slope += other->second * other->first / (u * u);
    }
    result.push_back({lambda / slope, lambda});
  }
  return result;
}

double creep(std::span<const CreepTerm> terms, double t) noexcept {
  double compliance = 1.0;
  for (const CreepTerm& term : terms) compliance -= term.compliance * std::expm1(-t / term.time);
  return compliance;
}

std::unique_ptr<SensorEffect> make_effect(const Viscoelasticity& viscoelasticity,
                                          const SignalLayout& sensor) {
  std::vector<CreepTerm> terms = creep_terms(viscoelasticity.terms);
  const bool any_creeps =
      std::any_of(sensor.channels.begin(), sensor.channels.end(),
                  [](const Channel& channel) { return creeps(channel.quantity); });
  if (terms.empty() || !any_creeps) return nullptr;
  return std::make_unique<Creeping>(std::move(terms), sensor);
}

}  // namespace tactile_net
