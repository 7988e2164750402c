#include "tactile_net/skin/resultant.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>

#include "realtime/touching_cells.hpp"
#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

std::vector<std::size_t> all_cells(const SurfaceGrid& grid) {
  std::vector<std::size_t> cells(grid.count());
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  return cells;
}

/// Every traction errs by itself, by as much as it says.
class White final : public Covariance {
 public:
  explicit White(std::size_t count) : count_(count) {}
  [[nodiscard]] std::vector<double> deviations() const override {
    return std::vector<double>(count_, 1.0);
  }
  [[nodiscard]] double deviation(std::span<const double> weights) const override {
    return norm(weights);
  }
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  }
  [[nodiscard]] double degrees_of_freedom() const noexcept override { return 0.0; }

 private:
  std::size_t count_;
};

}  // namespace

TEST_CASE("several sums at once err as each by itself, whatever they are over",
          "[skin][covariance]") {
  const LinearProblem problem =
      make_problem(square_skin(4, 2e-3), silicone, {.tangential_weight = 2.0});
  const std::size_t cells = problem.grid.count();
  const std::size_t n = 3 * cells;
  const TikhonovFamily family(problem);
  const TractionCovariance covariance(family, 1e-3, 1e-2);  // more tractions than readings
  std::vector<std::vector<double>> sums(6, std::vector<double>(n));
  for (std::size_t i = 0; i < cells; ++i) sums[0][i] = 1e-6;  // a force
  sums[1][7] = 0.8;                                           // the margin of a cell
  sums[1][cells + 7] = -0.6;
  sums[1][2 * cells + 7] = 0.3;
  sums[2][3] = 1e200;             // whose square is no number
  sums[3][5] = sums[3][6] = 1.0;  // two cells of one component
  for (std::size_t i = 0; i < n; ++i) sums[5][i] = static_cast<double>(i % 7) - 3.0;
  const std::vector<double> deviations = covariance.deviations_of(sums);
  REQUIRE(deviations.size() == sums.size());
  for (std::size_t k = 0; k < sums.size(); ++k) {
    CAPTURE(k);
    CHECK_THAT(deviations[k], WithinRel(covariance.deviation(sums[k]), 1e-10));
  }
  CHECK(deviations[4] == 0.0);

  sums[2][3] = 1.0;
  const Matrix joint = covariance.covariances(sums);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    CHECK_THAT(std::sqrt(joint(i, i)), WithinRel(covariance.deviation(sums[i]), 1e-10));
    for (std::size_t j = 0; j < sums.size(); ++j) {
      // (a + b)' C (a + b) by itself tells a' C b.
      std::vector<double> both(n);
      for (std::size_t m = 0; m < n; ++m) both[m] = sums[i][m] + sums[j][m];
      const double together = std::pow(covariance.deviation(both), 2);
      CHECK_THAT(joint(i, i) + joint(j, j) + 2.0 * joint(i, j),
                 WithinRel(together, 1e-9) || WithinAbs(together, 1e-12 * joint(5, 5)));
    }
  }
  CHECK_THROWS_AS(covariance.deviations_of(std::vector<std::vector<double>>{{1.0, 1.0}}),
                  std::invalid_argument);
}

TEST_CASE("what a family keeps for bands serves every alpha, and changes none",
          "[skin][covariance]") {
  const LinearProblem problem = make_problem(square_skin(4, 2e-3), silicone, {});
  const TikhonovFamily used(problem);
  (void)TractionCovariance(used, 1e-5, 1e-1).deviations();
  const TikhonovFamily fresh(problem);
  CHECK(TractionCovariance(used, 1e-3, 1e-2).deviations() ==
        TractionCovariance(fresh, 1e-3, 1e-2).deviations());
}

TEST_CASE("two deviations hold about the share of the truth that they promise",
          "[skin][covariance]") {
  const SkinArray skin = square_skin(10, 3e-3);
  const LinearProblem problem = make_problem(skin, silicone);
  const TikhonovFamily family(problem);
  const AlphaTables tables(family.singular_values(), independent_readings(problem));
  const SurfaceGrid& grid = problem.grid;
  std::mt19937 random(44);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double covered = 0.0;
  double constrained = 0.0;
  double count = 0.0;
  for (int contact = 0; contact < 8; ++contact) {
    const std::vector<SkinLoad> loads = random_contacts(random, 5e-3);
    const std::vector<double> truth = cell_means(loads, grid);
    std::vector<double> readings = exact_readings(skin, silicone, loads);
    const double rms = add_noise(readings, 1e-3 * std::pow(50.0, unit(random)), random);
    const FilterFrame frame = family.analyse(readings);
    const double alpha = choose_alone(frame, tables, AlphaRule::rgcv).alpha;
    const auto share = [&](const TikhonovFamily& of, double at, std::span<const double> f) {
      const FilterFrame seen = of.analyse(readings);
      const TractionCovariance covariance(of, at, choose_alone(seen, AlphaRule::gml).alpha);
      const double noise =
          estimate_noise(problem, readings, f, covariance.degrees_of_freedom(), rms).rms();
      const std::vector<double> deviations = covariance.deviations();
      double inside = 0.0;
      for (std::size_t i = 0; i < f.size(); ++i) {
        const std::size_t row = i % grid.count() / grid.columns;
        const std::size_t column = i % grid.columns;
        // Beyond the taxels the bands are the prior's, and hold whatever is there.
        if (row < grid.margin_rows || row >= grid.rows - grid.margin_rows ||
            column < grid.margin_columns || column >= grid.columns - grid.margin_columns)
          continue;
        inside += std::abs(f[i] - truth[i]) <= 2.0 * deviations[i] * noise;
        if (&of == &family) ++count;
      }
      return inside;
    };
    covered += share(family, alpha, family.solve(frame, alpha));
    const double less = constrained_alpha(AlphaRule::rgcv, alpha);
    const ConeSolution found = ConeTikhonov(problem, less, {.friction_limit = 0.8}).solve(readings);
    constrained += share(TikhonovFamily(problem, found.face), less, found.tractions);
  }
  CHECK(covered / count >= 0.95);
  CHECK(covered / count <= 0.998);
  CHECK(constrained / count >= 0.93);
}

TEST_CASE("forces, centre and torsion of cells' means are the load's own",
          "[skin][resultant][property]") {
  const SurfaceGrid grid = make_problem(square_skin(12, 2e-3), silicone).grid;
  const std::vector<SkinLoad> loads{SkinContact{.y = 0.7e-3,
                                                .z = -1.2e-3,
                                                .radius = 3e-3,
                                                .force = 0.4,
                                                .friction = 0.3,
                                                .direction = 2.0,
                                                .torsion = 1e-4}};
  const std::vector<double> means = cell_means(loads, grid);
  const White white(means.size());
  const std::vector<std::size_t> cells = all_cells(grid);
  const UncertainWrench found = resultant_of(grid, means, cells, white, 2.0);
  const SkinWrench expected = resultant(loads);
  CHECK_THAT(found.normal.value, WithinRel(expected.force[0], 1e-12));
  CHECK_THAT(found.tangential_y->value, WithinRel(expected.force[1], 1e-12));
  CHECK_THAT(found.tangential_z->value, WithinRel(expected.force[2], 1e-12));
  CHECK_THAT(found.centre_y->value, WithinAbs(0.7e-3, 2e-5));
  CHECK_THAT(found.centre_z->value, WithinAbs(-1.2e-3, 2e-5));
  CHECK_THAT(found.torsion->value, WithinRel(1e-4, 0.03));
  CHECK_THAT(found.normal.deviation,
             WithinRel(2.0 * grid.area() * std::sqrt(static_cast<double>(cells.size())), 1e-12));
  CHECK_THAT(found.covariance[0], WithinRel(std::pow(found.normal.deviation, 2), 1e-12));

  // Deviations are slopes: a step along each gradient, by differences.
  std::mt19937 random(6);
  std::normal_distribution<double> value;
  std::vector<double> step(means.size()), moved = means, back = means;
  for (double& one : step) one = value(random);
  const double size = 1e-3;
  for (std::size_t i = 0; i < means.size(); ++i) {
    moved[i] += size * step[i];
    back[i] -= size * step[i];
  }
  class Along final : public Covariance {
   public:
    explicit Along(std::vector<double> step) : step_(std::move(step)) {}
    [[nodiscard]] std::vector<double> deviations() const override { return step_; }
    [[nodiscard]] double deviation(std::span<const double> weights) const override {
      return std::inner_product(weights.begin(), weights.end(), step_.begin(), 0.0);
    }
    [[nodiscard]] double covariance(std::span<const double> a,
                                    std::span<const double> b) const override {
      return deviation(a) * deviation(b);
    }
    [[nodiscard]] double degrees_of_freedom() const noexcept override { return 0.0; }

   private:
    std::vector<double> step_;
  } const along(step);
  const auto slope = [&](const auto& of) {
    return (of(std::span<const double>(moved)) - of(std::span<const double>(back))) / (2.0 * size);
  };
  const auto wrench = [&](std::span<const double> f) {
    return resultant_of(grid, f, cells, along, 1.0);
  };
  const UncertainWrench rates = wrench(means);
  CHECK_THAT(rates.centre_y->deviation,
             WithinRel(slope([&](auto f) { return wrench(f).centre_y->value; }), 1e-6));
  CHECK_THAT(rates.centre_z->deviation,
             WithinRel(slope([&](auto f) { return wrench(f).centre_z->value; }), 1e-6));
  CHECK_THAT(rates.torsion->deviation,
             WithinRel(slope([&](auto f) { return wrench(f).torsion->value; }), 1e-6));
  const auto friction = [&](std::span<const double> f) {
    return *friction_of(grid, f, cells, along, 1.0, 0.5);
  };
  CHECK_THAT(friction(means).ratio.deviation,
             WithinRel(slope([&](auto f) { return friction(f).ratio.value; }), 1e-6));
  const auto ellipse = [&](std::span<const double> f) {
    return *contact_ellipse(grid, f, cells, along, 1.0);
  };
  CHECK_THAT(ellipse(means).radius.deviation,
             WithinRel(slope([&](auto f) { return ellipse(f).radius.value; }), 1e-5));
  CHECK_THAT(ellipse(means).second_radius.deviation,
             WithinRel(slope([&](auto f) { return ellipse(f).second_radius.value; }), 1e-5));
  CHECK_THAT(ellipse(means).angle.deviation,
             WithinRel(slope([&](auto f) { return ellipse(f).angle.value; }), 1e-4));
}

TEST_CASE("friction: what slides is at its limit, what is twisted is too", "[skin][resultant]") {
  const SurfaceGrid grid = make_problem(square_skin(16, 2e-3), silicone).grid;
  const std::vector<std::size_t> cells = all_cells(grid);
  const White white(3 * grid.count());
  const auto friction = [&](const SkinContact& contact, std::optional<double> limit) {
    const std::vector<SkinLoad> loads{contact};
    return *friction_of(grid, cell_means(loads, grid), cells, white, 1.0, limit);
  };
  const SkinFriction slides =
      friction({.radius = 4e-3, .force = 0.5, .friction = 0.4, .direction = 0.7}, 0.4);
  CHECK_THAT(slides.ratio.value, WithinRel(0.4, 1e-12));
  CHECK_THAT(slides.least_limit.value, WithinRel(0.4, 1e-9));
  CHECK_THAT(slides.slip_margin->value, WithinAbs(0.0, 1e-3));
  for (const Uncertain& margin : slides.cell_margins) CHECK(margin.value >= -1e-9);
  // All cells have the same |q| / p: none of them is chosen by rounding.
  std::vector<double> means =
      cell_means(std::vector<SkinLoad>{SkinContact{
                     .radius = 4e-3, .force = 0.5, .friction = 0.4, .direction = 0.7}},
                 grid);
  for (std::size_t i = 0; i < means.size(); ++i)
    means[i] *= 1.0 + 1e-12 * std::sin(static_cast<double>(i * i));
  CHECK_THAT(friction_of(grid, means, cells, white, 1.0, 0.4)->least_limit.deviation,
             WithinRel(slides.least_limit.deviation, 1e-6));
  // Full spin of a Hertz circle: mu F 3 pi a / 16.
  CHECK_THAT(slides.lever, WithinRel(0.5 * 3.0 * std::numbers::pi * 4e-3 / 16.0, 0.02));
  const SkinFriction rests = friction({.radius = 4e-3, .force = 0.5}, 0.4);
  CHECK_THAT(rests.slip_margin->value, WithinAbs(1.0, 1e-3));
  CHECK_FALSE(friction({.radius = 4e-3, .force = 0.5}, {}).slip_margin.has_value());
  CHECK_FALSE(
      friction_of(grid, std::vector<double>(3 * grid.count()), cells, white, 1.0).has_value());
  CHECK_THROWS_WITH(friction({}, 0.0), ContainsSubstring("limit"));
}

TEST_CASE("of contacts that lie apart friction is that of the one nearest to slipping",
          "[skin][resultant]") {
  const SurfaceGrid grid = make_problem(square_skin(16, 2e-3), silicone).grid;
  const White white(3 * grid.count());
  constexpr double limit = 0.4;
  const SkinContact left{.y = -4e-3, .radius = 2.5e-3, .force = 0.5, .friction = 0.36};
  const auto friction = [&](const std::vector<SkinLoad>& loads, std::optional<double> mu) {
    const std::vector<double> means = cell_means(loads, grid);
    std::vector<std::size_t> cells;
    for (std::size_t cell = 0; cell < grid.count(); ++cell)
      if (means[cell] > 0.0) cells.push_back(cell);
    return *friction_of(grid, means, cells, white, 1.0, mu);
  };
  const auto check_same = [](const SkinFriction& found, const SkinFriction& alone) {
    CHECK_THAT(found.ratio.value, WithinRel(alone.ratio.value, 1e-9));
    CHECK_THAT(found.ratio.deviation, WithinRel(alone.ratio.deviation, 1e-9));
    CHECK_THAT(found.least_limit.value, WithinRel(alone.least_limit.value, 1e-9));
    CHECK_THAT(found.lever, WithinRel(alone.lever, 1e-9));
    REQUIRE(found.slip_margin.has_value() == alone.slip_margin.has_value());
    if (!alone.slip_margin) return;
    CHECK_THAT(found.slip_margin->value, WithinRel(alone.slip_margin->value, 1e-9));
    CHECK_THAT(found.slip_margin->deviation, WithinRel(alone.slip_margin->deviation, 1e-9));
  };
  const SkinFriction alone = friction({left}, limit);
  CHECK(alone.contacts == 1);
  CHECK_FALSE(alone.wrench);
  CHECK(alone.lever == alone.lever_of_all);
  CHECK_THAT(alone.slip_margin->value, WithinAbs(0.1, 1e-3));
  // Dragged apart: their sum is dragged nowhere.
  SkinContact right = left;
  right.y = -left.y;
  right.direction = std::numbers::pi;
  const SkinFriction apart = friction({left, right}, limit);
  check_same(apart, alone);
  CHECK(apart.contacts == 2);
  // A stronger one that is held well, and one that is nothing beside it.
  right.force = 4.0;
  right.friction = 0.1;
  const SkinFriction weaker = friction({left, right}, limit);
  check_same(weaker, alone);
  REQUIRE(weaker.wrench);
  CHECK_THAT(weaker.wrench->centre_y->value, WithinAbs(left.y, 1e-4));
  CHECK_THAT(weaker.wrench->normal.value, WithinRel(left.force, 1e-9));
  CHECK_THAT(weaker.ratio.value, WithinRel(weaker.wrench->tangential_y->value / left.force, 1e-9));
  right.force = 50.0;
  CHECK(friction({left, right}, limit).contacts == 1);
  // Torsion counts against a limit.
  right.force = 0.5;
  right.torsion = 0.95 * limit * alone.lever;
  CHECK_THAT(friction({left, right}, limit).wrench->centre_y->value, WithinAbs(right.y, 1e-4));
  check_same(friction({left, right}, {}), friction({left}, {}));
}

TEST_CASE("patches that a loop numbers are the contacts that a solver tells apart",
          "[skin][resultant]") {
  std::mt19937 random(4);
  for (int mask = 0; mask < 200; ++mask) {
    const SurfaceGrid grid{
        .rows = 1 + random() % 9, .columns = 1 + random() % 9, .spacing_y = 1.0, .spacing_z = 1.0};
    std::vector<std::uint8_t> marks(grid.count());
    std::vector<std::size_t> cells;
    const unsigned share = 1 + static_cast<unsigned>(random() % 5);
    for (std::size_t cell = 0; cell < grid.count(); ++cell)
      if (random() % 6 < share) {
        marks[cell] = 1;
        cells.push_back(cell);
      }
    std::vector<std::uint32_t> labels(grid.count());
    const std::size_t count =
        label_patches({grid.rows, grid.columns, 0, 0}, marks.data(), labels.data());
    std::vector<std::vector<std::size_t>> patches(count);
    for (const std::size_t cell : cells) patches.at(labels[cell]).push_back(cell);
    // Without any force they are in the order of their first cells, as the labels.
    CHECK(patches == separate_contacts(grid, std::vector<double>(grid.count()), cells));
    CHECK(count <= ((grid.rows + 1) / 2) * ((grid.columns + 1) / 2));
  }
}

TEST_CASE("a contact's ellipse has its radii by its law", "[skin][resultant]") {
  const SurfaceGrid grid = make_problem(square_skin(20, 2e-3), silicone).grid;
  const std::vector<std::size_t> cells = all_cells(grid);
  const White white(3 * grid.count());
  const std::vector<SkinLoad> loads{SkinContact{.shape = SkinShape::ellipsoid,
                                                .radius = 6e-3,
                                                .second_radius = 3.5e-3,
                                                .angle = 0.4,
                                                .force = 1.0}};
  const ContactEllipse found =
      *contact_ellipse(grid, cell_means(loads, grid), cells, white, 1.0, PressureLaw::hertz);
  CHECK_THAT(found.radius.value, WithinRel(6e-3, 0.01));
  CHECK_THAT(found.second_radius.value, WithinRel(3.5e-3, 0.03));
  CHECK_THAT(found.angle.value, WithinAbs(0.4, 0.01));
  const std::vector<SkinLoad> punch{
      SkinContact{.shape = SkinShape::punch, .radius = 5e-3, .force = 1.0}};
  const ContactEllipse flat =
      *contact_ellipse(grid, cell_means(punch, grid), cells, white, 1.0, PressureLaw::punch);
  CHECK_THAT(flat.radius.value, WithinRel(5e-3, 0.02));
  CHECK_THAT(flat.second_radius.value, WithinRel(flat.radius.value, 1e-9));
  CHECK_FALSE(contact_ellipse(grid, std::vector<double>(3 * grid.count()), cells, white, 1.0));
}

TEST_CASE("cells of contacts are patches with a peak, and their rim", "[skin][resultant]") {
  const SurfaceGrid grid{.rows = 6, .columns = 7, .spacing_y = 1.0, .spacing_z = 1.0};
  std::vector<double> p(42);
  const std::vector<double> deviations(42, 1.0);
  const auto at = [&](std::size_t row, std::size_t column) -> double& {
    return p[7 * row + column];
  };
  at(1, 1) = 5.0;  // a peak
  at(2, 2) = 2.5;  // touches it by a corner
  at(4, 5) = 3.0;  // not certain
  at(5, 0) = -9.0;
  CHECK(contact_cells(grid, p, deviations) == std::vector<std::size_t>{8, 16});
  at(4, 5) = 30.0;
  CHECK(contact_cells(grid, p, deviations) == std::vector<std::size_t>{8, 16, 33});
  CHECK(contact_cells(grid, p, deviations, 1.0).size() == 14 + 9);
  const auto apart = separate_contacts(grid, p, contact_cells(grid, p, deviations));
  REQUIRE(apart.size() == 2);
  CHECK(apart[0] == std::vector<std::size_t>{33});
  CHECK(apart[1] == std::vector<std::size_t>{8, 16});
  CHECK(contact_cells(grid, std::vector<double>(42), deviations).empty());
  CHECK_THROWS_WITH(contact_cells(grid, p, std::vector<double>(3)), ContainsSubstring("per cell"));
  CHECK_THROWS_WITH(contact_cells(grid, p, deviations, -1.0), ContainsSubstring("rim"));

  const White white(42);
  const UncertainWrench pressed =
      resultant_of(grid, p, contact_cells(grid, p, deviations), white, 1.0);
  CHECK(pressed.normal.value == 37.5);
  CHECK_FALSE(pressed.torsion.has_value());
  CHECK_FALSE(friction_of(grid, p, all_cells(grid), white, 1.0).has_value());
  CHECK_FALSE(resultant_of(grid, p, std::vector<std::size_t>{35}, white, 1.0).centre_y.has_value());
  CHECK_THROWS_WITH(resultant_of(grid, std::vector<double>(5), all_cells(grid), white, 1.0),
                    ContainsSubstring("per cell"));
}

TEST_CASE("windows tell of contacts of which no cell is certain", "[skin][resultant]") {
  const SurfaceGrid grid{.rows = 12, .columns = 14, .spacing_y = 1.0, .spacing_z = 0.5};
  std::vector<double> p(grid.count());
  const auto press = [&](std::size_t row, std::size_t column, double each) {
    for (std::size_t m = row - 1; m <= row + 1; ++m)
      for (std::size_t n = column - 1; n <= column + 1; ++n) p[grid.columns * m + n] = each;
  };
  press(2, 2, 1.9);   // no cell is even above twice its deviation, all nine together are 5.7
  press(2, 11, 0.9);  // 2.7: noise, or not
  p[grid.columns * 9 + 7] = 5.0;
  const std::vector<double> deviations(grid.count(), 1.0);
  const CellWindow window{.rows = 1, .columns = 1};
  const WindowBands windows{window, std::vector<double>(grid.count(), 3.0)};
  CHECK(contact_cells(grid, p, deviations) == std::vector<std::size_t>{14 * 9 + 7});
  const FoundContacts found = find_contacts(grid, p, deviations, windows);
  const auto has = [](const std::vector<std::size_t>& cells, std::size_t cell) {
    return std::binary_search(cells.begin(), cells.end(), cell);
  };
  CHECK(has(found.cells, 14 * 2 + 2));
  CHECK(has(found.cells, 14 * 9 + 7));
  CHECK(has(found.doubted, 14 * 2 + 11));
  CHECK(separate_contacts(grid, p, found.cells).size() == 2);
  for (const std::size_t cell : found.doubted) CHECK_FALSE(has(found.cells, cell));
  // What a cell is certain of is not told of once more.
  CHECK_FALSE(has(found.cells, 14 * 9 + 8));
  // A rim that takes all leaves windows nothing.
  CHECK(find_contacts(grid, p, deviations, windows, 20.0).doubted.empty());
  CHECK_THROWS_WITH(find_contacts(grid, p, deviations, {window, {}}),
                    ContainsSubstring("per cell"));

  CHECK(window_of(grid, 1.1).rows == 1);
  CHECK(window_of(grid, 1.1).columns == 2);
  CHECK(window_of(grid, 1e9).rows == grid.rows - 1);
  CHECK_THROWS_WITH(window_of(grid, -1.0), ContainsSubstring("reach"));
}

TEST_CASE("deviations of windows are those of their sums, inside and on a face",
          "[skin][covariance]") {
  LinearProblem problem = make_problem(square_skin(4, 2e-3), silicone, {.tangential_weight = 2.0});
  leave_out(problem, std::vector<std::size_t>{5});
  const SurfaceGrid& grid = problem.grid;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> readings(problem.weights.size());
  for (double& reading : readings) reading = normal(random);
  const double alpha = 1e-3;
  const ConeSolution held = ConeTikhonov(problem, alpha, {.friction_limit = 0.5}).solve(readings);
  REQUIRE_FALSE(held.face.free.empty());
  for (const TikhonovFamily& family :
       {TikhonovFamily(problem), TikhonovFamily(problem, held.face)}) {
    const TractionCovariance covariance(family, alpha, 0.3 * alpha);
    const CellWindow window{.rows = 2, .columns = 1};
    const std::vector<double> found = covariance.window_deviations(grid, window);
    REQUIRE(found.size() == grid.count());
    for (std::size_t cell = 0; cell < grid.count(); cell += 7) {
      std::vector<double> weights(problem.kernel.columns);
      for (std::size_t other = 0; other < grid.count(); ++other) {
        const auto apart = [](std::size_t a, std::size_t b) {
          return std::max(a, b) - std::min(a, b);
        };
        if (apart(cell / grid.columns, other / grid.columns) <= window.rows &&
            apart(cell % grid.columns, other % grid.columns) <= window.columns)
          weights[other] = 1.0;
      }
      CHECK_THAT(found[cell], WithinRel(covariance.deviation(weights), 1e-9));
    }
    const std::vector<double> cells = covariance.deviations();
    const std::vector<double> alone = covariance.window_deviations(grid, {});
    for (std::size_t cell = 0; cell < grid.count(); ++cell)
      CHECK_THAT(alone[cell], WithinRel(cells[cell], 1e-9) || WithinAbs(cells[cell], 1e-12));
  }
}

TEST_CASE("pushes and pulls that cancel have a force and no centre, however their sum is rounded",
          "[skin][resultant]") {
  const SurfaceGrid grid = make_problem(square_skin(3, 2e-3), silicone, {.components = 1}).grid;
  std::vector<double> three{-0.3, 0.1, 0.2};  // sorted
  do {
    std::vector<double> tractions(grid.count());
    std::copy(three.begin(), three.end(), tractions.begin());
    const UncertainWrench found =
        resultant_of(grid, tractions, all_cells(grid), White(grid.count()), 1.0);
    CHECK_FALSE(found.centre_y);
    CHECK_FALSE(found.centre_z);
    CHECK_THAT(found.normal.value, WithinAbs(0.0, 1e-15 * grid.area()));
  } while (std::next_permutation(three.begin(), three.end()));
}
