#include <limits>

#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tests/catch.hpp"
#include "tests/skin/dragged_frame.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

/// Onto |q| <= limit p, by Moreau's two cones: what is left is in the polar one.
void project(std::vector<double>& f, double limit) {
  const std::size_t cells = f.size() / 3;
  for (std::size_t i = 0; i < cells; ++i) {
    double& p = f[i];
    const double drag = std::hypot(f[cells + i], f[2 * cells + i]);
    if (drag <= limit * p) continue;
    const double along = std::max(p + limit * drag, 0.0) / (1.0 + limit * limit);
    const double share = drag > 0.0 ? limit * along / drag : 0.0;
    p = along;
    f[cells + i] *= share;
    f[2 * cells + i] *= share;
  }
}

/// Nesterov's accelerated projected gradients with restarts: another way to the same minimum.
std::vector<double> by_gradients(const SkinFrame& frame, double alpha, double limit) {
  const Matrix p = normal_matrix(frame.problem, alpha);
  const std::vector<double> b = normal_right_side(frame.problem, frame.readings);
  double bound = 0.0;  // of the largest eigenvalue
  for (std::size_t i = 0; i < p.rows; ++i) {
    double sum = 0.0;
    for (const double entry : p.row(i)) sum += std::abs(entry);
    bound = std::max(bound, sum);
  }
  std::vector<double> f(b.size()), y = f;
  double t = 1.0;
  for (int step = 0; step < 20000; ++step) {
    const std::vector<double> image = product(p, y);
    std::vector<double> next = y;
    for (std::size_t i = 0; i < b.size(); ++i) next[i] -= (image[i] - b[i]) / bound;
    project(next, limit);
    double against = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) against += (y[i] - next[i]) * (next[i] - f[i]);
    if (against > 0.0) t = 1.0;
    const double after = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * t * t));
    for (std::size_t i = 0; i < b.size(); ++i)
      y[i] = next[i] + (t - 1.0) / after * (next[i] - f[i]);
    if (distance(next, f) <= 1e-12 * norm(next)) return next;
    f = next;
    t = after;
  }
  return f;
}

}  // namespace

TEST_CASE("the cone's tractions are those of projected gradients", "[skin][cone]") {
  const double weight = GENERATE(1.0, 4.0);
  // More unknowns than readings, and as many: these are factored in another way.
  const auto grid =
      GENERATE(SkinGridOptions{.margin = 1e-3}, SkinGridOptions{.spacing = 2e-3, .margin = 0.0});
  CAPTURE(weight, grid.spacing.value_or(0.0));
  const SkinFrame frame = dragged_frame(5, 11, {.tangential_weight = weight, .grid = grid});
  if (grid.spacing) REQUIRE(frame.problem.kernel.columns <= frame.problem.kernel.rows);
  for (const double alpha : {1e-2, 1e-3}) {
    const double limit = 0.5;
    const ConeSolution found = ConeTikhonov(frame.problem, alpha, {.friction_limit = limit})
                                   .solve(frame.readings, 20000, 1e-11);
    REQUIRE(found.status == FrameStatus::ok);
    CHECK(found.verdict == ConstrainedVerdict::ok);
    CHECK(found.residual <= 1e-11);
    const std::vector<double> expected = by_gradients(frame, alpha, limit);
    CHECK(distance(found.tractions, expected) <= 1e-7 * norm(expected));
  }
}

TEST_CASE("nothing pulls, and friction keeps its limit in every cell", "[skin][cone][property]") {
  const SkinFrame frame = dragged_frame(8, 11);
  const double limit = 0.3;
  const ConeSolution found =
      ConeTikhonov(frame.problem, 1e-3, {.friction_limit = limit}).solve(frame.readings);
  REQUIRE(found.verdict == ConstrainedVerdict::ok);
  const std::size_t cells = frame.problem.grid.count();
  CHECK(found.separation + found.slip + found.stick == cells);
  CHECK(found.slip > 0);
  CHECK(found.separation > 0);
  std::size_t touching = 0;
  for (std::size_t i = 0; i < cells; ++i) {
    const double p = found.tractions[i];
    const double drag = std::hypot(found.tractions[cells + i], found.tractions[2 * cells + i]);
    CHECK(p >= 0.0);
    CHECK(drag <= limit * p * (1.0 + 1e-14));
    touching += p > 0.0;
  }
  CHECK(touching == found.slip + found.stick);
  CHECK(found.face.free.size() == 2 * found.slip + 3 * found.stick);
}

TEST_CASE("a cone of another alpha is the one made anew, to the last bit", "[skin][cone]") {
  const auto grid = GENERATE(SkinGridOptions{}, SkinGridOptions{.spacing = 2e-3, .margin = 0.0});
  const bool offsets = GENERATE(false, true);
  const SkinFrame frame = dragged_frame(6, 11, {.grid = grid, .unknown_offsets = offsets});
  const Constraints held{.friction_limit = 0.5};
  const ConeTikhonov first(frame.problem, 1e-1, held);
  for (const double alpha : {1e-1, 1e-3, 1e-5}) {
    CAPTURE(alpha);
    const ConeSolution expected = ConeTikhonov(frame.problem, alpha, held).solve(frame.readings);
    const ConeSolution found = first.with_alpha(alpha).solve(frame.readings);
    REQUIRE(found.status == FrameStatus::ok);
    CHECK(found.tractions == expected.tractions);
    CHECK(found.iterations == expected.iterations);
    CHECK(found.residual == expected.residual);
  }
  CHECK(first.with_alpha(1e-5).solve(frame.readings).tractions !=
        first.solve(frame.readings).tractions);
  CHECK_THROWS_WITH(first.with_alpha(0.0), ContainsSubstring("alpha"));
}

TEST_CASE("a family on the face finds the cone's tractions again", "[skin][cone][family]") {
  const SkinFrame frame = dragged_frame(8, 11, {.tangential_weight = 2.0});
  const double alpha = 1e-3;
  const ConeSolution found = ConeTikhonov(frame.problem, alpha, {.friction_limit = 0.8})
                                 .solve(frame.readings, 5000, 1e-10);
  REQUIRE(found.stick > 0);
  const TikhonovFamily face(frame.problem, found.face);
  const std::vector<double> f = face.solve(face.analyse(frame.readings), alpha);
  // A face is flat where the cone is round: equal to first order only where nothing slides.
  CHECK(distance(f, found.tractions) <= 0.1 * norm(found.tractions));

  // Without friction's limit a face is flat: equal.
  const ConeSolution pressed =
      ConeTikhonov(frame.problem, alpha, {.nonnegative = true}).solve(frame.readings, 20000, 1e-12);
  const TikhonovFamily flat(frame.problem, pressed.face);
  CHECK(distance(flat.solve(flat.analyse(frame.readings), alpha), pressed.tractions) <=
        1e-6 * norm(pressed.tractions));
}

TEST_CASE("a face's family is the least, whichever way its stabiliser is factored",
          "[skin][cone][family]") {
  // A thousand cells and more in a smoothing length go by a QR, fewer by a sparse root.
  for (const double cells : {1.0, 900.0, 1100.0}) {
    SkinFrame frame = dragged_frame(6, 11, {.tangential_weight = 3.0});
    frame.problem.smoothing_length = cells * frame.problem.grid.spacing_y;
    const double alpha = 1e-3 / (1.0 + cells * cells);
    ActiveFace face;  // every other cell: half of them slide, half stick
    for (std::size_t cell = 0; cell < frame.problem.grid.count(); cell += 2) {
      if (cell % 4 == 0) {
        face.free.push_back({cell, {0.8, 0.36, 0.48}});
        face.free.push_back({cell, {0.0, -0.8, 0.6}});
      } else {
        for (std::size_t u = 0; u < 3; ++u) {
          face.free.push_back({cell, {}});
          face.free.back().along[u] = 1.0;
        }
      }
    }
    const TikhonovFamily family(frame.problem, face);
    const std::vector<double> f = family.solve(family.analyse(frame.readings), alpha);
    // P f = b along every direction that is free, and f holds no other.
    const std::vector<double> image = product(normal_matrix(frame.problem, alpha), f);
    const std::vector<double> right = normal_right_side(frame.problem, frame.readings);
    double left = 0.0;
    double whole = 0.0;
    for (const auto& [cell, along] : face.free) {
      double gradient = 0.0;
      double of_right = 0.0;
      for (std::size_t u = 0; u < 3; ++u) {
        const std::size_t i = u * frame.problem.grid.count() + cell;
        gradient += along[u] * (image[i] - right[i]);
        of_right += along[u] * right[i];
      }
      left = std::hypot(left, gradient);
      whole = std::hypot(whole, of_right);
    }
    CAPTURE(cells);
    CHECK(norm(f) > 0.0);
    CHECK(left <= 1e-8 * whole);
    for (std::size_t cell = 1; cell < frame.problem.grid.count(); cell += 2) CHECK(f[cell] == 0.0);
    // And a sum's deviation is that of its own variance.
    const TractionCovariance covariance(family, alpha, alpha);
    const std::vector<double> deviations = covariance.deviations();
    std::vector<double> one(f.size());
    one[0] = 2.0;
    CHECK_THAT(covariance.deviation(one), WithinRel(2.0 * deviations[0], 1e-9));
    CHECK_THAT(std::sqrt(covariance.covariance(one, one)), WithinRel(2.0 * deviations[0], 1e-9));
  }
}

TEST_CASE("without constraints that bind the cone's tractions are the family's", "[skin][cone]") {
  const SkinFrame frame = dragged_frame(6, 11);
  const TikhonovFamily family(frame.problem);
  const std::vector<double> free = family.solve(family.analyse(frame.readings), 1e-2);
  const ConeSolution found =
      ConeTikhonov(frame.problem, 1e-2, {.nonnegative = false}).solve(frame.readings, 5000, 1e-12);
  CHECK(distance(found.tractions, free) <= 1e-10 * norm(free));
}

TEST_CASE("a dense array's cone is found within the steps that were promised", "[skin][cone]") {
  const SkinFrame frame = dragged_frame(16, 11);
  const double alpha = GENERATE(1e-3, 1e-4, 1e-5);
  CAPTURE(alpha);
  const ConeSolution found =
      ConeTikhonov(frame.problem, alpha, {.friction_limit = 0.8}).solve(frame.readings);
  CHECK(found.verdict == ConstrainedVerdict::ok);
  CHECK(found.residual <= 1e-6);
  CHECK(found.iterations <= 500);
}

TEST_CASE("the constraints take away half of the error", "[skin][cone][alpha]") {
  const SkinArray skin = square_skin(10, 2e-3);
  const LinearProblem problem = make_problem(skin, silicone);
  const TikhonovFamily family(problem);
  std::mt19937 random(31);
  double without = 0.0;
  double with = 0.0;
  for (int contact = 0; contact < 6; ++contact) {
    const std::vector<SkinLoad> loads = random_contacts(random, 5e-3);
    const std::vector<double> truth = cell_means(loads, problem.grid);
    std::vector<double> readings = exact_readings(skin, silicone, loads);
    (void)add_noise(readings, 0.01, random);
    const FilterFrame frame = family.analyse(readings);
    const AlphaChoice chosen = choose_alone(frame, AlphaRule::aicc);
    without += distance(family.solve(frame, chosen.alpha), truth) / norm(truth);
    const double alpha = constrained_alpha(chosen.rule, chosen.alpha);
    with +=
        distance(ConeTikhonov(problem, alpha, {.friction_limit = 0.8}).solve(readings).tractions,
                 truth) /
        norm(truth);
  }
  CHECK(with <= 0.8 * without);
}

TEST_CASE("a frame that stops early, is none, or is empty, is said to be so", "[skin][cone]") {
  const SkinFrame frame = dragged_frame(6, 11);
  const ConeTikhonov cone(frame.problem, 1e-5, {.friction_limit = 0.8});
  const ConeSolution early = cone.solve(frame.readings, 3);
  CHECK(early.verdict == ConstrainedVerdict::iteration_limit);
  CHECK(early.iterations == 3);
  CHECK(early.residual > 1e-6);
  CHECK(cone.solve(std::vector<double>(3)).status == FrameStatus::wrong_size);
  std::vector<double> readings = frame.readings;
  readings[4] = std::numeric_limits<double>::quiet_NaN();
  CHECK(cone.solve(readings).status == FrameStatus::not_finite);
  const ConeSolution silent = cone.solve(std::vector<double>(readings.size()));
  CHECK(silent.status == FrameStatus::ok);
  CHECK(silent.separation == frame.problem.grid.count());
  CHECK(norm(silent.tractions) == 0.0);
  CHECK(silent.face.free.empty());
  CHECK_THROWS_WITH(TikhonovFamily(frame.problem, silent.face), ContainsSubstring("held at zero"));
  CHECK_THROWS_WITH(TikhonovFamily(frame.problem, ActiveFace{{{10000, {1.0, 0.0, 0.0}}}}),
                    ContainsSubstring("another problem"));
  CHECK_THROWS_WITH(ConeTikhonov(frame.problem, 1.0, {.friction_limit = 0.0}),
                    ContainsSubstring("friction_limit"));
  CHECK_THROWS_WITH(ConeTikhonov(frame.problem, 0.0, {}), ContainsSubstring("alpha"));
  const LinearProblem one = make_problem(square_skin(4, 2e-3), silicone, {.components = 1});
  CHECK_THROWS_WITH(ConeTikhonov(one, 1.0, {.friction_limit = 1.0}),
                    ContainsSubstring("tangential"));
  CHECK(ConeTikhonov(one, 1.0, {}).solve(std::vector<double>(48, 1.0)).status == FrameStatus::ok);
}
