// What stands on an FFT allocates nothing in a frame.
#include "src/control/circulant.hpp"
#include "src/numeric/real_fft.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"
#include "tests/counted_malloc.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;

namespace {

ProductPlan convolution_of(std::size_t size) {
  const std::size_t n = size / 2;
  ProductPlan plan{.structure = Structure::fft, .rows = n, .columns = n};
  plan.row_grid = plan.column_grid = line_blocks(n, {1});
  for (const std::size_t part : class_sizes(plan.row_grid)) {
    const std::size_t rank = part > 0 ? 1 : 0;
    plan.factors.push_back({rank, part, std::vector<double>(part, 0.0)});
    plan.factors.push_back({part, rank, std::vector<double>(part, 0.0)});
  }
  plan.transform_size = size;
  plan.spectra.assign(size / 2 + 1, 1.0);
  return plan;
}

}  // namespace

TEST_CASE("a convolution by FFT allocates nothing for any size without a prime factor above 7",
          "[fft][no_allocation]") {
  int tested = 0;
  for (std::size_t size = 4; size <= 32768; size = RealFft::fast_size(size + 1)) {
    const auto convolution = fft_convolutions()(convolution_of(size));
    std::vector<double> x(size / 2, 1.0);
    std::vector<double> y(size / 2);
    const long allocated = allocations_of([&] { convolution->add(x.data(), y.data()); });
    CAPTURE(size);
    CHECK(allocated == 0);
    ++tested;
  }
  CHECK(tested > 300);
}

TEST_CASE("nor with plans that were measured, for the sizes that the planner takes",
          "[fft][no_allocation]") {
  for (std::size_t size = 4; size <= 1280; size = transform_size(size + 1)) {
    const auto convolution = fft_convolutions(FftEffort::measure)(convolution_of(size));
    std::vector<double> x(size / 2, 1.0);
    std::vector<double> y(size / 2);
    const long allocated = allocations_of([&] { convolution->add(x.data(), y.data()); });
    CAPTURE(size);
    CHECK(allocated == 0);
  }
}

TEST_CASE("a frame of a plan by FFT allocates nothing, nor does a dead taxel",
          "[fft][no_allocation]") {
  using enum Quantity;
  const LinearProblem problem = make_problem({96, 0.125, {1.5}, {stress_x, shear_xy}}, {1.0, 0.45},
                                             {.unknowns = 2, .smoothing_length = 1.0});
  PlannerOptions options{.structure = Structure::fft};
  ContactEstimator estimator(plan_estimator(problem, 1e-4, options).plan, fft_convolutions());
  const std::vector<double> g = random_values(192, 1);
  std::vector<double> f(192);
  ContactEstimate estimate{.tractions = f};
  bool done = true;
  const long allocated = allocations_of([&] {
    done &= estimator.update(g, estimate) == FrameStatus::ok;
    done &= estimator.set_dead(40);
    done &= estimator.update(g, estimate) == FrameStatus::ok;
  });
  CHECK(done);
  CHECK(allocated == 0);
}
