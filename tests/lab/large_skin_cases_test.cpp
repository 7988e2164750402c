// Hard cases of skins without a matrix: beside the dense answer, and laws that need none.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tests/lab/large_skins.hpp"

using namespace tactile_net;

namespace {

const std::string given = "[reconstruct]\ntangential_weight = 1.0\nalpha = ";
const std::string limited =
    "[reconstruct]\ntangential_weight = 1.0\nfriction_limit = 0.6\nalpha = ";

struct Answers {
  lab::FrameAnswer large, dense;
};

Answers answers_of(const SkinScene& scene, const std::vector<double>& readings) {
  return {lab::solve(without_matrix(scene), readings),
          lab::solve(lab::SkinSceneProblem(scene), readings)};
}

Answers answers_of(const SkinScene& scene) {
  return answers_of(scene, lab::simulate(scene).readings);
}

bool all_finite(const lab::FrameAnswer& answer) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::all_of(answer.tractions.begin(), answer.tractions.end(), finite) &&
         std::all_of(answer.deviations.begin(), answer.deviations.end(), finite) &&
         finite(answer.wrench.normal.value) && finite(answer.wrench.normal.deviation);
}

void check_near(const std::optional<Uncertain>& found, const std::optional<Uncertain>& expected) {
  REQUIRE(found.has_value() == expected.has_value());
  if (!found) return;
  CAPTURE(found->value, found->deviation, expected->value, expected->deviation);
  CHECK(std::abs(found->value - expected->value) < 0.5 * expected->deviation);
  CHECK_THAT(found->deviation, WithinRel(expected->deviation, 0.15));
}

void check_alike(const Answers& both, double tolerance = 1e-6) {
  const auto& [large, dense] = both;
  CHECK(distance(large.tractions, dense.tractions) < tolerance * norm(dense.tractions));
  CHECK(large.verdict == dense.verdict);
  CHECK(large.data->doubts == dense.data->doubts);
  CHECK(large.patches.size() == dense.patches.size());
  CHECK_THAT(large.unseen, WithinAbs(dense.unseen, 0.01));
  CHECK(all_finite(large));
  // The prior of the bands hears probes of few readings: cells that hardly touch are not the same.
  std::vector<std::size_t> others;
  std::set_symmetric_difference(large.cells.begin(), large.cells.end(), dense.cells.begin(),
                                dense.cells.end(), std::back_inserter(others));
  CHECK(others.size() <= dense.cells.size() / 10);
  check_near(large.wrench.normal, dense.wrench.normal);
  check_near(large.wrench.tangential_y, dense.wrench.tangential_y);
  check_near(large.wrench.centre_y, dense.wrench.centre_y);
}

/// Taxels of some rows and columns of 12 x 11.
std::string dead(std::size_t first_row, std::size_t rows, std::size_t first_column,
                 std::size_t columns) {
  std::string list;
  for (std::size_t row = first_row; row < first_row + rows; ++row)
    for (std::size_t column = first_column; column < first_column + columns; ++column)
      list += (list.empty() ? "" : ", ") + std::to_string(11 * row + column);
  return "[dead_taxels]\nindices = [" + list + "]\n";
}

}  // namespace

TEST_CASE("a large skin with a row, a corner or half of it dead is answered as the dense one",
          "[lab][skin][large][hard][long]") {
  const std::string mask =
      GENERATE(dead(5, 1, 0, 11), dead(0, 4, 0, 4), dead(6, 6, 0, 11), dead(0, 12, 0, 5));
  CAPTURE(mask);
  check_alike(answers_of(millimetre_skin(mask + given + "1e-4\n")));
}

TEST_CASE("of any Poisson ratio a large skin's answer is the dense one",
          "[lab][skin][large][hard][long]") {
  const double ratio = GENERATE(1e-9, 0.5);
  const bool layer = GENERATE(false, true);
  CAPTURE(ratio, layer);
  SkinScene scene = millimetre_skin(given + "1e-4\n");
  scene.material.poisson_ratio = ratio;
  if (layer) scene.material.layer = Layer{4e-3, Base::bonded};
  check_alike(answers_of(scene));
}

namespace {
void check_contact_at(double y) {
  SkinScene scene = millimetre_skin(given + "1e-4\n");
  std::get<SkinContact>(scene.contacts.front()).y = y;
  std::get<SkinContact>(scene.contacts.front()).z = -0.7 * y;
  check_alike(answers_of(scene));
}
}  // namespace

TEST_CASE("a contact beyond a large skin's edge is what it is with a matrix",
          "[lab][skin][large][hard]") {
  check_contact_at(6e-3);
}

TEST_CASE("a contact at a large skin's edge is what it is with a matrix",
          "[lab][skin][large][hard][long]") {
  check_contact_at(4.5e-3);
}

TEST_CASE("two contacts on a large skin are those of the dense one", "[lab][skin][large][hard]") {
  SkinScene scene = millimetre_skin(given + "1e-4\n");
  auto second = std::get<SkinContact>(scene.contacts.front());
  second.y = -3.5e-3;
  second.z = 3.4e-3;
  second.force = 0.3;
  scene.contacts.push_back(second);
  std::get<SkinContact>(scene.contacts.front()).y = 3.2e-3;
  check_alike(answers_of(scene));
}

TEST_CASE("a large skin with hardly any smoothing is answered as the dense one",
          "[lab][skin][large][hard]") {
  for (const char* alpha : {"1e-8", "1e-12"}) {
    CAPTURE(alpha);
    const Answers both = answers_of(millimetre_skin(given + alpha + "\n"));
    REQUIRE(both.large.iteration);
    CAPTURE(both.large.iteration->steps, both.large.iteration->estimate);
    CHECK(both.large.verdict == both.dense.verdict);
    const double off = distance(both.large.tractions, both.dense.tractions);
    CHECK(off < 1e-5 * norm(both.dense.tractions));
  }
}

TEST_CASE("readings of 0 are a large skin that nothing touches", "[lab][skin][large][hard]") {
  const bool constrained = GENERATE(false, true);
  const SkinScene scene = millimetre_skin((constrained ? limited : given) + "1e-4\n");
  const Answers both = answers_of(scene, std::vector<double>(396));
  CHECK(norm(both.large.tractions) == 0.0);
  CHECK(both.large.verdict == both.dense.verdict);
  CHECK(both.large.cells.empty());
  CHECK(both.large.patches.empty());
  CHECK(both.large.wrench.normal.value == 0.0);
  CHECK(both.large.data->consistent());
  CHECK(all_finite(both.large));
}

TEST_CASE("one reading that is no number is refused by a large skin as by the dense one",
          "[lab][skin][large][hard]") {
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  const bool constrained = GENERATE(false, true);
  const SkinScene scene = millimetre_skin((constrained ? limited : given) + "1e-4\n");
  std::vector<double> readings = lab::simulate(scene).readings;
  readings[17] = bad;
  CHECK_THROWS_WITH(lab::solve(without_matrix(scene), readings), ContainsSubstring("not finite"));
  CHECK_THROWS_WITH(lab::solve(lab::SkinSceneProblem(scene), readings),
                    ContainsSubstring("not finite"));
}

TEST_CASE("what presses on a large skin is what was put on it", "[lab][skin][large][hard]") {
  // Without noise, and hardly smoothed: of forces the skin keeps the balance.
  SkinScene scene = millimetre_skin(given + "1e-7\n");
  const std::vector<double> readings = [&] {
    SkinScene silent = scene;
    silent.noise.reset();
    return lab::simulate(silent).readings;
  }();
  const lab::SkinSceneProblem problem = without_matrix(scene);
  const lab::FrameAnswer answer = lab::solve(problem, readings);
  const SurfaceGrid& grid = problem.grid();
  const auto sum = [&](Traction which) {
    const auto f = lab::component(answer.tractions, grid, which);
    return std::accumulate(f.begin(), f.end(), 0.0) * grid.area();
  };
  const double drag = 0.5 * 0.4;
  const double direction = 30.0 * std::numbers::pi / 180.0;
  CHECK_THAT(sum(Traction::normal), WithinRel(0.5, 0.01));
  // Of a uniform drag the readings tell least.
  CHECK_THAT(sum(Traction::tangential_y), WithinAbs(drag * std::cos(direction), 0.1 * drag));
  CHECK_THAT(sum(Traction::tangential_z), WithinAbs(drag * std::sin(direction), 0.1 * drag));
}
