/// @file
/// A line and a skin of which the same laws are asked, each by its type.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/scene/any_scene.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/euclidean.hpp"

namespace tactile_net::laws {

/// What both have of a frame.
struct FrameNumbers {
  std::vector<double> tractions{}, deviations{};
  Uncertain force{};
  std::vector<Uncertain> centre{};  ///< of pressure, along each axis; none where nothing presses
  lab::ChosenAlpha alpha{};
  lab::Verdict verdict = lab::Verdict::ok;
  DataVerdict data{};
  std::vector<double> offsets{};
  std::vector<std::size_t> remarks{};  ///< which of the kinds, in their order
};

inline FrameNumbers numbers_of(lab::FrameAnswer found) {
  FrameNumbers all{.tractions = std::move(found.tractions),
                   .deviations = std::move(found.deviations),
                   .alpha = found.alpha,
                   .verdict = found.verdict,
                   .data = found.data.value(),
                   .offsets = std::move(found.offsets)};
  const UncertainWrench& wrench = found.wrench;
  if (found.bands) {
    all.force = found.bands->resultant.normal;
    if (found.bands->resultant.centre) all.centre = {*found.bands->resultant.centre};
  } else {
    all.force = wrench.normal;
    if (wrench.centre_y && wrench.centre_z) all.centre = {*wrench.centre_y, *wrench.centre_z};
  }
  for (const lab::Remark& one : found.remarks) all.remarks.push_back(one.index());
  return all;
}

/// For runs in which no circuit is relaxed.
struct UnusedSimulator : Simulator {
  Simulation run(const std::string&) override { throw std::logic_error("no circuit is asked for"); }
};

inline const std::string pad = "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n";
inline const std::string stated_noise = "[noise]\nrms = 1e-3\n";

inline double between(double least, double most, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(least, most)(random);
}

/// Where a taxel stands in a list of them.
inline std::size_t place_of(std::size_t taxel, const std::vector<std::size_t>& order) {
  return static_cast<std::size_t>(std::find(order.begin(), order.end(), taxel) - order.begin());
}

inline std::vector<double> noisy(std::vector<double> readings, double rms,
                                 std::mt19937_64& random) {
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
  [[nodiscard]] lab::RecordingSolver solver(lab::RecordingSolverOptions options = {}) const {
    return lab::RecordingSolver(problem, Method::tikhonov, options);
  }
  [[nodiscard]] static FrameNumbers answer(lab::RecordingSolver& solver, std::vector<double> g) {
    auto found = solver.solve(g);
    REQUIRE(found);
    return numbers_of(lab::with_bands(solver.problem(), g, *std::move(found)));
  }
  [[nodiscard]] FrameNumbers solve(const std::vector<double>& g) const {
    lab::RecordingSolver one = solver();
    return answer(one, g);
  }

  Problem problem;
};

/// Taxels in a line, a third of their depth apart, that read two quantities.
struct Lines : SensorProblem<lab::SceneProblem> {
  static constexpr std::size_t taxels = 21, channels = 2, mirrors = 1;
  static constexpr double tolerance = 1e-8;  ///< of tractions that are the same but for rounding
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
  /// What `run` makes of the scene's own readings.
  [[nodiscard]] FrameNumbers run() const {
    UnusedSimulator simulator;
    const lab::Experiment experiment = lab::run(problem.scene(), simulator);
    const lab::MethodResult& found = experiment.results.front();
    REQUIRE(found.has_answer());
    lab::FrameAnswer answer = found.answer;
    std::erase_if(answer.remarks, [](const lab::Remark& one) {
      return std::holds_alternative<lab::remark::Hidden>(one);
    });
    return numbers_of(std::move(answer));
  }
  /// The reading of taxel `t`'s mirror image, and what becomes of its sign.
  [[nodiscard]] static std::vector<double> mirrored_readings(const std::vector<double>& g,
                                                             std::size_t /*mirror*/) {
    const std::size_t n = g.size() / 2;
    std::vector<double> m(g.size());
    for (std::size_t i = 0; i < n; ++i) {
      m[i] = g[n - 1 - i];
      m[n + i] = -g[2 * n - 1 - i];
    }
    return m;
  }
  [[nodiscard]] static std::vector<double> mirrored_tractions(const std::vector<double>& f,
                                                              std::size_t mirror) {
    return mirrored_readings(f, mirror);
  }
};

/// Taxels of a lattice that read three quantities.
struct Skins : SensorProblem<lab::SkinSceneProblem> {
  static constexpr std::size_t rows = 6, columns = 5, taxels = rows * columns, channels = 3;
  static constexpr std::size_t mirrors = 2;
  static constexpr double tolerance = 1e-8;
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

  explicit Skins(const std::string& toml)
      : Skins(std::get<SkinScene>(parse_any_scene(toml, "skin.toml"))) {}
  explicit Skins(SkinScene scene) : Skins(lab::SkinSceneProblem(std::move(scene))) {}
  explicit Skins(lab::SkinSceneProblem of) : SensorProblem{std::move(of)} {}

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
    std::vector<Taxel> all;
    for (std::size_t i = 0; i < taxels; ++i) {
      const double row = static_cast<double>(i / columns) - 2.5;
      const double column = static_cast<double>(i % columns) - 2.0;
      all.push_back({.y = 0.7 * row + between(-0.2, 0.2, random),
                     .z = 0.7 * column + between(-0.2, 0.2, random),
                     .depth = between(1.2, 1.8, random),
                     .reads = scene.sensor.reads});
    }
    std::vector<Taxel> in_order;
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
  [[nodiscard]] FrameNumbers run() const {
    const lab::Experiment experiment = lab::run(problem.scene());
    REQUIRE(experiment.results.front().has_answer());
    return numbers_of(experiment.results.front().answer);
  }
  /// About y = 0, or z = 0: the drag along that turns its sign, and what reads it.
  [[nodiscard]] static std::vector<double> mirrored(const std::vector<double>& x,
                                                    std::size_t mirror, std::size_t down,
                                                    std::size_t across) {
    std::vector<double> m(x.size());
    for (std::size_t u = 0; u < 3; ++u)
      for (std::size_t r = 0; r < down; ++r)
        for (std::size_t c = 0; c < across; ++c)
          m[(u * down + r) * across + c] =
              (u == 1 + mirror ? -1.0 : 1.0) *
              x[(u * down + (mirror == 0 ? down - 1 - r : r)) * across +
                (mirror == 1 ? across - 1 - c : c)];
    return m;
  }
  [[nodiscard]] static std::vector<double> mirrored_readings(const std::vector<double>& g,
                                                             std::size_t mirror) {
    return mirrored(g, mirror, rows, columns);
  }
  [[nodiscard]] std::vector<double> mirrored_tractions(const std::vector<double>& f,
                                                       std::size_t mirror) const {
    return mirrored(f, mirror, problem.grid().rows, problem.grid().columns);
  }
};

/// Skins that are solved without a matrix, by steps that end where they are told to.
struct LargeSkins : Skins {
  static constexpr double tolerance = 1e-5;
  explicit LargeSkins(const std::string& toml)
      : LargeSkins(std::get<SkinScene>(parse_any_scene(toml, "skin.toml"))) {}
  explicit LargeSkins(SkinScene scene)
      : Skins(lab::SkinSceneProblem(std::move(scene), std::size_t{0})) {}
};

template <class Sensor>
std::string scene(const std::string& more = "[reconstruct]\ntangential_weight = 1.0\n",
                  const std::string& noise = stated_noise) {
  return Sensor::sensor + pad + Sensor::contact + noise + more;
}

inline std::vector<double> scaled(std::vector<double> x, double factor) {
  for (double& value : x) value *= factor;
  return x;
}

/// The distance of `x` from `factor` times `y`, over the latter's norm.
inline double apart(const std::vector<double>& x, const std::vector<double>& y,
                    double factor = 1.0) {
  REQUIRE(x.size() == y.size());
  const std::vector<double> expected = scaled(y, factor);
  return distance(x, expected) / norm(expected);
}

}  // namespace tactile_net::laws
