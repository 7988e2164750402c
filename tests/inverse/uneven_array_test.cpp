// Taxels that lie where they lie: what must hold whatever their places.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "tactile_net/elasticity/hat_kernel.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/largest.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/solutions.hpp"

using namespace tactile_net;

namespace {

constexpr double taxel_depth = 1.5e-3;

/// The taxels of an even array at one depth, one by one, moved by `offset`.
std::vector<Taxel> taxels_of(const SensorArray& array, double offset = 0.0) {
  std::vector<Taxel> taxels;
  for (const double y : positions(array))
    taxels.push_back({.y = y + offset, .depth = array.depths.front(), .reads = array.reads});
  return taxels;
}

const SensorArray even{.count = 9,
                       .pitch = 2.0 * taxel_depth,
                       .depths = {taxel_depth},
                       .reads = {Quantity::stress_x, Quantity::shear_xy}};

/// Sixteen taxels of a palm: places, depths and quantities differ.
SensorArray palm() {
  const std::vector<double> places = {-12.0, -9.5, -7.8, -5.0, -3.9, -2.0, -0.6, 0.9,
                                      2.2,   3.0,  4.9,  6.1,  7.7,  9.2,  10.6, 12.0};
  std::vector<Taxel> taxels;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Taxel taxel{.y = 1e-3 * places[i], .depth = taxel_depth * (i % 3 == 0 ? 0.8 : 1.0)};
    if (i % 4 != 3) taxel.reads.push_back(Quantity::stress_x);
    if (i % 2 == 1) taxel.reads.push_back(Quantity::shear_xy);
    taxels.push_back(std::move(taxel));
  }
  return uneven_array(std::move(taxels));
}

LineProblemOptions on_grid(std::size_t unknowns, std::optional<double> spacing = {}) {
  return {.unknowns = unknowns,
          .smoothing_length = taxel_depth,
          .surface = {.basis = SurfaceBasis::hats, .spacing = spacing}};
}

std::vector<double> pressed(const SensorArray& array, const RigidContact& contact,
                            const Material& material = silicone) {
  return exact_readings(array, material, std::vector<Contact>{contact});
}

}  // namespace

TEST_CASE("taxels mirror themselves only where their widths do", "[uneven][property]") {
  const auto classes = [](double width_of_last) {
    std::vector<Taxel> taxels = taxels_of(even);
    for (Taxel& taxel : taxels) taxel.width = 1e-3;
    taxels.back().width = width_of_last;
    return TikhonovFamily(make_problem(uneven_array(taxels), silicone, on_grid(2))).classes();
  };
  CHECK(classes(1e-3) == 2);
  CHECK(classes(2e-3) == 1);
}

TEST_CASE("an even array taxel by taxel has the same readings and the same K", "[uneven]") {
  const SensorArray listed = uneven_array(taxels_of(even));
  CHECK(reading_names(listed) == reading_names(even));
  const RigidContact contact{
      .center = 0.7e-3, .half_width = taxel_depth, .force = 20.0, .friction = 0.4};
  const std::vector<double> g = pressed(even, contact);
  const std::vector<double> same = pressed(listed, contact);
  const LinearProblem one = make_problem(even, silicone, on_grid(2));
  const LinearProblem other = make_problem(listed, silicone, on_grid(2, one.grid.spacing_y));
  REQUIRE(other.grid.count() == one.grid.count());
  CHECK_THAT(other.measure, WithinRel(one.measure, 1e-12));
  const double peak = largest(one.kernel.values);
  for (std::size_t i = 0; i < g.size(); ++i)
    CHECK_THAT(same[i], WithinAbs(g[i], 1e-12 * largest(g)));
  for (std::size_t i = 0; i < one.kernel.values.size(); ++i)
    REQUIRE_THAT(other.kernel.values[i], WithinAbs(one.kernel.values[i], 1e-12 * peak));
  CHECK(other.kernel_error <
        1e-12 * peak * std::sqrt(static_cast<double>(one.kernel.values.size())));
}

TEST_CASE("K of wide taxels is the mean of the hats' readings across them", "[uneven][aperture]") {
  constexpr double width = 1.7 * taxel_depth;
  constexpr int parts = 400;  // of Simpson's rule
  SensorArray wide = even;
  wide.width = width;
  std::vector<Taxel> taxels = taxels_of(even);
  for (Taxel& taxel : taxels) taxel.width = width;
  const LinearProblem one = make_problem(wide, silicone, on_grid(2));
  const LinearProblem listed =
      make_problem(uneven_array(taxels), silicone, on_grid(2, one.grid.spacing_y));
  const double peak = largest(one.kernel.values);
  for (const std::size_t row : {0UL, 3UL, 13UL}) {
    const Site& site = one.sites[row];
    for (std::size_t column = 0; column < one.kernel.columns; ++column) {
      const std::size_t i = column % one.grid.count();
      const HatKernel hat(site.quantity, line_tractions[column / one.grid.count()], silicone,
                          taxel_depth, one.grid.spacing_y);
      double mean = 0.0;
      for (int part = 0; part <= parts; ++part) {
        const double weight = part == 0 || part == parts ? 1.0 : part % 2 == 1 ? 4.0 : 2.0;
        const double y = site.y + width * (static_cast<double>(part) / parts - 0.5);
        mean += weight / (3.0 * parts) * hat(y - one.grid.y(i));
      }
      REQUIRE_THAT(one.kernel(row, column), WithinAbs(mean, 1e-9 * peak));
      REQUIRE_THAT(listed.kernel(row, column), WithinAbs(one.kernel(row, column), 1e-12 * peak));
    }
  }
}

TEST_CASE("tractions on the grid are read by wide taxels as K says", "[uneven][aperture]") {
  std::vector<Taxel> taxels = palm().taxels;
  for (std::size_t i = 0; i < taxels.size(); ++i)
    taxels[i].width = taxel_depth * (i % 3 == 0 ? 2.0 : 0.4 * static_cast<double>(i % 3));
  const SensorArray wide = uneven_array(taxels);
  const LinearProblem problem = make_problem(wide, silicone, on_grid(2));
  SampledTractions tractions{.first = problem.grid.y(0), .pitch = problem.grid.spacing_y};
  std::vector<double> f(problem.kernel.columns);
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = std::cos(0.37 * static_cast<double>(i * i));
  const auto half = f.begin() + std::ssize(f) / 2;
  tractions.normal.assign(f.begin(), half);
  tractions.tangential.assign(half, f.end());
  const std::vector<double> g = exact_readings(wide, silicone, std::vector<Contact>{tractions});
  for (std::size_t row = 0; row < g.size(); ++row) {
    const std::span<const double> k = problem.kernel.row(row);
    CHECK_THAT(std::inner_product(k.begin(), k.end(), f.begin(), 0.0),
               WithinAbs(g[row], 1e-12 * largest(g)));
  }
}

TEST_CASE("a taxel that does not read a quantity is a row less, and nothing else", "[uneven]") {
  std::vector<Taxel> taxels = taxels_of(even);
  taxels[2].reads = {Quantity::shear_xy};
  taxels[5].reads = {Quantity::stress_x};
  const SensorArray mixed = uneven_array(taxels);
  const LinearProblem whole = make_problem(uneven_array(taxels_of(even)), silicone, on_grid(2));
  const LinearProblem part = make_problem(mixed, silicone, on_grid(2));
  REQUIRE(part.sites.size() == 16);
  for (std::size_t row = 0; row < part.sites.size(); ++row) {
    const Site& site = part.sites[row];
    const std::size_t of_whole = site.channel * even.count + site.taxel;
    for (std::size_t j = 0; j < part.kernel.columns; ++j)
      REQUIRE(part.kernel(row, j) == whole.kernel(of_whole, j));
  }
}

TEST_CASE("moving array and contact together moves the centre, and changes no force", "[uneven]") {
  constexpr double offset = 0.0625;
  const SensorArray here = palm();
  std::vector<Taxel> moved = here.taxels;
  for (Taxel& taxel : moved) taxel.y += offset;
  const SensorArray there = uneven_array(moved);
  RigidContact contact{.center = 1.1e-3, .half_width = taxel_depth, .force = 20.0, .friction = 0.3};
  const std::vector<double> g = pressed(here, contact);
  contact.center += offset;
  const std::vector<double> h = pressed(there, contact);
  const double sigma = 0.01 * largest(g);
  const UncertainResultant first =
      solve_by_evidence(make_problem(here, silicone, on_grid(2)), g, sigma).contact;
  const UncertainResultant second =
      solve_by_evidence(make_problem(there, silicone, on_grid(2)), h, sigma).contact;
  CHECK_THAT(second.normal.value, WithinRel(first.normal.value, 1e-9));
  CHECK_THAT(second.normal.deviation, WithinRel(first.normal.deviation, 1e-9));
  CHECK_THAT(second.tangential->value, WithinRel(first.tangential->value, 1e-8));
  CHECK_THAT(second.centre->value - offset, WithinAbs(first.centre->value, 1e-9));
  CHECK_THAT(second.centre->deviation, WithinRel(first.centre->deviation, 1e-6));
}

TEST_CASE("a mirrored array sees the mirror image", "[uneven]") {
  const SensorArray here = palm();
  std::vector<Taxel> mirrored(here.taxels.rbegin(), here.taxels.rend());
  for (Taxel& taxel : mirrored) taxel.y = -taxel.y;
  const SensorArray there = uneven_array(mirrored);
  RigidContact contact{.center = 1.1e-3, .half_width = taxel_depth, .force = 20.0, .friction = 0.3};
  const UncertainResultant first =
      solve_by_evidence(make_problem(here, silicone, on_grid(2)), pressed(here, contact), 50.0)
          .contact;
  contact.center = -contact.center;
  contact.friction = -contact.friction;
  const UncertainResultant second =
      solve_by_evidence(make_problem(there, silicone, on_grid(2)), pressed(there, contact), 50.0)
          .contact;
  CHECK_THAT(second.normal.value, WithinRel(first.normal.value, 1e-9));
  CHECK_THAT(second.tangential->value, WithinRel(-first.tangential->value, 1e-8));
  CHECK_THAT(second.centre->value, WithinRel(-first.centre->value, 1e-8));
}

TEST_CASE("a dead taxel takes all that it reads with it", "[uneven]") {
  const SensorArray array = palm();
  LineProblemOptions options = on_grid(2);
  options.dead_taxels = {1, 6};
  const LinearProblem problem = make_problem(array, silicone, options);
  for (std::size_t row = 0; row < problem.sites.size(); ++row) {
    const std::size_t taxel = problem.sites[row].taxel;
    CHECK((problem.weights[row] == 0.0) == (taxel == 1 || taxel == 6));
  }
}

TEST_CASE("an uneven array tells forces within its bands", "[uneven]") {
  for (const std::size_t unknowns : {std::size_t{1}, std::size_t{2}}) {
    std::vector<Taxel> taxels = palm().taxels;
    if (unknowns == 1)
      for (Taxel& taxel : taxels) taxel.reads = {Quantity::stress_x};
    const SensorArray array = uneven_array(taxels);
    const LinearProblem problem = make_problem(array, silicone, on_grid(unknowns));
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<double> errors;
    int within = 0;
    constexpr int trials = 60;
    for (int k = 0; k < trials; ++k) {
      const RigidContact contact{.center = 7e-3 * uniform(generator),
                                 .half_width = taxel_depth * (1.2 + 0.8 * uniform(generator)),
                                 .friction = unknowns == 2 ? 0.6 * uniform(generator) : 0.0};
      std::vector<double> g = pressed(array, contact);
      const double sigma = 0.01 * largest(g);
      std::normal_distribution<double> noise(0.0, sigma);
      for (double& reading : g) reading += noise(generator);
      const Uncertain force = solve_by_evidence(problem, g, sigma).contact.normal;
      errors.push_back(std::abs(force.value / contact.force - 1.0));
      if (std::abs(force.value - contact.force) <= 2.0 * force.deviation) ++within;
    }
    std::sort(errors.begin(), errors.end());
    CAPTURE(unknowns, errors[trials / 2], errors[trials * 9 / 10], within);
    CHECK(errors[trials / 2] < (unknowns == 1 ? 0.05 : 0.12));
    CHECK(within >= 0.92 * trials);
  }
}

TEST_CASE("arrays at the edge of sense give finite, stable answers", "[uneven][hard]") {
  const std::vector<Quantity> normal = {Quantity::stress_x};
  Material layer = silicone;
  layer.layer = Layer{.thickness = 3e-3, .base = Base::bonded};
  std::vector<Taxel> many;
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 1000; ++i)
    many.push_back({.y = 1e-4 * (i + 0.9 * uniform(generator)),
                    .depth = taxel_depth * (0.8 + 0.4 * uniform(generator)),
                    .reads = normal});
  struct Case {
    const char* name;
    std::vector<Taxel> taxels;
    Material material;
    SurfaceOptions surface{.basis = SurfaceBasis::hats};
    std::size_t unknowns = 1;
  };
  const SurfaceOptions hats{.basis = SurfaceBasis::hats};
  const std::vector<Case> cases = {
      {"two taxels",
       {{.y = -1e-3, .depth = taxel_depth, .reads = normal},
        {.y = 1e-3, .depth = taxel_depth, .reads = normal}},
       silicone},
      {"one place, three depths",
       {{.y = 0.0, .depth = 1e-3, .reads = normal},
        {.y = 0.0, .depth = 2e-3, .reads = normal},
        {.y = 0.0, .depth = 3e-3, .reads = normal}},
       silicone},
      {"1e-6 of a depth apart",
       {{.y = -2e-3, .depth = taxel_depth, .reads = normal},
        {.y = 0.0, .depth = taxel_depth, .reads = normal},
        {.y = 1e-6 * taxel_depth, .depth = taxel_depth, .reads = normal}},
       silicone},
      {"one taxel per quantity",
       {{.y = -1e-3, .depth = taxel_depth, .reads = normal},
        {.y = 1e-3, .depth = taxel_depth, .reads = {Quantity::shear_xy}}},
       silicone,
       hats,
       2},
      {"at the base of a layer",
       {{.y = -1e-3, .depth = 3e-3, .reads = normal}, {.y = 2e-3, .depth = 3e-3, .reads = normal}},
       layer},
      {"no margin",
       {{.y = -3e-3, .depth = taxel_depth, .reads = normal},
        {.y = 0.0, .depth = taxel_depth, .reads = normal},
        {.y = 2e-3, .depth = taxel_depth, .reads = normal}},
       silicone,
       {.basis = SurfaceBasis::hats, .margin = 0.0}},
      {"a margin of ten depths",
       {{.y = -3e-3, .depth = taxel_depth, .reads = normal},
        {.y = 0.0, .depth = taxel_depth, .reads = normal},
        {.y = 2e-3, .depth = taxel_depth, .reads = normal}},
       silicone,
       {.basis = SurfaceBasis::hats, .margin = 10.0 * taxel_depth}},
      {"spacing 100 times finer than the taxels",
       {{.y = -3e-3, .depth = taxel_depth, .reads = normal},
        {.y = 0.0, .depth = taxel_depth, .reads = normal},
        {.y = 2.5e-3, .depth = taxel_depth, .reads = normal}},
       silicone,
       {.basis = SurfaceBasis::hats, .spacing = 2.5e-5}},
      {"a thousand", many, silicone, {.basis = SurfaceBasis::hats, .spacing = 4e-4}}};
  for (const Case& one : cases) {
    CAPTURE(one.name);
    const SensorArray array = uneven_array(one.taxels);
    const double middle = 0.5 * (one.taxels.front().y + one.taxels.back().y);
    const RigidContact contact{.center = middle, .half_width = taxel_depth, .force = 20.0};
    const std::vector<double> g = pressed(array, contact, one.material);
    const double sigma = 0.01 * largest(g);
    const LinearProblem problem =
        make_problem(array, one.material,
                     {.unknowns = one.unknowns,
                      .smoothing_length = taxel_depth,
                      .channel_rms = std::vector<double>(channel_count(array), sigma),
                      .surface = one.surface});
    const UncertainResultant found = solve_by_evidence(problem, g, 1.0).contact;
    CHECK(std::isfinite(found.normal.value));
    CHECK(found.normal.deviation > 0.0);
    CHECK(std::abs(found.normal.value - contact.force) <= 3.0 * found.normal.deviation);
  }
}

TEST_CASE("line loads over uneven taxels are refused", "[uneven]") {
  CHECK_THROWS_WITH(make_problem(palm(), silicone),
                    ContainsSubstring("needs taxels equally far apart"));
}
