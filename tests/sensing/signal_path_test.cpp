#include "tactile_net/sensing/signal_path.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

/// Adds to every reading, and tells what it saw.
class Adding final : public SensorEffect {
 public:
  Adding(double step, bool memory, std::vector<double>& seen)
      : step_(step), memory_(memory), seen_(seen) {}
  void apply(const Instant&, std::span<double> readings) override {
    seen_.push_back(step_);
    for (double& reading : readings) reading = 2.0 * reading + step_;
  }
  [[nodiscard]] bool has_memory() const noexcept override { return memory_; }
  [[nodiscard]] std::optional<CutOffNote> note() const override {
    return step_ > 2.0 ? std::optional(CutOffNote{"large", 1, 1}) : std::nullopt;
  }

 private:
  double step_;
  bool memory_;
  std::vector<double>& seen_;
};

}  // namespace

TEST_CASE("an empty path changes nothing", "[signal_path]") {
  std::vector<std::unique_ptr<SensorEffect>> absent(1);
  SignalPath path(std::move(absent), 2);
  std::vector<double> readings{1.0, -0.0};
  path.apply({}, readings);
  CHECK(readings[0] == 1.0);
  CHECK(std::signbit(readings[1]));
  CHECK_FALSE(path.has_memory());
  CHECK(path.stages() == 0);
}

TEST_CASE("stages act in their order; between frames only what a memory needs", "[signal_path]") {
  std::vector<double> seen;
  std::vector<std::unique_ptr<SensorEffect>> stages;
  for (const auto& [step, memory] : {std::pair{1.0, false}, {2.0, true}, {3.0, false}})
    stages.push_back(std::make_unique<Adding>(step, memory, seen));
  CHECK(seen.empty());
  SignalPath path(std::move(stages), 2);
  REQUIRE(path.has_memory());
  CHECK(seen == std::vector{1.0, 2.0});  // the unloaded sensor, up to the memory
  std::vector<double> readings{1.0};
  path.apply({.recorded = false}, readings);
  CHECK(seen == std::vector{1.0, 2.0, 1.0, 2.0});
  readings = {1.0};
  path.apply({}, readings);
  CHECK(readings == std::vector{19.0});  // ((1 * 2 + 1) * 2 + 2) * 2 + 3
  REQUIRE(path.notes().size() == 1);     // the others have nothing to say
  CHECK(path.notes()[0].effect == "large");
}
