// What must hold of lines and of skins alike: one law, two sensors.
#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/data_verdict.hpp"
#include "tactile_net/lab/planned_controller.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_answer.hpp"
#include "tactile_net/lab/skin_recording_solver.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/euclidean.hpp"
#include "tests/replaced.hpp"

using namespace tactile_net;

namespace {

/// What both have of a frame.
struct FrameNumbers {
  std::vector<double> tractions{}, deviations{};
  Uncertain force{};
  lab::ChosenAlpha alpha{};
  lab::Verdict verdict = lab::Verdict::ok;
  DataVerdict data{};
  std::vector<double> offsets{};
};

const std::string pad = "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n";
const std::string stated_noise = "[noise]\nrms = 1e-3\n";

/// A sensor's problem, and what its own scene reads.
template <class Problem>
struct SensorProblem {
  [[nodiscard]] std::vector<double> readings() const {
    return lab::simulate(problem.scene()).readings;
  }
  [[nodiscard]] FilterFrame analysed(std::span<const double> g) const {
    return problem.family().analyse(g);
  }

  Problem problem;
};

/// Taxels in a line, a third of their depth apart, that read two quantities.
struct Lines : SensorProblem<lab::SceneProblem> {
  static constexpr std::size_t taxels = 21, channels = 2;
  static constexpr const char* coarse = "pitch = 3.0";
  static inline const std::string sensor =
      "[sensor]\ncount = 21\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\", \"shear_xy\"]\n";
  static inline const std::string contact =
      "[[contact]]\nshape = \"cylinder\"\ncenter = 0.7\nhalf_width = 1.5\nforce = 1.0\n"
      "friction = 0.3\n";
  static constexpr const char* centre = "center = 0.7";
  /// A contact whose middle, or whose edge, lies above the last taxel.
  static constexpr const char* beyond = "center = 5.0";
  static constexpr const char* within = "center = 3.5";
  using Solver = lab::RecordingSolver;

  explicit Lines(const std::string& toml)
      : SensorProblem{lab::SceneProblem(parse_scene(toml, "line.toml"))} {}

  [[nodiscard]] static FrameNumbers answer(Solver& solver, std::vector<double> g) {
    FrameNumbers all{.tractions = std::vector<double>(solver.tractions())};
    const auto result = solver.solve(g, all.tractions);
    REQUIRE(result);
    REQUIRE(result->status == FrameStatus::ok);
    const lab::SceneFrame frame(solver.problem(), g);
    const lab::FrameUncertainty bands = lab::uncertainty(frame, all.tractions, *result);
    all.deviations = bands.deviation;
    all.force = bands.resultant.normal;
    all.offsets = bands.offsets;
    all.alpha = *result->alpha;
    all.verdict = result->verdict;
    all.data = *result->data;
    return all;
  }
  [[nodiscard]] Solver solver(lab::RecordingSolverOptions options = {}) const {
    return {problem, Method::tikhonov, options};
  }
  [[nodiscard]] FrameNumbers solve(const std::vector<double>& g) const {
    Solver one = solver();
    return answer(one, g);
  }
  /// The reading of taxel `t`'s mirror image, and what becomes of its sign.
  [[nodiscard]] static std::vector<double> mirrored_readings(const std::vector<double>& g) {
    std::vector<double> m(g.size());
    for (std::size_t t = 0; t < taxels; ++t) {
      m[t] = g[taxels - 1 - t];
      m[taxels + t] = -g[2 * taxels - 1 - t];
    }
    return m;
  }
  [[nodiscard]] static std::vector<double> mirrored_tractions(const std::vector<double>& f) {
    const std::size_t n = f.size() / 2;
    std::vector<double> m(f.size());
    for (std::size_t i = 0; i < n; ++i) {
      m[i] = f[n - 1 - i];
      m[n + i] = -f[2 * n - 1 - i];
    }
    return m;
  }
};

/// Taxels of a lattice that read three quantities.
struct Skins : SensorProblem<lab::SkinSceneProblem> {
  static constexpr std::size_t rows = 6, columns = 5, taxels = rows * columns, channels = 3;
  static constexpr const char* coarse = "pitch = 3.0";
  static inline const std::string sensor =
      "[sensor]\nrows = 6\ncolumns = 5\npitch = 0.7\ndepth = 1.5\n"
      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n";
  static inline const std::string contact =
      "[[contact]]\nshape = \"sphere\"\nplace = [0.3, -0.2]\nradius = 1.2\nforce = 1.0\n"
      "friction = 0.3\ndirection = 40.0\n";
  static constexpr const char* centre = "place = [0.3, -0.2]";
  static constexpr const char* beyond = "place = [1.75, 0.1]";
  static constexpr const char* within = "place = [0.55, 0.1]";
  using Solver = lab::SkinRecordingSolver;

  explicit Skins(const std::string& toml)
      : SensorProblem{
            lab::SkinSceneProblem(std::get<SkinScene>(parse_any_scene(toml, "skin.toml")))} {}

  [[nodiscard]] static FrameNumbers answer(Solver& solver, std::vector<double> g) {
    const auto found = solver.solve(g);
    REQUIRE(found);
    return {.tractions = found->tractions,
            .deviations = found->deviations,
            .force = found->wrench.normal,
            .alpha = found->alpha,
            .verdict = found->verdict,
            .data = found->data,
            .offsets = found->offsets};
  }
  [[nodiscard]] Solver solver(lab::RecordingSolverOptions options = {}) const {
    return Solver(problem, options);
  }
  [[nodiscard]] FrameNumbers solve(const std::vector<double>& g) const {
    Solver one = solver();
    return answer(one, g);
  }
  /// About y = 0: the drag along y turns its sign, and what reads it.
  [[nodiscard]] static std::vector<double> mirrored(const std::vector<double>& x, std::size_t down,
                                                    std::size_t across) {
    std::vector<double> m(x.size());
    for (std::size_t u = 0; u < 3; ++u)
      for (std::size_t r = 0; r < down; ++r)
        for (std::size_t c = 0; c < across; ++c)
          m[(u * down + r) * across + c] =
              (u == 1 ? -1.0 : 1.0) * x[(u * down + down - 1 - r) * across + c];
    return m;
  }
  [[nodiscard]] static std::vector<double> mirrored_readings(const std::vector<double>& g) {
    return mirrored(g, rows, columns);
  }
  [[nodiscard]] std::vector<double> mirrored_tractions(const std::vector<double>& f) const {
    return mirrored(f, problem.grid().rows, problem.grid().columns);
  }
};

template <class Sensor>
std::string scene(const std::string& more = "[reconstruct]\ntangential_weight = 1.0\n",
                  const std::string& noise = stated_noise) {
  return Sensor::sensor + pad + Sensor::contact + noise + more;
}

std::vector<double> scaled(std::vector<double> x, double factor) {
  for (double& value : x) value *= factor;
  return x;
}

/// The distance of `x` from `factor` times `y`, over the latter's norm.
double apart(const std::vector<double>& x, const std::vector<double>& y, double factor = 1.0) {
  REQUIRE(x.size() == y.size());
  const std::vector<double> expected = scaled(y, factor);
  return distance(x, expected) / norm(expected);
}

}  // namespace

TEMPLATE_TEST_CASE("readings a thousand times as large under such noise are the same contact",
                   "[lab][laws]", Lines, Skins) {
  const TestType small(scene<TestType>());
  const TestType large(replaced(scene<TestType>(), "rms = 1e-3", "rms = 1.0"));
  const FrameNumbers one = small.solve(small.readings());
  const FrameNumbers other = large.solve(scaled(small.readings(), 1e3));
  CHECK(apart(other.tractions, one.tractions, 1e3) < 1e-8);
  CHECK(apart(other.deviations, one.deviations, 1e3) < 1e-6);
  CHECK_THAT(other.alpha.value / 1e-6, WithinRel(one.alpha.value / 1e-6, 1e-6));
  CHECK(other.verdict == one.verdict);
  CHECK(other.alpha.verdict == one.alpha.verdict);
}

TEMPLATE_TEST_CASE("units do not matter", "[lab][laws]", Lines, Skins) {
  const TestType plain(scene<TestType>());
  // A length of 1 mm and stresses of 1 kPa: forces are in their product.
  const TestType named("[units]\nlength = \"mm\"\nmodulus = \"kPa\"\nstress = \"kPa\"\nforce = " +
                       std::string(std::is_same_v<TestType, Lines> ? "\"N/m\"" : "\"mN\"") + "\n" +
                       scene<TestType>());
  const std::vector<double> g = plain.readings();
  CHECK(apart(named.readings(), g, 1e3) < 1e-12);
  const FrameNumbers one = plain.solve(g);
  const FrameNumbers other = named.solve(scaled(g, 1e3));
  CHECK(apart(other.tractions, one.tractions, 1e3) < 1e-8);
  CHECK(apart(other.deviations, one.deviations, 1e3) < 1e-6);
  CHECK(other.verdict == one.verdict);
  CHECK(other.data.doubts == one.data.doubts);
}

TEMPLATE_TEST_CASE("what is mirrored is answered by the mirror image", "[lab][laws]", Lines,
                   Skins) {
  const TestType sensor(scene<TestType>());
  const std::vector<double> g = sensor.readings();
  const FrameNumbers one = sensor.solve(g);
  const FrameNumbers other = sensor.solve(TestType::mirrored_readings(g));
  CHECK(apart(other.tractions, sensor.mirrored_tractions(one.tractions)) < 1e-8);
  CHECK_THAT(other.force.value, WithinRel(one.force.value, 1e-8));
  CHECK_THAT(other.force.deviation, WithinRel(one.force.deviation, 1e-6));
  CHECK(other.verdict == one.verdict);
}

TEMPLATE_TEST_CASE("an unknown offset of any size changes nothing but what is said of it",
                   "[lab][laws]", Lines, Skins) {
  const TestType sensor(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\noffset = true\n"));
  const std::vector<double> g = sensor.readings();
  const FrameNumbers one = sensor.solve(g);
  for (const double size : {0.2, 30.0}) {
    std::vector<double> shifted = g;
    for (std::size_t i = 0; i < g.size(); ++i)
      shifted[i] += size * static_cast<double>(1 + i / TestType::taxels);
    const FrameNumbers other = sensor.solve(shifted);
    CAPTURE(size);
    CHECK(apart(other.tractions, one.tractions) < 1e-7 * (1.0 + size));
    CHECK_THAT(other.force.deviation, WithinRel(one.force.deviation, 1e-6 * (1.0 + size)));
    CHECK(other.verdict == one.verdict);
    CHECK(other.data.doubts == one.data.doubts);
    REQUIRE(other.offsets.size() == TestType::channels);
    for (std::size_t c = 0; c < TestType::channels; ++c)
      CHECK_THAT(other.offsets[c] - one.offsets[c],
                 WithinAbs(size * static_cast<double>(1 + c), 1e-6 * (1.0 + size)));
  }
}

TEMPLATE_TEST_CASE("what a dead taxel reads, and whether it is missing or stated, is all the same",
                   "[lab][laws]", Lines, Skins) {
  constexpr std::size_t dead = TestType::taxels / 2;
  const TestType whole(scene<TestType>());
  const TestType stated(scene<TestType>() + "[dead_taxels]\nindices = [" + std::to_string(dead) +
                        "]\n");
  std::vector<double> g = whole.readings();
  const auto set = [&](double value) {
    for (std::size_t c = 0; c < TestType::channels; ++c) g[c * TestType::taxels + dead] = value;
    return g;
  };
  const FrameNumbers one = stated.solve(set(0.0));
  CHECK(stated.solve(set(1e6)).tractions == one.tractions);
  auto solver = whole.solver({.missing = lab::Missing::estimate});
  const FrameNumbers estimated = TestType::answer(solver, set(std::nan("")));
  CHECK(apart(estimated.tractions, one.tractions) < 1e-9);
  CHECK(apart(estimated.deviations, one.deviations) < 1e-9);
  CHECK(estimated.verdict == one.verdict);
}

TEMPLATE_TEST_CASE("a controller finds what solve finds, with offsets, dead taxels, both or none",
                   "[lab][laws]", Lines, Skins) {
  const bool offset = GENERATE(false, true);
  const bool dead = GENERATE(false, true);
  CAPTURE(offset, dead);
  const TestType sensor(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\nalpha = 1e-4\n" +
                                        std::string(offset ? "offset = true\n" : "")) +
                        (dead ? "[dead_taxels]\nindices = [7]\n" : ""));
  const lab::PlannedController planned =
      lab::plan_controller(sensor.problem, *lab::plan_alpha(sensor.problem));
  ContactEstimator estimator(planned.estimator.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate estimate{.tractions = f};
  std::vector<double> g = sensor.readings();
  for (const double size : {0.0, 3.0}) {
    if (!offset && size > 0.0) continue;
    std::vector<double> shifted = g;
    for (double& reading : shifted) reading += size;
    REQUIRE(estimator.update(shifted, estimate) == FrameStatus::ok);
    CAPTURE(size, estimate.residual_rms);
    CHECK(apart(f, sensor.solve(shifted).tractions) < 1e-5);
    CHECK_FALSE(estimate.misfit);
    CHECK(estimate.outlier == -1);
  }
}

TEMPLATE_TEST_CASE("one rule chooses alpha where the scene names none", "[lab][laws]", Lines,
                   Skins) {
  for (const bool known : {true, false})
    for (const bool coarse : {true, false}) {
      std::string toml = scene<TestType>("", known ? stated_noise : "");
      if (coarse) toml = replaced(toml, toml.substr(toml.find("pitch"), 11), TestType::coarse);
      const TestType sensor(toml);
      const FilterFrame frame = sensor.analysed(sensor.readings());
      const AlphaTables tables(frame.gamma, frame.rows, frame.shares);
      CAPTURE(known, coarse, tables.few_rows());
      CHECK(sensor.problem.alpha_rule(frame) == default_rule(tables, known));
      CHECK((default_rule(tables, known) == AlphaRule::aicc) == !tables.few_rows());
    }
}

TEMPLATE_TEST_CASE("a stream is hardly more wrong in any frame than with a fixed alpha",
                   "[lab][laws]", Lines, Skins) {
  constexpr std::size_t frames = 150;
  const TestType sensor(scene<TestType>());
  const std::vector<double> clean = sensor.readings();
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 1e-3);
  std::vector<std::vector<double>> recorded;
  std::vector<double> alphas;
  for (std::size_t k = 0; k < frames; ++k) {
    std::vector<double> g = clean;
    for (double& reading : g) reading += noise(random);
    const FilterFrame frame = sensor.analysed(g);
    alphas.push_back(choose_alone(frame, sensor.problem.alpha_tables(frame),
                                  sensor.problem.alpha_rule(frame), sensor.problem.stated_noise())
                         .alpha);
    recorded.push_back(std::move(g));
  }
  std::vector<double> sorted = alphas;
  std::sort(sorted.begin(), sorted.end());
  // Its spread in tractions about their mean: what a fixed alpha shows, and what the rule adds.
  const auto flicker = [&](auto&& alpha_of) {
    std::vector<std::vector<double>> all;
    std::vector<double> mean;
    for (std::size_t k = 0; k < frames; ++k) {
      const FilterFrame frame = sensor.analysed(recorded[k]);
      all.push_back(sensor.problem.family().solve(frame, alpha_of(k)));
      if (mean.empty()) mean.resize(all.back().size());
      for (std::size_t i = 0; i < mean.size(); ++i)
        mean[i] += all.back()[i] / static_cast<double>(frames);
    }
    double worst = 0.0;
    double sum = 0.0;
    for (const auto& f : all) {
      const double one = apart(f, mean);
      worst = std::max(worst, one);
      sum += one / static_cast<double>(frames);
    }
    return std::pair{worst, sum};
  };
  const auto [fixed_worst, fixed_mean] = flicker([&](std::size_t) { return sorted[frames / 2]; });
  const auto [worst, mean] = flicker([&](std::size_t k) { return alphas[k]; });
  CHECK(worst < 2.0 * fixed_worst);
  CHECK(mean < 1.5 * fixed_mean);
}

TEMPLATE_TEST_CASE("a recording's frames are answered as if each were alone", "[lab][laws]", Lines,
                   Skins) {
  const TestType sensor(scene<TestType>());
  auto solver = sensor.solver();
  const std::vector<double> g = sensor.readings();
  for (const double size : {1.0, 0.3, -0.5, 1.0}) {
    const FrameNumbers here = TestType::answer(solver, scaled(g, size));
    const FrameNumbers alone = sensor.solve(scaled(g, size));
    CHECK(here.tractions == alone.tractions);
    CHECK(here.deviations == alone.deviations);
    CHECK(here.data.doubts == alone.data.doubts);
  }
}

TEMPLATE_TEST_CASE("readings that no contact causes are doubted for what they are", "[lab][laws]",
                   Lines, Skins) {
  const TestType sensor(scene<TestType>());
  const std::vector<double> g = sensor.readings();
  CHECK(sensor.solve(g).data.consistent());
  CHECK(sensor.solve(scaled(g, -1.0)).data.has(DataDoubt::pulls));
  CHECK(sensor.solve(scaled(g, 1e9)).data.has(DataDoubt::implausible));
  std::vector<double> liar = g;
  const std::size_t taxel = TestType::taxels / 2;
  liar[taxel] += 0.3 * *std::max_element(g.begin(), g.end());
  const DataVerdict data = sensor.solve(liar).data;
  CHECK(data.has(DataDoubt::bad_taxel));
  CHECK(data.taxel == taxel);
}

TEMPLATE_TEST_CASE(
    "a contact that reaches beyond the taxels is a lower bound, one that ends there "
    "is not",
    "[lab][laws]", Lines, Skins) {
  const auto answer_at = [](const char* place) {
    const TestType sensor(replaced(scene<TestType>(), TestType::centre, place));
    return sensor.solve(sensor.readings());
  };
  CHECK(answer_at(TestType::beyond).verdict != lab::Verdict::ok);
  for (const char* place : {TestType::centre, TestType::within}) {
    const FrameNumbers inside = answer_at(place);
    CAPTURE(place, inside.force.value, inside.force.deviation);
    CHECK(inside.verdict == lab::Verdict::ok);
    CHECK_THAT(inside.force.value, WithinAbs(1.0, 3.0 * inside.force.deviation));
  }
}

TEST_CASE("moves along a skin that keeps its volume tell no force", "[lab][laws][skin]") {
  const auto answer_of = [](const std::string& reads, const std::string& noise) {
    std::string toml = "[sensor]\nrows = 8\ncolumns = 8\npitch = 1.0\ndepth = 1.0\nreads = [" +
                       reads + "]\n[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.48\n" +
                       Skins::contact + noise +
                       "[reconstruct]\ntangential_weight = 1.0\ntangential = true\n";
    const Skins sensor(toml);
    return sensor.solve(sensor.readings());
  };
  const FrameNumbers along =
      answer_of("\"displacement_y\", \"displacement_z\"",
                "[noise]\nrms = { displacement_y = 1e-3, displacement_z = 1e-3 }\n");
  CHECK(along.verdict == lab::Verdict::undetermined);
  const FrameNumbers all = answer_of(
      "\"displacement_x\", \"displacement_y\", \"displacement_z\"",
      "[noise]\nrms = { displacement_x = 1e-3, displacement_y = 1e-3, displacement_z = 1e-3 }\n");
  CHECK(all.verdict == lab::Verdict::ok);
  CHECK_THAT(all.force.value, WithinAbs(1.0, 3.0 * all.force.deviation));
}

TEST_CASE("what presses amid dead taxels of a skin is a lower bound", "[lab][laws][skin]") {
  const auto toml = [](const std::string& dead) {
    return "[sensor]\nrows = 8\ncolumns = 8\npitch = 1.0\ndepth = 1.0\nreads = [\"stress_x\"]\n" +
           pad + "[[contact]]\nshape = \"sphere\"\nplace = [0.5, 0.5]\nradius = 1.2\n" +
           "force = 1.0\n[noise]\nrms = 2e-3\n" + dead;
  };
  const Skins whole(toml(""));
  const FrameNumbers seen = whole.solve(whole.readings());
  CHECK(seen.verdict == lab::Verdict::ok);
  const Skins holed(toml("[dead_taxels]\nindices = [27, 28, 29, 35, 36, 37, 43, 44, 45]\n"));
  CHECK(holed.solve(holed.readings()).verdict != lab::Verdict::ok);
}

TEST_CASE("a second contact that is too weak to be certain is within the deviations of every sum",
          "[lab][laws][skin]") {
  const auto contact = [](double y, double z, double radius, double force) {
    return "[[contact]]\nshape = \"sphere\"\nplace = [" + std::to_string(y) + ", " +
           std::to_string(z) + "]\nradius = " + std::to_string(radius) +
           "\nforce = " + std::to_string(force) + "\nfriction = 0.3\ndirection = 40.0\n";
  };
  constexpr double weak = 0.04;
  const Skins sensor(
      "[sensor]\nrows = 8\ncolumns = 8\npitch = 1.0\ndepth = 2.0\nreads = "
      "[\"stress_x\", \"shear_xy\", \"shear_xz\"]\n" +
      pad + contact(-1.5, -1.0, 1.5, 1.0) + contact(2.2, 2.0, 0.8, weak) +
      "[noise]\nrms = 2e-4\n[reconstruct]\ntangential_weight = 1.0\n"
      "friction_limit = 0.8\n");
  const lab::SkinAnswer answer = solve(sensor.problem, sensor.readings());
  const Uncertain& force = answer.wrench.normal;
  CAPTURE(answer.contacts, force.value, force.deviation);
  CHECK(answer.verdict == lab::Verdict::ok);
  CHECK_THAT(force.value, WithinAbs(1.0 + weak, 2.0 * force.deviation));
  REQUIRE(answer.wrench.centre_y);
  CHECK_THAT(answer.wrench.centre_y->value, WithinAbs((-1.5 + weak * 2.2) / (1.0 + weak),
                                                      2.0 * answer.wrench.centre_y->deviation));
}
