#include "tactile_net/sensing/effects/broken_taxels.hpp"

#include <cassert>

#include "sensing/effects/per_taxel.hpp"

namespace tactile_net {
namespace {

void require_taxels(std::span<const std::size_t> indices, const SensorArray& array) {
  for (const std::size_t taxel : indices)
    require(taxel < array.count, "a taxel's index", "be less than their count", taxel);
}

class Stuck final : public SensorEffect {
 public:
  Stuck(const StuckTaxels& stuck, const SensorArray& array) {
    require_taxels(stuck.indices, array);
    for (std::size_t first = 0; const Channel& channel : channels(array)) {
      const std::vector<double>& values = value_of(stuck.values, channel.quantity, "values");
      require(values.size() == stuck.indices.size(), "values", "be as many as indices",
              values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
        stuck_.push_back({first + stuck.indices[i], values[i]});
      first += array.count;
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
  Dead(const DeadTaxels& dead, const SensorArray& array)
      : indices_(dead.indices), count_(array.count) {
    require_taxels(dead.indices, array);
  }
  void apply(const Instant&, std::span<double> readings) override {
    for (; !readings.empty(); readings = readings.subspan(count_))
      kill(readings.first(count_), indices_);
  }

 private:
  std::vector<std::size_t> indices_;
  std::size_t count_;
};

}  // namespace

std::unique_ptr<SensorEffect> make_effect(const StuckTaxels& stuck, const SensorArray& array) {
  if (stuck.indices.empty()) return nullptr;
  return std::make_unique<Stuck>(stuck, array);
}

void kill(std::span<double> readings, std::span<const std::size_t> dead_taxels) noexcept {
  for (const std::size_t taxel : dead_taxels) {
    assert(taxel < readings.size());
    readings[taxel] = 0.0;
  }
}

std::unique_ptr<SensorEffect> make_effect(const DeadTaxels& dead, const SensorArray& array) {
  if (dead.indices.empty()) return nullptr;
  return std::make_unique<Dead>(dead, array);
}

}  // namespace tactile_net
