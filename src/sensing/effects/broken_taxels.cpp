#include "tactile_net/sensing/effects/broken_taxels.hpp"

#include <cassert>

#include "sensing/effects/per_taxel.hpp"

namespace tactile_net {
namespace {

void require_taxels(std::span<const std::size_t> indices, const SignalLayout& sensor) {
  for (const std::size_t taxel : indices)
    require(taxel < sensor.taxels, "a taxel's index", "be less than their count", taxel);
}

class Stuck final : public SensorEffect {
 public:
  Stuck(const StuckTaxels& stuck, const SignalLayout& sensor) {
    require_taxels(stuck.indices, sensor);
    for (std::size_t reading = 0; const Site& site : sensor.readings) {
      const std::vector<double>& values = value_of(stuck.values, site.quantity, "values");
      require(values.size() == stuck.indices.size(), "values", "be as many as indices",
              values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
        if (stuck.indices[i] == site.taxel) stuck_.push_back({reading, values[i]});
      ++reading;
    }
  }
  void apply(const Instant&, std::span<double> readings) override {
    for (const auto& [reading, value] : stuck_) readings[reading] = value;
  }

 private:
  struct StuckReading {
    std::size_t reading = 0;
    double value = 0.0;
  };
  std::vector<StuckReading> stuck_;
};

class Dead final : public SensorEffect {
 public:
  Dead(const DeadTaxels& dead, const SignalLayout& sensor) {
    require_taxels(dead.indices, sensor);
    for (std::size_t reading = 0; const Site& site : sensor.readings) {
      if (std::find(dead.indices.begin(), dead.indices.end(), site.taxel) != dead.indices.end())
        readings_.push_back(reading);
      ++reading;
    }
  }
  void apply(const Instant&, std::span<double> readings) override { kill(readings, readings_); }

 private:
  std::vector<std::size_t> readings_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const StuckTaxels& stuck, const SignalLayout& sensor) {
  if (stuck.indices.empty()) return nullptr;
  return std::make_unique<Stuck>(stuck, sensor);
}

void kill(std::span<double> readings, std::span<const std::size_t> dead_taxels) noexcept {
  for (const std::size_t taxel : dead_taxels) {
    assert(taxel < readings.size());
    readings[taxel] = 0.0;
  }
}

std::unique_ptr<SensorEffect> make_effect(const DeadTaxels& dead, const SignalLayout& sensor) {
  if (dead.indices.empty()) return nullptr;
  return std::make_unique<Dead>(dead, sensor);
}

}  // namespace tactile_net
