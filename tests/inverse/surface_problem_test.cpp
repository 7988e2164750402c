// Laws of problems whose tractions lie on a grid of their own.
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/inverse/solutions.hpp"

using namespace tactile_net;

namespace {

/// Random strips somewhere in the middle of the array, 1 % of noise.
class Contacts {
 public:
  explicit Contacts(const SensorArray& array) : array_(array) {}

  struct Pressed {
    RigidContact contact{};
    std::vector<double> readings{};
    double sigma = 0.0;
  };
  Pressed next() {
    const double length = static_cast<double>(array_.count - 1) * array_.pitch;
    Pressed pressed;
    pressed.contact = {.shape = Shape::cylinder,
                       .center = 0.3 * length * uniform(-1.0, 1.0),
                       .half_width = array_.depths.front() * uniform(0.4, 2.0)};
    const std::vector<Contact> all = {pressed.contact};
    pressed.readings = exact_readings(array_, silicone, all);
    double peak = 0.0;
    for (const double reading : pressed.readings) peak = std::max(peak, std::abs(reading));
    pressed.sigma = 0.01 * peak;
    std::normal_distribution<double> noise(0.0, pressed.sigma);
    for (double& reading : pressed.readings) reading += noise(generator_);
    return pressed;
  }

 private:
  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(generator_);
  }
  SensorArray array_;
  std::mt19937 generator_{7};
};

SensorArray array_with_pitch(double pitch_over_depth) {
  const double depth = 1.5e-3;
  return {.count = static_cast<std::size_t>(std::lround(16.0 / pitch_over_depth)) + 1,
          .pitch = pitch_over_depth * depth,
          .depths = {depth},
          .reads = {Quantity::stress_x}};
}

LineProblemOptions on_hats(std::optional<double> spacing = {}) {
  return {.smoothing_length = 1.5e-3, .surface = {.basis = SurfaceBasis::hats, .spacing = spacing}};
}

}  // namespace

TEST_CASE("halving the spacing moves neither alpha, nor the force, nor its band", "[surface]") {
  for (const double ratio : {1.0, 2.0}) {
    const SensorArray array = array_with_pitch(ratio);
    Contacts contacts(array);
    for (int k = 0; k < 5; ++k) {
      const Contacts::Pressed pressed = contacts.next();
      const double spacing = 1.5e-3 / 8.0;
      const EvidenceAnswer first = solve_by_evidence(
          make_problem(array, silicone, on_hats(spacing)), pressed.readings, pressed.sigma);
      const EvidenceAnswer second = solve_by_evidence(
          make_problem(array, silicone, on_hats(0.5 * spacing)), pressed.readings, pressed.sigma);
      CAPTURE(ratio, k, first.alpha, second.alpha);
      CHECK_THAT(second.alpha, WithinRel(first.alpha, 0.02));
      CHECK_THAT(second.contact.normal.value, WithinRel(first.contact.normal.value, 2e-3));
      CHECK_THAT(second.contact.normal.deviation, WithinRel(first.contact.normal.deviation, 0.02));
    }
  }
}

TEST_CASE("a coarse array tells a contact's force, and how well", "[surface]") {
  struct Row {
    double ratio, median, ninth;
  };
  for (const Row& row : {Row{0.5, 0.035, 0.08}, Row{1.0, 0.02, 0.05}, Row{2.0, 0.045, 0.18}}) {
    const SensorArray array = array_with_pitch(row.ratio);
    const LinearProblem problem = make_problem(array, silicone, on_hats());
    Contacts contacts(array);
    std::vector<double> errors;
    int within = 0;
    constexpr int trials = 100;
    for (int k = 0; k < trials; ++k) {
      const Contacts::Pressed pressed = contacts.next();
      const Uncertain force =
          solve_by_evidence(problem, pressed.readings, pressed.sigma).contact.normal;
      const double error = force.value / pressed.contact.force - 1.0;
      errors.push_back(std::abs(error));
      if (std::abs(error) * pressed.contact.force <= 2.0 * force.deviation) ++within;
    }
    std::sort(errors.begin(), errors.end());
    CAPTURE(row.ratio, errors[trials / 2], errors[9 * trials / 10], within);
    CHECK(errors[trials / 2] <= row.median);
    CHECK(errors[9 * trials / 10] <= row.ninth);
    CHECK(within >= 92);
  }
}

TEST_CASE("what no reading shows is as uncertain as the prior says", "[surface]") {
  // Far beyond the last taxel nothing is known: the band there is that of the prior alone.
  const SensorArray array = array_with_pitch(1.0);
  LineProblemOptions options = on_hats();
  options.surface.margin = 60e-3;
  const LinearProblem problem = make_problem(array, silicone, options);
  const double prior = 1e-3;
  const std::vector<double> deviations =
      TractionCovariance(TikhonovFamily(problem), prior, prior).deviations();
  LinearProblem blind = problem;
  for (double& value : blind.kernel.values) value = 0.0;
  const std::vector<double> none =
      TractionCovariance(TikhonovFamily(blind), prior, prior).deviations();
  CHECK_THAT(deviations.front(), WithinRel(none.front(), 1e-3));
  CHECK(deviations[deviations.size() / 2] < 0.5 * none[none.size() / 2]);
}
