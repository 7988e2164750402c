// How often a skin's matrix is copied, with malloc counted: std::vector and Eigen both end there.
#include <atomic>
#include <cstdlib>
#include <limits>
#include <memory>
#include <vector>

#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

namespace {
std::atomic<std::size_t> counted_from{std::numeric_limits<std::size_t>::max()};  // bytes
std::atomic<int> allocations{0};                                                 // as large
}  // namespace

extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  if (size >= counted_from) ++allocations;
  return __libc_malloc(size);
}

using namespace tactile_net;

namespace {

/// How many matrices as large as the problem's kernel were made.
int matrices_made(const LinearProblem& problem, const auto& work) {
  allocations = 0;
  counted_from = sizeof(double) * problem.kernel.values.size();
  work();
  counted_from = std::numeric_limits<std::size_t>::max();
  return allocations;
}

std::shared_ptr<const LinearProblem> shared_problem() {
  return std::make_shared<const LinearProblem>(make_problem(square_skin(8, 2e-3), silicone));
}

}  // namespace

TEST_CASE("a copy of a skin's matrix is counted", "[skin][memory]") {
  const auto problem = shared_problem();
  std::vector<double> copy;
  CHECK(matrices_made(*problem, [&] { copy = problem->kernel.values; }) == 1);
}

TEST_CASE("cones copy a skin's matrix once, and take it into cosines in place", "[skin][memory]") {
  const auto problem = shared_problem();
  REQUIRE(TikhonovFamily(*problem).classes() == 4);  // whose matrices are a quarter as large
  CHECK(matrices_made(*problem, [&] { (void)TikhonovFamily(*problem); }) <= 1);
  CHECK(matrices_made(*problem, [&] {
          const ConeTikhonov cone(*problem, 1e-3, {.nonnegative = true, .friction_limit = 0.5});
          (void)cone.with_alpha(1e-4);
        }) <= 2);
}

TEST_CASE("a judge makes no matrix of its own but those of its cones", "[skin][memory]") {
  const auto problem = shared_problem();
  // Of no contact, so that everything is tried.
  std::vector<double> readings(problem->kernel.rows);
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i] = i % 3 == 0 ? -1.0 : 0.5;
  const std::vector<double> tractions(problem->kernel.columns);
  DataVerdict verdict;
  const int made = matrices_made(*problem, [&] {
    const DataJudge judge(problem, {}, {.noise_rms = 1e-3});
    verdict = judge.judge(readings, tractions);
  });
  CHECK_FALSE(verdict.consistent());
  CHECK(made <= 3);  // the cones' two, and one of the singular values that smoothings are shares of
}
