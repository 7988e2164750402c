// What must hold of lines and of skins alike: one law, two sensors.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tactile_net/control/batch.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/lab/data_verdict.hpp"
#include "tactile_net/lab/planned_controller.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_answer.hpp"
#include "tactile_net/lab/skin_recording_solver.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/scene/any_scene.hpp"
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
  std::vector<Uncertain> centre{};  ///< of pressure, along each axis; none where nothing presses
  lab::ChosenAlpha alpha{};
  lab::Verdict verdict = lab::Verdict::ok;
  DataVerdict data{};
  std::vector<double> offsets{};
};

const std::string pad = "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n";
const std::string stated_noise = "[noise]\nrms = 1e-3\n";

double between(double least, double most, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(least, most)(random);
}

/// Where a taxel stands in a list of them.
std::size_t place_of(std::size_t taxel, const std::vector<std::size_t>& order) {
  return static_cast<std::size_t>(std::find(order.begin(), order.end(), taxel) - order.begin());
}

std::vector<double> noisy(std::vector<double> readings, double rms, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, rms);
  for (double& reading : readings) reading += noise(random);
  return readings;
}

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
  static constexpr const char* spaced = "pitch = 1.5";  ///< as far apart as they are deep
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

  explicit Lines(const std::string& toml) : Lines(parse_scene(toml, "line.toml")) {}
  explicit Lines(Scene scene) : SensorProblem{lab::SceneProblem(std::move(scene))} {}

  /// Two taxels at each of eleven places, one below the other: of such two either may come first.
  static std::vector<std::size_t> another_order() {
    std::vector<std::size_t> order;
    for (std::size_t place = 0; place < 11; ++place)
      for (const std::size_t which : {place % 3 == 0 ? 1U : 0U, place % 3 == 0 ? 0U : 1U})
        order.push_back(2 * place + which);
    return order;
  }
  /// Those, listed in an order, and one of them dead.
  static Lines listed(const std::string& toml, const std::vector<std::size_t>& order,
                      std::size_t dead) {
    Scene scene = parse_scene(toml, "line.toml");
    std::vector<Taxel> all;
    for (const std::size_t i : order)
      all.push_back({.y = static_cast<double>(i / 2) - 5.0,
                     .depth = i % 2 == 0 ? 1.2 : 1.8,
                     .reads = scene.sensor.reads});
    scene.sensor = uneven_array(std::move(all));
    scene.reconstruct.surface.basis = SurfaceBasis::hats;
    scene.dead_taxels = {place_of(dead, order)};
    return Lines(std::move(scene));
  }
  /// A contact of force 1 somewhere within, and where its pressure is centred.
  static std::pair<std::string, std::vector<double>> random_contact(std::mt19937_64& random,
                                                                    double most_friction) {
    const double centre = between(-3.0, 3.0, random);
    const double half_width = between(0.8, 2.0, random);
    const double friction = between(-most_friction, most_friction, random);
    return {"[[contact]]\nshape = \"cylinder\"\nforce = 1.0\ncenter = " + std::to_string(centre) +
                "\nhalf_width = " + std::to_string(half_width) +
                "\nfriction = " + std::to_string(friction) + "\n",
            {centre}};
  }
  [[nodiscard]] static FrameNumbers answer(Solver& solver, std::vector<double> g) {
    FrameNumbers all{.tractions = std::vector<double>(solver.tractions())};
    const auto result = solver.solve(g, all.tractions);
    REQUIRE(result);
    REQUIRE(result->status == FrameStatus::ok);
    const lab::SceneFrame frame(solver.problem(), g);
    const lab::FrameUncertainty bands = lab::uncertainty(frame, all.tractions, *result);
    all.deviations = bands.deviation;
    all.force = bands.resultant.normal;
    if (bands.resultant.centre) all.centre = {*bands.resultant.centre};
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
  static constexpr const char* spaced = "pitch = 1.5";
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
      : Skins(std::get<SkinScene>(parse_any_scene(toml, "skin.toml"))) {}
  explicit Skins(SkinScene scene) : SensorProblem{lab::SkinSceneProblem(std::move(scene))} {}

  /// Taxels in no rows may be listed in any order.
  static std::vector<std::size_t> another_order() {
    std::vector<std::size_t> order(taxels);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937_64(3));
    return order;
  }
  static Skins listed(const std::string& toml, const std::vector<std::size_t>& order,
                      std::size_t dead) {
    SkinScene scene = std::get<SkinScene>(parse_any_scene(toml, "skin.toml"));
    std::mt19937_64 random(4);
    std::vector<SkinTaxel> all;
    for (std::size_t i = 0; i < taxels; ++i) {
      const double row = static_cast<double>(i / columns) - 2.5;
      const double column = static_cast<double>(i % columns) - 2.0;
      all.push_back({.y = 0.7 * row + between(-0.2, 0.2, random),
                     .z = 0.7 * column + between(-0.2, 0.2, random),
                     .depth = between(1.2, 1.8, random),
                     .reads = scene.sensor.reads});
    }
    std::vector<SkinTaxel> in_order;
    for (const std::size_t i : order) in_order.push_back(all[i]);
    scene.sensor = uneven_skin(std::move(in_order));
    scene.dead_taxels = {place_of(dead, order)};
    return Skins(std::move(scene));
  }
  static std::pair<std::string, std::vector<double>> random_contact(std::mt19937_64& random,
                                                                    double most_friction) {
    const double y = between(-0.8, 0.8, random);
    const double z = between(-0.6, 0.6, random);
    const double radius = between(0.6, 1.2, random);
    const double friction = between(0.0, most_friction, random);
    const double direction = between(0.0, 360.0, random);
    return {"[[contact]]\nshape = \"sphere\"\nforce = 1.0\nplace = [" + std::to_string(y) + ", " +
                std::to_string(z) + "]\nradius = " + std::to_string(radius) + "\nfriction = " +
                std::to_string(friction) + "\ndirection = " + std::to_string(direction) + "\n",
            {y, z}};
  }
  [[nodiscard]] static FrameNumbers answer(Solver& solver, std::vector<double> g) {
    const auto found = solver.solve(g);
    REQUIRE(found);
    const UncertainWrench& wrench = found->wrench;
    std::vector<Uncertain> centre;
    if (wrench.centre_y && wrench.centre_z) centre = {*wrench.centre_y, *wrench.centre_z};
    return {.tractions = found->tractions,
            .deviations = found->deviations,
            .force = wrench.normal,
            .centre = std::move(centre),
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

/// How often deviations hold the truth, of contacts anywhere within the taxels and noise as stated.
struct HeldTruths {
  int frames = 0;       ///< of verdict ok
  int said = 0;         ///< forces and centres in them
  int held = 0;         ///< of these, within two deviations
  double square = 0.0;  ///< of errors over deviations, the sum
  [[nodiscard]] double share() const { return static_cast<double>(held) / said; }
};

/// @param sensor  without contacts and noise
template <class Sensor>
HeldTruths truths_held(const std::string& sensor, const std::string& more, double noise_rms,
                       int frames, double most_friction) {
  std::mt19937_64 random(11);
  std::optional<Sensor> problem;
  HeldTruths coverage;
  for (int k = 0; k < frames; ++k) {
    const auto [contact, centre] = Sensor::random_contact(random, most_friction);
    const Sensor clean(sensor + pad + contact + more);
    if (!problem)
      problem.emplace(sensor + pad + contact + "[noise]\nrms = " + std::to_string(noise_rms) +
                      "\n" + more);
    const FrameNumbers found = problem->solve(noisy(clean.readings(), noise_rms, random));
    if (found.verdict != lab::Verdict::ok) continue;
    ++coverage.frames;
    const auto add = [&](const Uncertain& one, double truth) {
      const double off = std::abs(one.value - truth) / one.deviation;
      ++coverage.said;
      coverage.held += off <= 2.0;
      coverage.square += off * off;
    };
    add(found.force, 1.0);
    for (std::size_t i = 0; i < found.centre.size(); ++i) add(found.centre[i], centre[i]);
  }
  return coverage;
}

/// The distance of `x` from `factor` times `y`, over the latter's norm.
double apart(const std::vector<double>& x, const std::vector<double>& y, double factor = 1.0) {
  REQUIRE(x.size() == y.size());
  const std::vector<double> expected = scaled(y, factor);
  return distance(x, expected) / norm(expected);
}

}  // namespace

TEMPLATE_TEST_CASE("readings a thousandth as large under such noise are the same contact",
                   "[lab][laws]", Lines, Skins) {
  const TestType large(scene<TestType>());
  const TestType small(replaced(scene<TestType>(), "rms = 1e-3", "rms = 1e-6"));
  const FrameNumbers one = large.solve(large.readings());
  const FrameNumbers other = small.solve(scaled(large.readings(), 1e-3));
  CHECK(apart(other.tractions, one.tractions, 1e-3) < 1e-8);
  CHECK(apart(other.deviations, one.deviations, 1e-3) < 1e-6);
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
  std::vector<std::vector<double>> recorded;
  std::vector<double> alphas;
  for (std::size_t k = 0; k < frames; ++k) {
    std::vector<double> g = noisy(clean, 1e-3, random);
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

TEMPLATE_TEST_CASE("what lied or was missing in a frame changes no later answer", "[lab][laws]",
                   Lines, Skins) {
  const TestType sensor(scene<TestType>());
  const std::vector<double> g = sensor.readings();
  const double lie = 0.3 * *std::max_element(g.begin(), g.end());
  const lab::RecordingSolverOptions options{.missing = lab::Missing::estimate};
  auto solver = sensor.solver(options);
  std::mt19937_64 random(9);
  for (const std::size_t taxel : {4U, 4U, 17U, 30U, 17U, 30U}) {  // of 30 and beyond none
    std::vector<double> frame = noisy(g, 1e-3, random);
    if (taxel < TestType::taxels) frame[taxel] += lie;
    if (taxel == 17) frame[5] = std::nan("");
    const FrameNumbers here = TestType::answer(solver, frame);
    auto own = sensor.solver(options);
    const FrameNumbers alone = TestType::answer(own, frame);
    CAPTURE(taxel);
    CHECK(here.tractions == alone.tractions);
    CHECK(here.deviations == alone.deviations);
    CHECK(here.verdict == alone.verdict);
    CHECK(here.data.doubts == alone.data.doubts);
    CHECK(here.data.taxel == alone.data.taxel);
  }
}

TEMPLATE_TEST_CASE(
    "a controller answers a frame by its readings alone: in a stream, in a batch, or "
    "as its first",
    "[lab][laws]", Lines, Skins) {
  const TestType sensor(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\nalpha = 1e-4\n"));
  const EstimatorPlan plan =
      lab::plan_controller(sensor.problem, *lab::plan_alpha(sensor.problem)).estimator.plan;
  const std::vector<double> g = sensor.readings();
  std::mt19937_64 random(6);
  std::vector<double> stream;
  constexpr std::size_t frames = 9;
  for (std::size_t k = 0; k < frames; ++k) {
    const double size = k % 4 == 3 ? -0.4 : 0.25 * static_cast<double>(k);
    std::vector<double> frame = noisy(scaled(g, size), 1e-3, random);
    if (k % 3 == 1) frame[TestType::taxels / 2] += 1.0;
    stream.insert(stream.end(), frame.begin(), frame.end());
  }
  struct Answers {
    explicit Answers(const ContactEstimator& of) : tractions(frames * of.tractions()) {
      for (std::size_t k = 0; k < frames; ++k)
        estimates.push_back(
            {.tractions = std::span(tractions).subspan(k * of.tractions(), of.tractions())});
    }
    std::vector<double> tractions;
    std::vector<ContactEstimate> estimates{};
  };
  ContactEstimator streaming(plan);
  ContactEstimator batching(plan);
  Answers streamed(streaming);
  Answers batched(streaming);
  Answers first(streaming);
  for (std::size_t k = 0; k < frames; ++k) {
    const std::span<const double> frame = std::span(stream).subspan(k * g.size(), g.size());
    ContactEstimator fresh(plan);
    REQUIRE(streaming.update(frame, streamed.estimates[k]) == FrameStatus::ok);
    REQUIRE(fresh.update(frame, first.estimates[k]) == FrameStatus::ok);
  }
  REQUIRE(update_batch(batching, stream, batched.estimates) == FrameStatus::ok);
  for (const Answers* other : {&batched, &first}) {
    CHECK(other->tractions == streamed.tractions);
    for (std::size_t k = 0; k < frames; ++k) {
      const ContactEstimate& a = streamed.estimates[k];
      const ContactEstimate& b = other->estimates[k];
      CAPTURE(k, a.normal_force);
      CHECK(a.normal_force == b.normal_force);
      for (const auto number : {&ContactEstimate::force_deviation, &ContactEstimate::centre,
                                &ContactEstimate::angle, &ContactEstimate::residual_rms})
        CHECK((a.*number == b.*number || (std::isnan(a.*number) && std::isnan(b.*number))));
      CHECK(a.contact == b.contact);
      CHECK(a.pulls == b.pulls);
      CHECK(a.misfit == b.misfit);
      CHECK(a.beyond_edge == b.beyond_edge);
      CHECK(a.outlier == b.outlier);
    }
  }
}

TEMPLATE_TEST_CASE("the order in which taxels are listed changes their numbers and nothing else",
                   "[lab][laws]", Lines, Skins) {
  constexpr std::size_t dead = 6;
  constexpr std::size_t liar = 13;
  const std::vector<std::size_t> order = TestType::another_order();
  std::vector<std::size_t> first(order.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  const TestType sensor = TestType::listed(scene<TestType>(), first, dead);
  const TestType listed_anew = TestType::listed(scene<TestType>(), order, dead);
  std::vector<double> g = sensor.readings();
  REQUIRE(g.size() == TestType::channels * order.size());
  for (const double lie : {0.0, 0.3 * *std::max_element(g.begin(), g.end())}) {
    g[liar] += lie;
    std::vector<double> anew;
    for (std::size_t c = 0; c < TestType::channels; ++c)
      for (const std::size_t taxel : order) anew.push_back(g[c * order.size() + taxel]);
    const FrameNumbers one = sensor.solve(g);
    const FrameNumbers other = listed_anew.solve(anew);
    CAPTURE(lie);
    CHECK(apart(other.tractions, one.tractions) < 1e-6);
    CHECK(apart(other.deviations, one.deviations) < 1e-5);
    CHECK_THAT(other.force.deviation, WithinRel(one.force.deviation, 1e-5));
    CHECK(other.verdict == one.verdict);
    CHECK(other.data.doubts == one.data.doubts);
    CHECK(one.data.taxel.has_value() == (lie > 0.0));
    if (!one.data.taxel) continue;
    REQUIRE(other.data.taxel);
    CHECK(*one.data.taxel == liar);
    CHECK(order[*other.data.taxel] == liar);
  }
}

TEMPLATE_TEST_CASE("columns of a recording are its readings by their names, wherever they stand",
                   "[lab][laws]", Lines, Skins) {
  const TestType sensor(scene<TestType>());
  const std::vector<double> g = sensor.readings();
  const std::vector<std::string> names = reading_names(sensor.problem.scene().sensor);
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937_64(8));
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < order.size(); ++i) text << (i > 0 ? "," : "") << names[order[i]];
  text << "\n";
  for (std::size_t i = 0; i < order.size(); ++i) text << (i > 0 ? "," : "") << g[order[i]];
  text << "\n";
  std::istringstream in(text.str());
  frames::CsvFrames recording(in, "recording.csv", {.names = names, .taxels = TestType::taxels});
  std::vector<double> read(names.size());
  REQUIRE(recording.next(read));
  CHECK(sensor.solve(read).tractions == sensor.solve(g).tractions);
}

TEMPLATE_TEST_CASE("two deviations hold force and centre of honest frames, whose verdict is ok",
                   "[lab][laws]", Lines, Skins) {
  const std::string coarse =
      replaced(TestType::sensor, TestType::sensor.substr(TestType::sensor.find("pitch"), 11),
               TestType::spaced);
  int frames = 0;
  for (const std::string& sensor : {TestType::sensor, coarse})
    for (const double noise : {1e-3, 1e-2}) {
      const HeldTruths coverage = truths_held<TestType>(
          sensor, "[reconstruct]\ntangential = true\ntangential_weight = 1.0\n", noise, 20, 0.5);
      CAPTURE(sensor, noise, coverage.frames, coverage.said, coverage.held, coverage.square);
      if (coverage.frames == 0) continue;  // their verdicts say something else
      frames += coverage.frames;
      CHECK(coverage.share() >= 0.92);
      CHECK(coverage.square > 0.03 * coverage.said);  // nor are they many times too wide
    }
  CHECK(frames >= 40);  // of 80
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

TEMPLATE_TEST_CASE(
    "drag that is not solved for moves the centre towards it, by at most friction times "
    "depth, and that is said",
    "[lab][laws]", Lines, Skins) {
  constexpr double friction = 0.3;
  constexpr double depth = 1.5;
  const auto said = [](const TestType& sensor, const auto& solver) {
    const std::vector<std::string> all =
        report::in_words(solver.solved(), AnyScene(sensor.problem.scene()));
    return std::any_of(all.begin(), all.end(), [](const std::string& one) {
      return one.find("drag counts as none") != std::string::npos;
    });
  };
  const std::string toml = scene<TestType>("");
  const std::size_t reads = toml.find("reads");
  const std::string all_read = toml.substr(reads, toml.find('\n', reads) - reads);
  const std::string dragged = replaced(toml, all_read, "reads = [\"stress_x\"]");
  const auto centre = [&](const std::string& of) {
    const TestType sensor(of);
    auto solver = sensor.solver();
    const FrameNumbers found = TestType::answer(solver, sensor.readings());
    CHECK(said(sensor, solver) == (of == dragged));
    std::vector<double> place;
    for (const Uncertain& one : found.centre) place.push_back(one.value);
    return place;
  };
  const std::vector<double> with_drag = centre(dragged);
  const std::vector<double> without = centre(replaced(dragged, "friction = 0.3", "friction = 0.0"));
  (void)centre(toml);
  REQUIRE(with_drag.size() == without.size());
  const double moved = distance(with_drag, without);
  CAPTURE(moved, with_drag, without);
  CHECK(moved > 0.4 * friction * depth);
  CHECK(moved < 1.1 * friction * depth);
  CHECK(with_drag.front() > without.front());
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

TEST_CASE("where nothing may pull deviations hold what presses between taxels, or a verdict tells",
          "[lab][laws][skin]") {
  // All contacts lie amid four taxels, which narrow ones above each would explain with less force.
  for (const char* pitch : {"1.5", "2.25", "3.0"}) {
    const std::string sensor = "[sensor]\nrows = 6\ncolumns = 6\npitch = " + std::string(pitch) +
                               "\ndepth = 1.5\nreads = [\"stress_x\"]\n";
    const HeldTruths coverage =
        truths_held<Skins>(sensor, "[reconstruct]\nnonnegative = true\n", 3e-4, 16, 0.0);
    CAPTURE(pitch, coverage.frames, coverage.said, coverage.held, coverage.square);
    if (coverage.frames > 0) CHECK(coverage.share() >= 0.92);
    CHECK((coverage.frames > 0) == (std::string(pitch) != "3.0"));
  }
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
