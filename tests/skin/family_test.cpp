// The laws of a family and its covariance, over lines and skins.
#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>

#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tangential_weight.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;
using enum Quantity;

namespace {

struct Named {
  std::string name;
  LinearProblem problem;
  std::size_t classes;
};

/// Lines: of two classes, or one where a dead taxel has no mirror.
std::vector<Named> named_lines() {
  std::vector<Named> lines;
  for (auto& [name, problem] : sample_problems()) {
    const auto length = static_cast<std::ptrdiff_t>(channel_length(problem));
    bool mirrored = true;
    for (auto at = problem.weights.begin(); at != problem.weights.end(); at += length)
      mirrored = mirrored && std::equal(at, at + length, std::reverse_iterator(at + length));
    lines.push_back({name, std::move(problem), mirrored ? 2U : 1U});
  }
  return lines;
}

/// Even and odd, one row, one taxel, rectangles, dead rows that mirror themselves and not, places
/// anywhere, one component, one place at two depths.
std::vector<Named> named_skins() {
  const auto make = [](SkinArray skin, const SkinProblemOptions& options = {},
                       const Material& material = silicone) {
    return make_problem(skin, material, options);
  };
  SkinArray row = square_skin(6, 2e-3);
  row.rows = 1;
  SkinArray oblong = square_skin(4, 1.5e-3, {stress_x, stress_y, stress_z});
  oblong.columns = 7;
  oblong.pitch_z = 1.7e-3;
  SkinArray depths = square_skin(3, 1e-3, {stress_x, shear_xy});
  depths.depths = {1e-3, 2e-3};
  const Material firm{.youngs_modulus = 2e5, .poisson_ratio = 0.5};
  const Material thin{.poisson_ratio = 0.48, .layer = Layer{2e-3, Base::bonded}};
  const Taxel place{"", 0.3e-3, 0.1e-3, 1e-3, press_and_drag};
  return {
      {"even", make(square_skin(6, 2e-3)), 4},
      {"odd, incompressible", make(square_skin(5, 2e-3), {}, firm), 4},
      {"oblong, three normal stresses", make(oblong), 4},
      {"one row", make(row), 4},
      {"one taxel", make(square_skin(1, 2e-3)), 4},
      {"one taxel, one component", make(square_skin(1, 2e-3, {stress_x}), {.components = 1}), 4},
      {"rectangles", make(square_skin(4, 0.5e-3)), 4},
      {"two depths, weighted",
       make(depths, {.tangential_weight = 2.0, .channel_rms = {1.0, 2.0, 3.0, 4.0}}), 4},
      {"dead rows that mirror themselves", make(square_skin(4, 2e-3), {.dead_taxels = {4, 7}}), 2},
      {"a dead taxel", make(square_skin(4, 2e-3), {.dead_taxels = {1}}), 1},
      {"the base of a layer", make(square_skin(4, 2e-3), {}, thin), 4},
      {"displacements",
       make(square_skin(4, 2e-3, {displacement_x, displacement_y, displacement_z}), {},
            {.youngs_modulus = 1e3, .poisson_ratio = 0.0}),
       4},
      {"places anywhere",
       make(uneven_skin({{"a", -1e-3, 0.2e-3, 1e-3, press_and_drag},
                         {"b", 1.1e-3, 0.9e-3, 1.5e-3, {stress_x}},
                         {"c", 0.3e-3, -2e-3, 2e-3, press_and_drag}})),
       1},
      {"two taxels at one place",
       make(uneven_skin({place, {"below", 0.3e-3, 0.1e-3, 2e-3, press_and_drag}})), 4},
      {"places that mirror themselves",
       make(uneven_skin(
           {{"a", -1e-3, 0.0, 1e-3, press_and_drag}, {"b", 1e-3, 0.0, 1e-3, press_and_drag}})),
       4}};
}

std::vector<Named> named_problems() {
  std::vector<Named> all = named_lines();
  for (Named& skin : named_skins()) all.push_back(std::move(skin));
  return all;
}

std::vector<double> descending(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  return sorted;
}

/// Every direction of every cell.
ActiveFace whole_face(const LinearProblem& problem) {
  ActiveFace face;
  for (std::size_t cell = 0; cell < problem.grid.count(); ++cell)
    for (std::size_t u = 0; u < problem.components; ++u) {
      face.free.push_back({.cell = cell});
      face.free.back().along[u] = 1.0;
    }
  return face;
}

double largest(std::span<const double> values) {
  return *std::max_element(values.begin(), values.end());
}

}  // namespace

TEST_CASE("a family's tractions solve the normal equations, in every class", "[skin][family]") {
  for (const auto& [name, problem, classes] : named_problems()) {
    CAPTURE(name);
    const TikhonovFamily family(problem);
    CHECK(family.classes() == classes);
    const std::vector<double> readings = random_numbers(problem.weights.size(), 1);
    const FilterFrame frame = family.analyse(readings);
    const double top = largest(family.singular_values());
    for (const double share : {1.0, 1e-3, 1e-6}) {
      const double alpha = share * top * top;
      const std::vector<double> f = family.solve(frame, alpha);
      const std::vector<double> b = normal_right_side(problem, readings);
      const std::vector<double> image = product(normal_matrix(problem, alpha), f);
      // Lines are smoothed over more spacings.
      CHECK(distance(image, b) <= (problem.grid.columns == 1 ? 1e-11 : 1e-12) * norm(b));
      std::vector<double> by_matrix(f.size());
      REQUIRE(family.reconstruction(alpha).solve(readings, by_matrix) == FrameStatus::ok);
      CHECK(distance(by_matrix, f) <= 1e-11 * norm(f));
      if (share < 1e-3) continue;  // by a QR of everything
      CHECK(distance(tikhonov_solve(problem, alpha, readings), f) <= 1e-11 * norm(f));
    }
  }
}

TEST_CASE("a face on which everything is free is no constraint: classes find what the whole does",
          "[skin][family][property]") {
  for (const auto& [name, problem, classes] : named_problems()) {
    CAPTURE(name);
    const TikhonovFamily apart(problem);
    const TikhonovFamily whole(problem, whole_face(problem));
    CHECK(whole.classes() == 1);
    std::vector<double> a = descending(apart.singular_values());
    std::vector<double> b = descending(whole.singular_values());
    // What one of them leaves out is 0 in the other.
    a.resize(std::max(a.size(), b.size()));
    b.resize(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) CHECK_THAT(a[i], WithinAbs(b[i], 1e-12 * a[0]));

    const double alpha = 1e-3 * a[0] * a[0];
    const std::vector<double> readings = random_numbers(problem.weights.size(), 5);
    const FilterFrame frame = apart.analyse(readings);
    const std::vector<double> f = apart.solve(frame, alpha);
    CHECK(distance(whole.solve(whole.analyse(readings), alpha), f) <= 1e-10 * norm(f));
    CHECK(frame.rows == independent_readings(problem));
    CHECK((frame.periodogram != nullptr) == (problem.grid.columns == 1));
    const TractionCovariance bands(apart, alpha, 0.5 * alpha);
    const std::vector<double> deviations = bands.deviations();
    const std::vector<double> expected = TractionCovariance(whole, alpha, 0.5 * alpha).deviations();
    CHECK(distance(deviations, expected) <= 1e-10 * norm(expected));
    // A window's deviation is that of its sum, and a window of nothing but a cell is the cell.
    const CellWindow window{.rows = std::min<std::size_t>(2, problem.grid.rows - 1),
                            .columns = problem.grid.columns > 1 ? 1U : 0U};
    const std::vector<double> sums = bands.window_deviations(problem.grid, window);
    const std::vector<double> cells = bands.window_deviations(problem.grid, {});
    const std::size_t at = problem.grid.count() / 2;
    std::vector<double> weights(f.size());
    for (std::size_t i = 0; i < problem.grid.count(); ++i) {
      const auto away = [](std::size_t x, std::size_t y) { return x > y ? x - y : y - x; };
      if (away(i / problem.grid.columns, at / problem.grid.columns) <= window.rows &&
          away(i % problem.grid.columns, at % problem.grid.columns) <= window.columns)
        weights[i] = 1.0;
    }
    CHECK_THAT(sums[at], WithinRel(bands.deviation(weights), 1e-7));
    CHECK_THAT(std::pow(sums[at], 2), WithinRel(bands.covariance(weights, weights), 1e-7));
    CHECK_THAT(cells[at], WithinRel(deviations[at], 1e-12));
  }
}

TEST_CASE("what no reading shows adds nothing to the band of what they show, however it is known",
          "[family][bands][property]") {
  // A tangential traction on which no reading depends: the normal one's band is that without it,
  // and of a prior a billion times as wide rounding is not a part.
  const LinearProblem alone =
      make_problem(SensorArray{31, 0.5, {1.0}, {stress_x}}, {1.0, 0.45}, {.smoothing_length = 1.0});
  LinearProblem beside = alone;
  beside.components = 2;
  beside.kernel = {31, 62, std::vector<double>(31 * 62)};
  for (std::size_t i = 0; i < 31; ++i)
    for (std::size_t j = 0; j < 31; ++j) beside.kernel(i, j) = alone.kernel(i, j);
  const double alpha = 1e-18;
  const TractionCovariance expected(TikhonovFamily(alone), alpha, alpha);
  const TractionCovariance found(TikhonovFamily(beside), alpha, alpha);
  const std::vector<double> right = expected.deviations();
  const std::vector<double> deviations = found.deviations();
  std::vector<std::vector<double>> single;
  for (std::size_t i = 0; i < 31; ++i) {
    CHECK_THAT(deviations[i], WithinRel(right[i], 1e-9));
    single.emplace_back(62);
    single.back()[i] = 2.0;
  }
  const std::vector<double> doubled = found.deviations_of(single);
  const std::vector<double> sums = found.window_deviations(beside.grid, {.rows = 1});
  const std::vector<double> right_sums = expected.window_deviations(alone.grid, {.rows = 1});
  for (std::size_t i = 0; i < 31; ++i) {
    CHECK_THAT(doubled[i], WithinRel(2.0 * right[i], 1e-9));
    CHECK_THAT(sums[i], WithinRel(right_sums[i], 1e-9));
  }
}

TEST_CASE("classes are parts of one decomposition: the same frame, filters and traces",
          "[skin][family][property]") {
  // A reading's weight a rounding away from its mirror's leaves nothing to mirror.
  LinearProblem problem = make_problem(square_skin(6, 2e-3), silicone);
  const TikhonovFamily apart(problem);
  problem.weights[0] *= 1.0 + std::numeric_limits<double>::epsilon();
  const TikhonovFamily whole(problem);
  REQUIRE(apart.classes() == 4);
  REQUIRE(whole.classes() == 1);
  std::vector<double> a(apart.singular_values().begin(), apart.singular_values().end());
  std::vector<double> b(whole.singular_values().begin(), whole.singular_values().end());
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK_THAT(a[i], WithinAbs(b[i], 1e-14 * b.back()));

  const std::vector<double> readings = random_numbers(problem.weights.size(), 2);
  const FilterFrame one = apart.analyse(readings);
  const FilterFrame other = whole.analyse(readings);
  CHECK_THAT(norm(one.beta), WithinRel(norm(other.beta), 1e-13));
  CHECK(one.rows == other.rows);
  for (const AlphaRule rule : {AlphaRule::rgcv, AlphaRule::aicc, AlphaRule::evidence}) {
    const double alpha = choose_alone(one, rule, 0.1).alpha;
    CHECK_THAT(alpha, WithinRel(choose_alone(other, rule, 0.1).alpha, 1e-7));
    CHECK_THAT(apart.degrees_of_freedom(alpha), WithinRel(whole.degrees_of_freedom(alpha), 1e-12));
    CHECK_THAT(apart.condition(alpha), WithinRel(whole.condition(alpha), 1e-12));
    const std::vector<double> f = apart.solve(one, alpha);
    CHECK(distance(f, whole.solve(other, alpha)) <= 1e-10 * norm(f));
  }
}

TEST_CASE("neither alpha, nor tractions, nor bands follow the grid's spacing",
          "[skin][family][property]") {
  const SkinArray skin = square_skin(8, 4e-3);
  const std::vector<SkinLoad> loads{SkinContact{.radius = 3e-3, .force = 0.5, .friction = 0.3}};
  std::vector<double> readings = exact_readings(skin, silicone, loads);
  std::mt19937 random(5);
  const double rms = add_noise(readings, 0.01, random);
  struct Answer {
    double alpha;
    std::array<double, 3> forces;  // of a soft window about the load
    std::array<double, 3> deviations;
  };
  const auto solve = [&](double spacing) {
    const LinearProblem problem =
        make_problem(skin, silicone, {.grid = {.spacing = spacing, .margin = 4e-3}});
    const SurfaceGrid& grid = problem.grid;
    const TikhonovFamily family(problem);
    const FilterFrame frame = family.analyse(readings);
    const double alpha = choose_alone(frame, AlphaRule::evidence, rms).alpha;
    const std::vector<double> f = family.solve(frame, 1e-3);
    const TractionCovariance covariance(family, 1e-3, 1e-4);
    Answer answer{alpha, {}, {}};
    for (std::size_t u = 0; u < 3; ++u) {
      std::vector<double> window(f.size());
      for (std::size_t i = 0; i < grid.count(); ++i)
        window[u * grid.count() + i] =
            grid.area() *
            std::exp(-std::pow(
                std::hypot(grid.y(i / grid.columns), grid.z(i % grid.columns)) / 3e-3, 2));
      answer.forces[u] = std::inner_product(f.begin(), f.end(), window.begin(), 0.0);
      answer.deviations[u] = covariance.deviation(window);
    }
    return answer;
  };
  const Answer coarse = solve(1e-3);
  const Answer fine = solve(0.5e-3);
  CHECK_THAT(fine.alpha, WithinRel(coarse.alpha, 0.05));
  for (std::size_t u = 0; u < 3; ++u) {
    CHECK_THAT(fine.forces[u], WithinAbs(coarse.forces[u], 0.005 * coarse.forces[0]));
    CHECK_THAT(fine.deviations[u], WithinRel(coarse.deviations[u], 0.03));
  }
}

TEST_CASE("units do not matter, however large or small", "[skin][family][property]") {
  // Lengths times 1e150 or 1e-150, tractions times 1e100 or 1e-100.
  const SkinArray skin = square_skin(4, 2e-3);
  const std::vector<double> readings = random_numbers(48, 7);
  const LinearProblem problem = make_problem(skin, silicone);
  const TikhonovFamily family(problem);
  const FilterFrame frame = family.analyse(readings);
  const double alpha = choose_alone(frame, AlphaRule::rgcv).alpha;
  const std::vector<double> f = family.solve(frame, alpha);
  const std::vector<double> g =
      ConeTikhonov(problem, alpha, {.friction_limit = 0.5}).solve(readings).tractions;
  for (const double length : {1e-150, 1e150})
    for (const double pressure : {1e-100, 1e100}) {
      CAPTURE(length, pressure);
      SkinArray scaled = skin;
      scaled.pitch_y *= length;
      scaled.pitch_z *= length;
      scaled.depths[0] *= length;
      std::vector<double> read = readings;
      for (double& one : read) one *= pressure;
      const LinearProblem other = make_problem(scaled, silicone);
      const TikhonovFamily large(other);
      const FilterFrame seen = large.analyse(read);
      const double chosen = choose_alone(seen, AlphaRule::rgcv).alpha;
      CHECK_THAT(chosen, WithinRel(alpha, 1e-6));
      std::vector<double> back = large.solve(seen, alpha);
      for (double& one : back) one /= pressure;
      CHECK(distance(back, f) <= 1e-10 * norm(f));
      back = ConeTikhonov(other, alpha, {.friction_limit = 0.5}).solve(read).tractions;
      for (double& one : back) one /= pressure;
      CHECK(distance(back, g) <= 1e-4 * norm(g));
    }
  // Strains of a skin as hard as 1e150: gammas of 1e-150.
  const Material hard{.youngs_modulus = 1e150, .poisson_ratio = 0.45};
  const std::vector<Quantity> strains{strain_x, shear_strain_xy, shear_strain_xz};
  const TikhonovFamily small(make_problem(square_skin(4, 2e-3, strains), hard));
  const TikhonovFamily plain(
      make_problem(square_skin(4, 2e-3, strains), {.youngs_modulus = 1.0, .poisson_ratio = 0.45}));
  CHECK_THAT(largest(small.singular_values()),
             WithinRel(1e-150 * largest(plain.singular_values()), 1e-12));
}

TEST_CASE("a frame without a signal has no tractions", "[skin][family]") {
  const LinearProblem problem = make_problem(square_skin(4, 2e-3), silicone);
  const TikhonovFamily family(problem);
  const FilterFrame frame = family.analyse(std::vector<double>(48));
  CHECK(frame.scale == 0.0);
  const AlphaChoice choice = choose_alone(frame, AlphaRule::rgcv);
  CHECK(norm(family.solve(frame, choice.alpha)) == 0.0);
}

TEST_CASE("frames and alphas that are none are refused", "[skin][family]") {
  const TikhonovFamily family(make_problem(square_skin(3, 2e-3), silicone));
  std::vector<double> readings(27);
  CHECK_THROWS_WITH(family.analyse(std::vector<double>(5)), ContainsSubstring("5 values"));
  readings[3] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(family.analyse(readings), ContainsSubstring("not finite"));
  readings[3] = 0.0;
  const FilterFrame frame = family.analyse(readings);
  CHECK_THROWS_WITH(family.solve(frame, 0.0), ContainsSubstring("alpha"));
  CHECK_THROWS_WITH(family.reconstruction(-1.0), ContainsSubstring("alpha"));
  const LinearProblem problem = make_problem(square_skin(3, 2e-3), silicone);
  CHECK_THROWS_AS(tikhonov_solve(problem, 0.0, readings), std::invalid_argument);
  CHECK_THROWS_AS(tikhonov_solve(problem, 1e-3, std::vector<double>(2)), std::invalid_argument);
  readings[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(tikhonov_solve(problem, 1e-3, readings), std::invalid_argument);
}

TEST_CASE("the default rule's alpha is near the best one on contacts that nobody saw",
          "[skin][family][alpha]") {
  const SkinArray skin = square_skin(10, 2e-3);
  const LinearProblem problem = make_problem(skin, silicone);
  const TikhonovFamily family(problem);
  const AlphaTables tables(family.singular_values(), independent_readings(problem));
  // Readings by another grid, three times as fine.
  const SurfaceGrid fine = grid_of(skin, {.spacing = 1e-3 / 3.0, .margin = 4e-3});
  std::mt19937 random(20);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> ratios;
  for (int contact = 0; contact < 20; ++contact) {
    const std::vector<SkinLoad> loads = random_contacts(random, 5e-3);
    const std::vector<double> truth = cell_means(loads, problem.grid);
    std::vector<double> readings = sampled_readings(skin, silicone, fine, cell_means(loads, fine));
    (void)add_noise(readings, 1e-3 * std::pow(50.0, unit(random)), random);
    const FilterFrame frame = family.analyse(readings);
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 60; ++i)
      best = std::min(best, distance(family.solve(frame, std::pow(10.0, -9.0 + i / 6.0)), truth));
    const double alpha = choose_alone(frame, tables, AlphaRule::aicc).alpha;
    ratios.push_back(distance(family.solve(frame, alpha), truth) / best);
  }
  CHECK(largest(ratios) <= 1.2);
}

TEST_CASE("no reading is lost: what no traction explains is left outside", "[skin][family]") {
  // One column: no cell is odd across it, and readings that are belong to no traction.
  const SkinArray row{.rows = 6,
                      .columns = 1,
                      .pitch_y = 1.0,
                      .pitch_z = 1.0,
                      .depths = {1.0},
                      .reads = {Quantity::stress_x, Quantity::shear_xz}};
  const LinearProblem problem =
      make_problem(row, Material{}, {.components = 1, .grid = {.spacing = 1.0, .margin = 0.0}});
  std::vector<double> readings(12);
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i] = 1.0 + 0.3 * static_cast<double>(i * i % 5);
  const FilterFrame frame = TikhonovFamily(problem).analyse(readings);
  double squares = frame.outside * frame.outside;
  for (const double beta : frame.beta) squares += beta * beta;
  double all = 0.0;
  for (const double reading : readings) all += reading * reading;
  CHECK_THAT(frame.scale * std::sqrt(squares), WithinRel(std::sqrt(all), 1e-12));
  CHECK(frame.rows == readings.size());
}

TEST_CASE("the readings know whether anything drags", "[skin][family][alpha]") {
  const SkinArray skin = square_skin(8, 2e-3);
  const LinearProblem problem = make_problem(skin, silicone);
  std::mt19937 random(8);
  const auto weight = [&](double friction) {
    const std::vector<SkinLoad> loads{
        SkinContact{.radius = 3e-3, .force = 0.5, .friction = friction, .direction = 0.7}};
    std::vector<double> readings = exact_readings(skin, silicone, loads);
    const double rms = add_noise(readings, 0.01, random);
    return likeliest_tangential_weight(problem, readings, rms);
  };
  const double pressed = weight(0.0);
  const double dragged = weight(0.8);
  CHECK(pressed >= 4.0);
  CHECK(dragged < pressed);
  CHECK(std::count(tangential_weights.begin(), tangential_weights.end(), dragged) == 1);
  const LinearProblem one = make_problem(skin, silicone, {.components = 1});
  CHECK(likeliest_tangential_weight(one, std::vector<double>(192, 1.0)) == 1.0);
}

TEST_CASE("where no reading depends on the tractions the family says so, and nothing is made up",
          "[skin][family]") {
  // Shear is odd about the taxel, and the one cell over it is even.
  const LinearProblem problem = make_problem(square_skin(1, 2e-3, {shear_xy}), silicone,
                                             {.components = 1, .grid = {.margin = 0.0}});
  REQUIRE(problem.kernel.columns == 1);
  CHECK(problem.kernel.values == std::vector{0.0});
  const TikhonovFamily family(problem);
  CHECK(family.condition(1e-3) == 1.0);
  CHECK(family.degrees_of_freedom(1e-3) == 0.0);
  const FilterFrame frame = family.analyse(std::vector{3.0});
  CHECK_THAT(frame.outside * frame.scale, WithinRel(3.0, 1e-12));
  CHECK(family.solve(frame, 1e-3) == std::vector{0.0});
  std::vector<double> traction{1.0};
  REQUIRE(family.reconstruction(1e-3).solve(std::vector{3.0}, traction) == FrameStatus::ok);
  CHECK(traction.front() == 0.0);
  // What is not read is as large as the prior says: 1 / sqrt(prior A/P).
  const double prior = 4e-4;
  const TractionCovariance covariance(family, 1e-3, prior);
  CHECK_THAT(covariance.deviations().front(),
             WithinRel(1.0 / std::sqrt(prior * problem.measure), 1e-12));
  for (const AlphaSweep::Curve& curve : sweep_alpha(frame, 1.0).curves)
    CHECK(curve.choice.verdict == AlphaVerdict::no_root);
  const double alpha = choose_alone(frame, AlphaRule::aicc).alpha;
  CHECK_THROWS_WITH(family.solve(frame, alpha), ContainsSubstring("no reading depends"));
}

TEST_CASE("an offset that takes all that two taxels read of one cell leaves nothing",
          "[skin][family][offset]") {
  SkinArray two = square_skin(1, 2e-3, {stress_x});
  two.rows = 2;
  const LinearProblem both = make_problem(
      two, silicone, {.components = 1, .grid = {.margin = 0.0}, .unknown_offsets = true});
  LinearProblem problem = both;
  leave_out(problem, std::vector<std::size_t>{1});  // one taxel, less its offset
  CHECK(*std::max_element(problem.kernel.values.begin(), problem.kernel.values.end()) == 0.0);
  CHECK(*std::min_element(problem.kernel.values.begin(), problem.kernel.values.end()) == 0.0);
}
