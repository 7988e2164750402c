// The study of a skin: every error against a solution that this file computes by itself.
#include <algorithm>
#include <string>
#include <vector>

#include "study/array_sizes.hpp"
#include "study/circuits.hpp"
#include "study/kronecker_sum.hpp"
#include "study/matrix_gradients.hpp"
#include "study/planned_frame.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"
#include "tactile_net/study/tradeoff.hpp"
#include "tests/catch.hpp"
#include "tests/study/ticking.hpp"

using namespace tactile_net;
using namespace tactile_net::study;
using test::ticking;

namespace {

using Family = WorkCurve::Family;

const std::string pressed_skin = R"(
[sensor]
rows = 4
columns = 4
pitch = 2.0
depth = 2.0
reads = ["stress_x", "shear_xy", "shear_xz"]
[material]
youngs_modulus = 0.25
poisson_ratio = 0.48
[[contact]]
shape = "sphere"
place = [0.4, -0.3]
radius = 2.5
force = 0.5
friction = 0.4
direction = 30.0
[noise]
rms = 1e-4
[reconstruct]
alpha = 1e-3
)";

Study study_of(const std::string& text, bool circuits = false) {
  return tradeoff(parse_any_scene(text, "skin.toml"), {.circuits = circuits, .clock = ticking});
}

const Study& digital_skin_study() {
  static const Study study = study_of(pressed_skin + "friction_limit = 0.8\n");
  return study;
}

std::vector<WorkPoint> of(const Study& study, Family family) {
  std::vector<WorkPoint> points = study.points();
  std::erase_if(points, [&](const WorkPoint& point) {
    return point.curve.family != family || point.knob.kind == Knob::Kind::array;
  });
  return points;
}

/// P^-1 b by Gauss' elimination: nothing of the room, nothing of its references.
std::vector<double> eliminated(const StudyInput& input) {
  const LinearProblem& problem = input.skin().problem();
  Matrix p = normal_matrix(problem, input.alpha);
  std::vector<double> f = normal_right_side(problem, input.readings);
  const std::size_t n = f.size();
  for (std::size_t k = 0; k < n; ++k)  // definite: without pivots
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = p(i, k) / p(k, k);
      for (std::size_t j = k; j < n; ++j) p(i, j) -= factor * p(k, j);
      f[i] -= factor * f[k];
    }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) f[k] -= p(k, j) * f[j];
    f[k] /= p(k, k);
  }
  return f;
}

}  // namespace

TEST_CASE("a skin's reference is the solution of its normal equations", "[tradeoff][skin]") {
  const StudyInput& input = digital_skin_study().input;
  CHECK(digital_skin_study().complete);
  CHECK(input.is_skin());
  CHECK(relative_l2_error(eliminated(input), input.solution) < 1e-10);
  CHECK(input.agreement < 1e-12);
  CHECK(input.truth.size() == 3);
  CHECK(input.solution_error > 0.01);
}

TEST_CASE("exact methods of a skin have no error, and the classes are the dense matrix to 1e-12",
          "[tradeoff][skin]") {
  for (const Family family : {Family::singular_values, Family::factorisation}) {
    REQUIRE(of(digital_skin_study(), family).size() == 1);
    CHECK(*of(digital_skin_study(), family).front().error_to_solution < 1e-11);
  }
  std::size_t found = 0;
  for (const WorkPoint& point : of(digital_skin_study(), Family::product)) {
    if (point.knob.kind != Knob::Kind::none) continue;
    REQUIRE(point.measured());
    ++found;
    CHECK(*point.error_to_solution < (point.curve.precision == Precision::float64 ? 1e-12 : 1e-4));
  }
  CHECK(found == 4);  // dense and classes, double and single
}

TEST_CASE("every point of a skin's study has the error that an elimination finds",
          "[tradeoff][skin]") {
  const StudyInput& input = digital_skin_study().input;
  const std::vector<double> exact = eliminated(input);
  std::vector<double> f(exact.size());
  const auto holds = [&](const WorkPoint& point) {
    CAPTURE(static_cast<int>(point.curve.family), point.knob.count);
    const double found = relative_l2_error(f, exact);
    CHECK_THAT(*point.error_to_solution, WithinRel(found, 1e-3) || WithinAbs(found, 1e-9));
  };
  const lab::SkinSceneProblem& skin = input.skin();
  const KroneckerTerms terms(skin.problem(), skin.family().reconstruction(input.alpha));
  std::size_t sums = 0;
  for (const WorkPoint& point : of(digital_skin_study(), Family::kronecker))
    for (double accuracy = 0.3; accuracy > 1e-13; accuracy *= 0.2) {
      KroneckerSum sum = terms.sum(accuracy);
      if (sum.terms() != point.knob.count) continue;
      sum.apply(input.readings, f);
      holds(point);
      ++sums;
      break;
    }
  CHECK(sums > 5);
  LargeSkinTikhonov by_fft(skin.scene().sensor, skin.scene().material, skin.options(), input.alpha);
  REQUIRE_FALSE(of(digital_skin_study(), Family::conjugate_gradients).empty());
  for (const WorkPoint& point : of(digital_skin_study(), Family::conjugate_gradients)) {
    REQUIRE(by_fft.solve(input.readings, f, 1e-300, point.knob.count) == FrameStatus::ok);
    holds(point);
  }
  const SkinMatrixGradients by_matrix(skin.problem(), input.alpha);
  REQUIRE(of(digital_skin_study(), Family::matrix_gradients).size() > 3);
  for (const WorkPoint& point : of(digital_skin_study(), Family::matrix_gradients)) {
    REQUIRE(by_matrix.solve(input.readings, f, point.knob.count) == FrameStatus::ok);
    holds(point);
  }
}

TEST_CASE("more steps and more terms are nearer to the exact solution of a skin",
          "[tradeoff][skin]") {
  for (const Family family :
       {Family::kronecker, Family::conjugate_gradients, Family::matrix_gradients}) {
    const std::vector<WorkPoint> points = of(digital_skin_study(), family);
    REQUIRE_FALSE(points.empty());
    // One tile holds these cells, and its inverse is that of all.
    if (family != Family::conjugate_gradients) {
      CHECK(points.size() > 3);
      CHECK(*points.front().error_to_solution > 1e-3);
    }
    CHECK(*points.back().error_to_solution < 1e-8);
    for (std::size_t i = 1; i < points.size(); ++i) {
      CAPTURE(static_cast<int>(family), points[i].knob.count);
      CHECK(points[i].knob.count > points[i - 1].knob.count);
      CHECK(*points[i].error_to_solution < 1.01 * *points[i - 1].error_to_solution + 1e-12);
    }
  }
}

TEST_CASE("constraints end at their optimum, nearer to the truth; fewer cells are further off",
          "[tradeoff][skin]") {
  const std::vector<WorkPoint> planned = of(digital_skin_study(), Family::planned_constraints);
  REQUIRE(planned.size() == 7);
  for (const WorkPoint& point : planned) REQUIRE(point.measured());
  CHECK(planned.back().knob.count == 64);
  CHECK(*planned.back().error_to_truth < *planned.front().error_to_truth);
  const std::vector<WorkPoint> cone = of(digital_skin_study(), Family::friction_cone);
  CHECK_THAT(*planned.back().error_to_truth, WithinRel(*cone.back().error_to_truth, 0.01));
  REQUIRE(cone.size() > 1);
  CHECK(cone.back().knob.optimal);
  CHECK_FALSE(cone.front().knob.optimal);
  CHECK_FALSE(cone.back().error_to_solution);
  CHECK(*cone.back().error_to_truth < digital_skin_study().input.solution_error);
  const std::vector<WorkPoint> coarse = of(digital_skin_study(), Family::coarser_surface);
  REQUIRE(coarse.size() == 1);  // two cells a taxel, one
  CHECK(coarse.front().knob.count == 36);
  CHECK_FALSE(coarse.front().error_to_solution);
  CHECK(*coarse.front().error_to_truth > 0.5 * digital_skin_study().input.solution_error);
  CHECK(*coarse.front().error_to_truth < 1.0);
}

TEST_CASE("a plan of a shape streams the bytes of the real plan of that size", "[tradeoff][skin]") {
  const StudyInput& input = digital_skin_study().input;
  const SkinScene& scene = input.skin().scene();
  for (const Structure structure : {Structure::dense, Structure::reflections})
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      PlannerOptions options;
      options.structure = structure;
      options.precision = precision;
      options.accuracy = one_percent;
      const SkinScene twelve = with_size(scene, size_of(scene, 12), 2.0);
      const EstimatorPlan pattern =
          plan_of({.problem = lab::SkinSceneProblem(twelve), .alpha = input.alpha}, options).plan;
      CHECK(pattern.reconstruction.row_grid.partners.empty() == (structure == Structure::dense));
      for (const std::size_t side : {2U, 4U, 7U}) {
        CAPTURE(static_cast<int>(structure), side);
        const ArraySize size = size_of(scene, side);
        CHECK((size.rows == side && size.columns == side));
        const SkinScene other = with_size(scene, size);
        const EstimatorPlan real =
            plan_of({.problem = lab::SkinSceneProblem(other), .alpha = input.alpha}, options).plan;
        const bool exchanged = !real.reconstruction.row_grid.partners.empty();
        const EstimatorPlan shaped =
            shaped_plan(exchanged ? pattern : without_exchange(pattern), size, grid(other));
        CHECK(streamed_bytes(shaped.reconstruction) == streamed_bytes(real.reconstruction));
        CHECK(shaped.tractions() == real.tractions());
        CHECK(shaped.readings() == real.readings());
        CHECK_NOTHROW(check(shaped));
      }
    }
}

TEST_CASE("arrays of other sizes are timed, keep their proportions, and have no error",
          "[tradeoff][skin]") {
  std::vector<WorkPoint> sizes = digital_skin_study().points();
  std::erase_if(sizes, [](const WorkPoint& point) { return point.knob.kind != Knob::Kind::array; });
  CHECK(sizes.size() >= 24);
  for (const WorkPoint& point : sizes) {
    CHECK(point.measured());
    CHECK(point.seconds > 0.0);
    CHECK_FALSE(point.error_to_solution);
    CHECK_FALSE(point.error_to_truth);
  }
  SkinScene oblong = digital_skin_study().input.skin().scene();
  oblong.sensor.columns = 2;
  CHECK((size_of(oblong, 16).rows == 16 && size_of(oblong, 16).columns == 8));
  const std::vector<std::string> text = report::sizes_in_words(digital_skin_study());
  REQUIRE(text.size() == 1);
  CHECK_THAT(text.front(), StartsWith("in a loop of 1 kHz a frame of 16 x 16 such taxels takes") &&
                               ContainsSubstring("; one of 32 x 32 such taxels takes"));
}

TEST_CASE("circuits too large for operating points and draws are named, with their size",
          "[tradeoff][skin]") {
  struct NeverAsked final : Simulator {
    Simulation run(const std::string&) override {
      throw SimulatorError(SimulatorError::Cause::not_installed, "asked", {});
    }
  } simulator;
  const StudyInput input = study_input(
      parse_any_scene(pressed_skin.substr(0, pressed_skin.find("rows = 4")) + "rows = 9" +
                          pressed_skin.substr(pressed_skin.find("rows = 4") + 8),
                      "skin.toml"));
  const StudySection section = operating_points(input, simulator);
  REQUIRE_FALSE(section.points.empty());
  for (const WorkPoint& point : section.points) {
    CHECK_FALSE(point.measured());
    REQUIRE(point.failure);
    CHECK_THAT(point.failure->what,
               ContainsSubstring("108 residuals") && ContainsSubstring("more than 200"));
  }
}

TEST_CASE("uneven and partly dead skins are studied without what they lack",
          "[tradeoff][skin][long]") {
  const Study dead = study_of(pressed_skin + "[dead_taxels]\nindices = [\"1_1\"]\n");
  CHECK(dead.complete);
  CHECK(*of(dead, Family::singular_values).front().error_to_solution < 1e-11);
  for (const WorkPoint& point : of(dead, Family::product))
    if (point.knob.kind == Knob::Kind::none && point.curve.precision == Precision::float64)
      CHECK(*point.error_to_solution < 1e-11);
  CHECK(*of(dead, Family::matrix_gradients).back().error_to_solution < 1e-8);

  const Study palm =
      tradeoff(read_any_scene(SCENES "/skins/palm.toml"), {.circuits = false, .clock = ticking});
  CHECK(palm.complete);
  CHECK(of(palm, Family::kronecker).empty());
  const auto by_fft = of(palm, Family::conjugate_gradients);
  REQUIRE(by_fft.size() == 1);
  REQUIRE(by_fft.front().failure);
  CHECK_THAT(by_fft.front().failure->what, ContainsSubstring("lattice"));
  CHECK(report::sizes_in_words(palm).empty());
}
