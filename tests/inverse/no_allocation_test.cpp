// The promise of the per-frame call, held with malloc counted: std::vector and Eigen both end
// there.
#include <atomic>
#include <cstdlib>
#include <vector>

#include "tactile_net/inverse/reconstruction.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"

namespace {
std::atomic<long> allocations{0};
}

extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}

using namespace tactile_net;

TEST_CASE("the counter counts", "[no_allocation]") {
  const long before = allocations;
  std::vector<double>* volatile vector = new std::vector<double>(100);
  const long after = allocations;
  delete vector;
  CHECK(after >= before + 2);
}

TEST_CASE("a frame allocates nothing", "[no_allocation]") {
  const Reconstruction inverse = tikhonov(sample_problems().front().problem, 1e-4);
  const std::vector<double> g = random_values(81, 1);
  std::vector<double> f(81);
  const long before = allocations;
  const FrameStatus status = inverse.solve(g, f);
  const long after = allocations;  // before CHECK, which allocates
  CHECK(status == FrameStatus::ok);
  CHECK(after == before);
}
