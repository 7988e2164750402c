// What a host that traps floating-point exceptions would be killed by.
#include <cfenv>
#include <span>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/not_finite.hpp"
#include "tests/realtime/plans.hpp"
#include "tests/realtime/skin_plans.hpp"

using namespace tactile_net;

namespace {

/// Frames of every size, by what is remarkable in them.
std::vector<std::vector<double>> remarkable_frames(std::size_t n) {
  const std::vector<double> good = random_values(n, 3);
  std::vector<std::vector<double>> frames{good, std::vector<double>(n)};
  for (const double size : {4e-320, 1e-160, 1e30, 1e100, 1e150, 1e300, 1e308}) {
    frames.push_back(good);
    for (double& reading : frames.back()) reading *= size;
    frames.push_back(std::vector<double>(n, size));
    frames.push_back(std::vector<double>(n, -size));
    frames.push_back(good);
    frames.back()[n / 3] = size;
  }
  // In the middle of the array, at one end, at both with one sign and with two, and everywhere.
  for (const double bad : {not_a_number, infinite, -infinite}) {
    for (const std::size_t at : {n / 2, n - 1}) {
      frames.push_back(good);
      frames.back()[at] = bad;
    }
    for (const double other : {bad, -bad}) {
      frames.push_back(good);
      frames.back().front() = bad;
      frames.back().back() = other;
    }
    frames.push_back(std::vector<double>(n, bad));
  }
  return frames;
}

/// The exceptions that a call raises.
int raised_by(const auto& call) {
  std::feclearexcept(FE_ALL_EXCEPT);
  call();
  return std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
}

/// As its plan is, with a baseline, without a taxel.
void check_frames(ContactEstimator estimator) {
  const std::size_t n = estimator.readings();
  const std::vector<std::vector<double>> frames = remarkable_frames(n);
  std::vector<double> tractions(2 * estimator.tractions());
  const std::span<double> first = std::span(tractions).first(estimator.tractions());
  const std::span<double> second = std::span(tractions).last(estimator.tractions());
  const auto check_all = [&] {
    int accepted = 0;
    for (std::size_t k = 0; k < frames.size(); ++k) {
      CAPTURE(k);
      ContactEstimate estimate{.tractions = first};
      FrameStatus status = FrameStatus::ok;
      CHECK(raised_by([&] { status = estimator.update(frames[k], estimate); }) == 0);
      accepted += status == FrameStatus::ok ? 1 : 0;

      std::vector<double> both = frames[k];
      both.insert(both.end(), frames[0].begin(), frames[0].end());
      std::vector<ContactEstimate> estimates{{.tractions = first}, {.tractions = second}};
      CHECK(raised_by([&] { (void)estimator.update_batch(both, estimates); }) == 0);
    }
    CHECK(accepted > 10);
  };
  check_all();
  FrameStatus status = FrameStatus::ok;
  for (const std::vector<double>& frame : frames)
    CHECK(raised_by([&] { status = estimator.set_baseline(frame); }) == 0);
  CHECK(status == FrameStatus::not_finite);
  CHECK(raised_by([&] { status = estimator.set_baseline(frames[0]); }) == 0);
  REQUIRE(status == FrameStatus::ok);
  check_all();
  bool died = false;
  CHECK(raised_by([&] { died = estimator.set_dead(1); }) == 0);
  if (died) check_all();
}

}  // namespace

TEST_CASE("no frame of a line raises a floating-point exception", "[floating_point]") {
  for (const Structure structure : {Structure::dense, Structure::low_rank, Structure::reflections,
                                    Structure::reflections_low_rank})
    for (const Precision precision : {Precision::float64, Precision::float32})
      for (const bool diagnostics : {true, false})
        for (const std::size_t unknowns : {1U, 2U}) {
          CAPTURE(name(structure), name(precision), diagnostics, unknowns);
          EstimatorPlan plan = made_plan({.unknowns = unknowns,
                                          .structure = structure,
                                          .precision = precision,
                                          .diagnostics = diagnostics});
          plan.residual_limit = 0.1;
          plan.force_deviation = 0.1;
          plan.traction_limit = 1.0;
          for (const InstructionSet set : {InstructionSet::baseline, widest_instruction_set()}) {
            check_frames(ContactEstimator(plan, set));
            EstimatorPlan bound = plan;
            add_cone(bound, unknowns > 1 ? std::optional(0.5) : std::nullopt);
            check_frames(ContactEstimator(bound, set));
          }
        }
}

TEST_CASE("no frame of a skin raises a floating-point exception", "[floating_point]") {
  for (const Structure structure : {Structure::dense, Structure::reflections})
    for (const Precision precision : {Precision::float64, Precision::float32})
      for (const bool diagnostics : {true, false})
        for (const bool noise_known : {true, false}) {
          CAPTURE(name(structure), name(precision), diagnostics, noise_known);
          EstimatorPlan plan = made_skin_plan(
              {.structure = structure, .precision = precision, .diagnostics = diagnostics});
          plan.residual_limit = 0.1;
          if (noise_known) {
            plan.force_deviation = 0.1;
            plan.cells->deviations.assign(plan.values, 0.5);
            plan.cells->window_deviations.assign(plan.values, 0.5);
            plan.cells->window_rows = plan.cells->window_columns = 1;
          }
          check_frames(ContactEstimator(plan));
          add_cone(plan, 0.5);
          for (const InstructionSet set :
               {InstructionSet::baseline, InstructionSet::avx2, widest_instruction_set()})
            check_frames(ContactEstimator(plan, set));
        }
}
