// Each contact on a skin by itself, beside the sum.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tactile_net/skin/load.hpp"
#include "tactile_net/skin/resultant.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/slopes.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

constexpr double slip_limit = 0.5;
const SkinContact weaker_contact{
    .y = -4e-3, .z = 1e-3, .radius = 2.5e-3, .force = 0.5, .friction = 0.3, .direction = 0.4};
const SkinContact stronger_contact{.shape = SkinShape::ellipsoid,
                                   .y = 4e-3,
                                   .z = -2e-3,
                                   .radius = 3e-3,
                                   .second_radius = 2e-3,
                                   .angle = 0.6,
                                   .force = 0.8,
                                   .friction = 0.1,
                                   .direction = -2.0};

SurfaceGrid fine_grid() { return make_problem(square_skin(16, 2e-3), silicone).grid; }

std::vector<std::size_t> pressed_cells(const SurfaceGrid& grid, std::span<const double> means) {
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < grid.count(); ++cell)
    if (means[cell] > 0.0) cells.push_back(cell);
  return cells;
}

std::vector<ContactPatch> patches_in(const SurfaceGrid& grid, std::span<const double> means,
                                     const Covariance& covariance,
                                     const PatchOptions& options = {.friction_limit = slip_limit}) {
  return patches_of(grid, means, separate_contacts(grid, means, pressed_cells(grid, means)),
                    covariance, 2.0, options);
}

void check_same_number(const std::optional<Uncertain>& found,
                       const std::optional<Uncertain>& expected, double scale) {
  REQUIRE(found.has_value() == expected.has_value());
  if (!found) return;
  CHECK_THAT(found->value, WithinRel(expected->value, 1e-9) || WithinAbs(expected->value, scale));
  CHECK_THAT(found->deviation, WithinRel(expected->deviation, 1e-6));
}

}  // namespace

TEST_CASE("contacts on a skin are each what it is alone, and their sum is the whole",
          "[skin][contact_patch][property]") {
  const SurfaceGrid grid = fine_grid();
  const std::vector<double> means =
      cell_means(std::vector<SkinLoad>{weaker_contact, stronger_contact}, grid);
  const ErringTractions erring(4, means.size(), 3);
  const std::vector<ContactPatch> both = patches_in(grid, means, erring.covariance);
  REQUIRE(both.size() == 2);
  const auto alone = [&](const SkinContact& contact) {
    const std::vector<double> own = cell_means(std::vector<SkinLoad>{contact}, grid);
    const std::vector<ContactPatch> found = patches_in(grid, own, erring.covariance);
    REQUIRE(found.size() == 1);
    return found.front();
  };
  const ContactPatch first = alone(stronger_contact);
  const ContactPatch second = alone(weaker_contact);
  for (const auto& [found, expected] : {std::pair(&both[0], &first), {&both[1], &second}}) {
    CHECK(found->cells == expected->cells);
    check_same_number(found->wrench.normal, expected->wrench.normal, 0.0);
    check_same_number(found->wrench.tangential_y, expected->wrench.tangential_y, 0.0);
    check_same_number(found->wrench.tangential_z, expected->wrench.tangential_z, 0.0);
    check_same_number(found->wrench.centre_y, expected->wrench.centre_y, 0.0);
    check_same_number(found->wrench.centre_z, expected->wrench.centre_z, 0.0);
    check_same_number(found->wrench.torsion, expected->wrench.torsion, 1e-12);
    check_same_number(found->friction, expected->friction, 0.0);
    check_same_number(found->slip_margin, expected->slip_margin, 0.0);
    check_same_number(found->extent, expected->extent, 0.0);
    REQUIRE(found->ellipse);
    check_same_number(found->ellipse->radius, expected->ellipse->radius, 0.0);
    check_same_number(found->ellipse->angle, expected->ellipse->angle, 1e-9);
  }

  // Forces add up, and so do moments about the skin's own axes.
  const std::vector<std::size_t> cells = pressed_cells(grid, means);
  const UncertainWrench whole = resultant_of(grid, means, cells, erring.covariance, 2.0);
  double force = 0.0;
  double drag_y = 0.0;
  double drag_z = 0.0;
  double along_y = 0.0;
  double turning = 0.0;
  for (const ContactPatch& patch : both) {
    const UncertainWrench& one = patch.wrench;
    force += one.normal.value;
    drag_y += one.tangential_y->value;
    drag_z += one.tangential_z->value;
    along_y += one.normal.value * one.centre_y->value;
    turning += one.torsion->value +
               (one.centre_y->value - whole.centre_y->value) * one.tangential_z->value -
               (one.centre_z->value - whole.centre_z->value) * one.tangential_y->value;
  }
  CHECK_THAT(force, WithinRel(whole.normal.value, 1e-12));
  CHECK_THAT(drag_y, WithinRel(whole.tangential_y->value, 1e-12));
  CHECK_THAT(drag_z, WithinRel(whole.tangential_z->value, 1e-12));
  CHECK_THAT(along_y, WithinRel(whole.normal.value * whole.centre_y->value, 1e-10));
  CHECK_THAT(turning, WithinRel(whole.torsion->value, 1e-9));
}

TEST_CASE("the whole's margin is that of its worst contact", "[skin][contact_patch]") {
  const SurfaceGrid grid = fine_grid();
  SkinContact turned = stronger_contact;
  turned.shape = SkinShape::sphere;
  turned.second_radius = 0.0;
  turned.torsion = GENERATE(0.0, 6e-4);  // of 7e-4 at which it spins
  const std::vector<double> means = cell_means(std::vector<SkinLoad>{weaker_contact, turned}, grid);
  const ErringTractions erring(4, means.size(), 8);
  const std::optional<double> limit =
      GENERATE(std::optional<double>(slip_limit), std::optional<double>());
  const std::vector<ContactPatch> patches =
      patches_in(grid, means, erring.covariance, {.friction_limit = limit});
  const SkinFriction whole =
      *friction_of(grid, means, pressed_cells(grid, means), erring.covariance, 2.0, limit);
  REQUIRE(whole.contacts == 2);
  const ContactPatch* const worst = nearest_to_slipping(patches);
  REQUIRE(worst);
  check_same_number(worst->friction, whole.ratio, 0.0);
  check_same_number(worst->slip_margin, whole.slip_margin, 0.0);
  CHECK(worst->lever == whole.lever);
  if (limit)
    for (const ContactPatch& patch : patches)
      CHECK(patch.slip_margin->value >= whole.slip_margin->value - 1e-12);
}

TEST_CASE("deviations of a contact on a skin are the slopes of its values",
          "[skin][contact_patch][property]") {
  const SurfaceGrid grid = fine_grid();
  // In units in which its pressure is no larger than a step is small.
  std::vector<double> means = cell_means(std::vector<SkinLoad>{stronger_contact}, grid);
  const std::vector<std::vector<std::size_t>> cells{pressed_cells(grid, means)};
  const double highest = *std::max_element(means.begin(), means.end());
  for (double& value : means) value /= highest;
  const ErringTractions erring(3, means.size(), 6);
  const auto found = [&](std::span<const double> f) {
    return patches_of(grid, f, cells, erring.covariance, 2.0, {.friction_limit = slip_limit})
        .front();
  };
  const ContactPatch patch = found(means);
  const auto check = [&](const auto& of) {
    const double slopes = erring.deviation(
        means, [&](std::span<const double> moved) { return of(found(moved)).value; });
    CHECK_THAT(of(patch).deviation, WithinRel(2.0 * slopes, 1e-4));
  };
  check([](const ContactPatch& one) { return *one.wrench.torsion; });
  check([](const ContactPatch& one) { return *one.friction; });
  check([](const ContactPatch& one) { return *one.extent; });
  check([](const ContactPatch& one) { return one.ellipse->radius; });
  check([](const ContactPatch& one) { return drag_of(one.wrench); });
}

TEST_CASE("area: of an even pressure its own, of a sphere's 8/9 of the circle, turned or mirrored",
          "[skin][contact_patch]") {
  const SurfaceGrid grid = fine_grid();
  std::vector<double> even(3 * grid.count());
  std::vector<std::size_t> cells;
  for (std::size_t row = 8; row < 14; ++row)
    for (std::size_t column = 9; column < 13; ++column) {
      cells.push_back(row * grid.columns + column);
      even[cells.back()] = 7.0;
    }
  const ErringTractions erring(2, even.size(), 4);
  const std::vector<std::vector<std::size_t>> contacts{cells};
  const auto area = [&](double smoothed) {
    return *patches_of(grid, even, contacts, erring.covariance, 1e-6,
                       {.smoothed_variance = smoothed})
                .front()
                .extent;
  };
  const double own = 24.0 * grid.area();
  CHECK_THAT(area(0.0).value, WithinRel(own, 1e-12));
  // What may be a point has any area up to that.
  CHECK_THAT(area(1.0).value, WithinRel(0.5 * own, 1e-12));
  CHECK_THAT(area(1.0).deviation, WithinRel(own / std::sqrt(12.0), 1e-3));

  const auto of = [&](const SkinContact& contact) {
    const std::vector<double> means = cell_means(std::vector<SkinLoad>{contact}, grid);
    return patches_in(grid, means, erring.covariance).front();
  };
  const double circle = std::numbers::pi * 16e-6;
  CHECK_THAT(of({.radius = 4e-3, .force = 0.5}).extent->value, WithinRel(8.0 / 9.0 * circle, 0.05));
  SkinContact mirrored = stronger_contact;
  mirrored.y = -stronger_contact.y;
  mirrored.angle = -stronger_contact.angle;
  mirrored.direction = std::numbers::pi - stronger_contact.direction;
  const ContactPatch one = of(stronger_contact);
  const ContactPatch other = of(mirrored);
  CHECK_THAT(other.wrench.centre_y->value, WithinRel(-one.wrench.centre_y->value, 1e-4));
  CHECK_THAT(other.wrench.tangential_y->value, WithinRel(-one.wrench.tangential_y->value, 1e-4));
  CHECK_THAT(other.wrench.tangential_z->value, WithinRel(one.wrench.tangential_z->value, 1e-4));
  CHECK_THAT(other.slip_margin->value, WithinRel(one.slip_margin->value, 1e-4));
  CHECK_THAT(other.extent->value, WithinRel(one.extent->value, 1e-4));
  CHECK_THAT(other.ellipse->angle.value, WithinRel(-one.ellipse->angle.value, 1e-4));
}

TEST_CASE("a contact keeps its places on a grid that reaches less far", "[skin][contact_patch]") {
  const SurfaceGrid to{.rows = 5, .columns = 4, .spacing_y = 1.0, .spacing_z = 2.0};
  const SurfaceGrid from{.rows = 9, .columns = 8, .spacing_y = 1.0, .spacing_z = 2.0};
  ContactPatch patch;
  for (std::size_t row = 2; row < 5; ++row)
    for (std::size_t column = 2; column < 4; ++column)
      patch.cells.push_back(row * from.columns + column);
  const ContactPatch moved = on_grid(patch, from, to);
  REQUIRE(moved.cells.size() == patch.cells.size());
  for (std::size_t i = 0; i < patch.cells.size(); ++i) {
    CHECK(to.y(moved.cells[i] / to.columns) == from.y(patch.cells[i] / from.columns));
    CHECK(to.z(moved.cells[i] % to.columns) == from.z(patch.cells[i] % from.columns));
  }
  // What lies beyond is at the edge.
  patch.cells = {0, 1};
  CHECK(on_grid(patch, from, to).cells == std::vector<std::size_t>{0});
}
