// A large skin's bands under constraints beside those of the matrix.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/skin/large/cone.hpp"
#include "tactile_net/skin/large/face.hpp"
#include "tactile_net/skin/large/family.hpp"
#include "tactile_net/skin/large/part.hpp"
#include "tests/catch.hpp"
#include "tests/skin/large_skins.hpp"

using namespace tactile_net;

namespace {

/// Cells of a disc about (1 mm, 0), where `readings_of` presses.
std::vector<std::size_t> cells_within(const SurfaceGrid& grid, double radius) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < grid.count(); ++i)
    if (std::hypot(grid.y(i / grid.columns) - 1e-3, grid.z(i % grid.columns)) <= radius)
      cells.push_back(i);
  return cells;
}

/// Of a contact's cells: its force, its drag and a moment.
std::vector<std::vector<double>> sums_over(const LinearProblem& problem,
                                           const std::vector<std::size_t>& cells) {
  const SurfaceGrid& grid = problem.grid;
  std::vector<std::vector<double>> sums(3, std::vector<double>(problem.components * grid.count()));
  for (const std::size_t cell : cells) {
    sums[0][cell] = grid.area();
    sums[1][(problem.components - 1) * grid.count() + cell] = grid.area();
    sums[2][cell] = grid.area() * grid.z(cell % grid.columns);
  }
  return sums;
}

SkinArray oblong_skin() {
  SkinArray skin = square_skin(20, 2e-3);
  skin.columns = 17;
  return skin;
}

struct Solved {
  explicit Solved(std::size_t components = 3) {
    options.components = components;
    dense = make_problem(skin, silicone, options);
    alpha = 1e-4 * size_of(dense);
    readings = readings_of(dense, 5);
    if (components == 3) limits.friction_limit = 0.8;
    found = ConeTikhonov(dense, alpha, limits).solve(readings);
    contact = cells_within(dense.grid, 3e-3);
  }

  SkinArray skin = oblong_skin();
  SkinProblemOptions options = with_dead({50, 51, 128});
  LinearProblem dense{};
  double alpha = 0.0;
  std::vector<double> readings{};
  Constraints limits{.nonnegative = true, .friction_limit = {}};
  ConeSolution found{};
  std::vector<std::size_t> contact{};
};

void check_bands(std::size_t components, double prior_share) {
  const Solved s(components);
  CAPTURE(components, prior_share);
  const TikhonovFamily family(s.dense, s.found.face);
  const double prior = prior_share * s.alpha;
  const TractionCovariance exact(family, s.alpha, prior);
  const TractionCovariance free(TikhonovFamily(s.dense), s.alpha, prior);
  const LargeSkinPart whole(s.skin, silicone, s.options, s.dense, s.contact, 1.0);
  REQUIRE(problem_of(*whole.system()).grid.count() == s.dense.grid.count());
  const LargeSkinFaceCovariance large(whole, whole.face(s.found.face), s.alpha, prior, 1.0, free);
  const auto sums = sums_over(s.dense, s.contact);
  const Matrix expected = exact.covariances(sums);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    CHECK_THAT(large.deviation(sums[i]), WithinRel(exact.deviation(sums[i]), 1e-5));
    CHECK(large.deviation(sums[i]) < free.deviation(sums[i]));
    for (std::size_t j = 0; j < sums.size(); ++j)
      CHECK_THAT(large.covariance(sums[i], sums[j]),
                 WithinAbs(expected(i, j), 1e-5 * std::sqrt(expected(i, i) * expected(j, j))));
  }
  CHECK(large.converged());
  // A part that reaches four depths beyond the contact knows as much.
  const LargeSkinPart part(s.skin, silicone, s.options, s.dense, cells_within(s.dense.grid, 1e-3),
                           8e-3);
  const LargeSkinFaceCovariance local(part, part.face(s.found.face), s.alpha, prior, 1.0, free);
  for (const auto& sum : sums)
    CHECK_THAT(local.deviation(sum), WithinRel(exact.deviation(sum), 0.03));
  // A single cell has what it has without constraints.
  std::vector<double> cell(sums[0].size());
  cell[s.contact.front()] = 2.0;
  CHECK(large.deviation(cell) == free.deviation(cell));
}

}  // namespace

TEST_CASE("a part of a large skin reads what the whole reads of its cells", "[skin][large][face]") {
  const SkinArray skin = oblong_skin();
  const std::size_t stride = GENERATE(std::size_t{1}, std::size_t{2});
  const SkinProblemOptions options =
      with_dead({50, 51, 128}, {.spacing = 1e-3 / static_cast<double>(stride)});
  const LinearProblem whole = make_problem(skin, thin, options);
  const std::vector<std::size_t> corner{0, 1};
  const std::vector<std::size_t> contact = cells_within(whole.grid, 2e-3);
  for (const auto& cells : {corner, contact}) {
    const LargeSkinPart part(skin, thin, options, whole, cells, 3e-3);
    const LinearProblem& own = problem_of(*part.system());
    REQUIRE(own.grid.count() < whole.grid.count());
    CHECK_THAT(own.grid.spacing_y, WithinRel(whole.grid.spacing_y, 1e-12));
    CHECK_THAT(own.measure, WithinRel(whole.measure, 1e-12));
    std::vector<double> tractions(own.components * own.grid.count());
    for (std::size_t i = 0; i < tractions.size(); ++i)
      tractions[i] = std::cos(0.7 * static_cast<double>(i));
    const std::vector<double> all = part.among_all(tractions);
    CHECK(part.tractions(all) == tractions);
    for (const std::size_t cell : cells) {
      REQUIRE(part.has(cell));
      CHECK(all[cell] == tractions[part.cell(cell)]);
    }
    const std::vector<double> expected = part.readings(product(whole.kernel, all));
    CHECK(distance(weighted_product(*part.system(), tractions), expected) < 1e-9 * norm(expected));
  }
  CHECK_THROWS_WITH(LargeSkinPart(skin, thin, options, whole, {}, 1e-3),
                    ContainsSubstring("needs a cell"));
  const std::vector<std::size_t> strange{whole.grid.count()};
  CHECK_THROWS_WITH(LargeSkinPart(skin, thin, options, whole, strange, 1e-3),
                    ContainsSubstring("another grid"));
}

TEST_CASE("on a face a large skin's bands are those of its decomposition", "[skin][large][face]") {
  check_bands(1, 1.0);
  check_bands(3, 0.1);
}

TEST_CASE("the bands on a face are the decomposition's at the other alpha of the prior, too",
          "[skin][large][face][long]") {
  check_bands(1, 0.1);
  check_bands(3, 1.0);
}

TEST_CASE("degrees of freedom on a face are those of its decomposition", "[skin][large][face]") {
  const Solved s;
  const auto system = make_large_skin_system(s.skin, silicone, s.options);
  const LargeSkinFamily large(system, s.found.face);
  const TikhonovFamily dense(s.dense, s.found.face);
  for (const double factor : {1.0, 100.0}) {
    const double expected = dense.degrees_of_freedom(factor * s.alpha);
    const double spread = std::max(large.degrees_deviation(factor * s.alpha), 0.01 * expected);
    CHECK_THAT(large.degrees_of_freedom(factor * s.alpha), WithinAbs(expected, 4.0 * spread));
  }
  CHECK_THROWS_WITH(LargeSkinFamily(system, ActiveFace{}), ContainsSubstring("held at zero"));
}

TEST_CASE("gradients leave free what alternating directions do", "[skin][large][face]") {
  const Solved s(GENERATE(std::size_t{1}, std::size_t{3}));
  const auto system = make_large_skin_system(s.skin, silicone, s.options);
  const ConeSolution large = LargeSkinCone(system, s.alpha, s.limits).solve(s.readings);
  REQUIRE(large.verdict == ConstrainedVerdict::ok);
  // Where a cell hardly touches, the one or the other may hold it.
  const auto few = static_cast<double>(s.found.face.free.size()) / 50.0;
  CHECK_THAT(static_cast<double>(large.face.free.size()),
             WithinAbs(static_cast<double>(s.found.face.free.size()), few));
  for (const ActiveFace::Direction& one : large.face.free)
    CHECK_THAT(std::hypot(one.along[0], one.along[1], one.along[2]), WithinRel(1.0, 1e-12));
}
