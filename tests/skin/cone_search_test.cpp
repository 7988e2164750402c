#include "inverse/cone/cone_search.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "tests/catch.hpp"
#include "tests/skin/dragged_frame.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

constexpr Constraints held{.friction_limit = 0.8};

}  // namespace

TEST_CASE("a search without taxels is that of the problem which never had them", "[skin][cone]") {
  const bool offsets = GENERATE(false, true);
  const std::vector<std::size_t> gone =
      GENERATE(std::vector<std::size_t>{12}, std::vector<std::size_t>{0, 7, 13});
  CAPTURE(offsets, gone);
  const SkinFrame frame =
      dragged_frame(5, 23, {.channel_rms = {1.0, 0.5, 2.0}, .unknown_offsets = offsets});
  LinearProblem rest = frame.problem;
  leave_out(rest, gone);
  double largest = 0.0;
  for (const double entry : frame.problem.kernel.values)
    largest = std::max(largest, std::abs(entry));
  for (const double share : {1e-1, 1e-3, 1e-5}) {
    const double alpha = share * largest * largest;
    CAPTURE(share);
    std::vector<double> lies = frame.readings;  // what is left out may say anything
    for (std::size_t row = 0; row < lies.size(); ++row)
      if (std::find(gone.begin(), gone.end(), rest.sites[row].taxel) != gone.end())
        lies[row] *= -50.0;
    const ConeSolution expected = ConeSearch(rest, alpha, held).solve(lies, 50000, 1e-11);
    const ConeSolution found =
        ConeSearch(frame.problem, alpha, held).without(gone).solve(lies, 50000, 1e-11);
    REQUIRE(expected.verdict == ConstrainedVerdict::ok);
    REQUIRE(found.verdict == ConstrainedVerdict::ok);
    CHECK(distance(found.tractions, expected.tractions) <= 1e-6 * norm(expected.tractions));
  }
}

TEST_CASE("a search from what is near leads to the same in fewer steps", "[skin][cone]") {
  const SkinFrame frame = dragged_frame(5, 23, {});
  double largest = 0.0;
  for (const double entry : frame.problem.kernel.values)
    largest = std::max(largest, std::abs(entry));
  const ConeSearch whole(frame.problem, 1e-3 * largest * largest, held);
  const std::vector<double> near = whole.solve(frame.readings, 50000, 1e-11).tractions;
  for (const std::size_t taxel : {3u, 12u}) {
    const ConeSearch rest = whole.without(std::span(&taxel, 1));
    const ConeSolution expected = rest.solve(frame.readings, 50000, 1e-11);
    const ConeSolution found = rest.solve(frame.readings, 50000, 1e-11, {}, near);
    CAPTURE(taxel, found.iterations, expected.iterations);
    REQUIRE(found.verdict == ConstrainedVerdict::ok);
    CHECK(distance(found.tractions, expected.tractions) <= 1e-6 * norm(expected.tractions));
    CHECK(found.iterations <= expected.iterations);
  }
  CHECK(whole.solve(frame.readings, 50000, 1e-7, {}, near).iterations == 5);  // the first check
}

TEST_CASE("a search that looks on ends where it is told to", "[skin][cone]") {
  const SkinFrame frame = dragged_frame(5, 23, {});
  const ConeSearch search(frame.problem, 1e-9, held);
  std::size_t looks = 0;
  const auto look = [&](std::size_t last) {
    looks = 0;
    return search.solve(frame.readings, 5000, 1e-15,
                        [&, last](std::span<const double> seen, std::size_t steps) {
                          CHECK(seen.size() == frame.problem.kernel.columns);
                          CHECK(steps == std::size_t{25} << looks);
                          return ++looks == last;
                        });
  };
  CHECK(look(1).iterations == 25);
  CHECK(look(3).iterations == 100);
  CHECK(look(3).verdict == ConstrainedVerdict::iteration_limit);
  const ConeSolution watched = look(1000);
  CHECK(watched.iterations == 5000);
  CHECK(looks == 8);  // 25 to 3200
  CHECK(watched.tractions == search.solve(frame.readings, 5000, 1e-15).tractions);
}
