#include "tactile_net/lab/skin_network.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/lab/relaxation.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/network_circuit.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

constexpr double alpha = 1e-3;

/// A skin of 4 x 4 taxels, three readings each, with cells at its taxels alone; lengths and moduli
/// of one.
struct Small {
  explicit Small(const std::string& reconstruct = "spacing = 1.0\nmargin = 0.0\n")
      : problem(std::get<SkinScene>(parse_any_scene(
            "[sensor]\nrows = 4\ncolumns = 4\npitch = 1.0\ndepth = 1.2\n"
            "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
            "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
            "[[contact]]\nshape = \"sphere\"\nplace = [0.3, -0.2]\nradius = 1.0\nforce = 2.0\n"
            "friction = 0.4\ndirection = 30.0\n[reconstruct]\nalpha = 1e-3\n" +
                reconstruct,
            "small.toml"))),
        readings(lab::simulate(problem.scene()).readings) {}

  [[nodiscard]] std::vector<double> direct() const {
    return problem.family().solve(problem.family().analyse(readings), alpha);
  }
  [[nodiscard]] NetworkCircuit circuit(Realization realization,
                                       const RealizationOptions& options = {}) const {
    return {realization,
            std::make_shared<const NetworkProblem>(
                lab::skin_network_problem(problem.problem(), alpha, readings)),
            options};
  }

  lab::SkinSceneProblem problem;
  std::vector<double> readings;
};

}  // namespace

TEST_CASE("a skin's P is K'K and its stabiliser, of which few entries are not zero",
          "[lab][skin_network]") {
  const Small small("spacing = 0.6\ntangential = true\n");
  const LinearProblem& problem = small.problem.problem();
  const NetworkProblem network = lab::skin_network_problem(problem, alpha, small.readings);
  const std::size_t n = network.matrix.rows;
  double largest = 0.0;
  double off = 0.0;
  std::size_t entries = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      double sum = network.stabiliser(i, j);
      entries += sum != 0.0 ? 1 : 0;
      for (std::size_t k = 0; k < network.kernel.rows; ++k)
        sum += network.kernel(k, i) * network.kernel(k, j);
      largest = std::max(largest, std::abs(network.matrix(i, j)));
      off = std::max(off, std::abs(sum - network.matrix(i, j)));
    }
  CHECK(off < 1e-14 * largest);
  CHECK(entries <= 5 * n);
}

TEST_CASE("ngspice relaxes a skin of 4 x 4 x 3 to its direct solution", "[lab][skin_network]") {
  const Small small;
  const std::vector<double> direct = small.direct();
  REQUIRE(direct.size() == 48);
  const Realization realization = GENERATE(Realization::least_squares, Realization::crossbar,
                                           Realization::ideal, Realization::rail);
  CAPTURE(name(realization));
  CHECK_FALSE(lab::too_large(realization, direct.size(), 48));
  const NetworkCircuit circuit = small.circuit(realization);
  CHECK(l2_difference(operating_voltages(circuit.flat()), direct) < 1e-3);  // of gains of 1e6
  const Circuit& named = circuit.circuit();
  CHECK(output_names(named).front() == "p_0_0");
  CHECK(output_names(named)[17] == "qy_0_1");
  CHECK(output_names(named).back() == "qz_3_3");
  std::ostringstream deck;
  write_deck(deck, named, {.title = "a skin of 4 x 4 x 3"}, Answer::raw_file);
  Ngspice ngspice;
  const OperatingPoint point = operating_point(ngspice, deck.str(), output_names(named));
  CHECK(l2_difference(point.voltages, direct) < 1e-7);
}

TEST_CASE("the circuit of a skin has the certificate of any", "[lab][skin_network]") {
  const Small small;
  RealizationOptions options;
  options.opamp = {.gain = 1e6, .bandwidth = 1e7};
  const NetworkCircuit circuit = small.circuit(Realization::least_squares, options);
  const Certificate certificate = certify(circuit);
  CHECK(certificate.stability == Stability::stable);
  CHECK(certificate.smallest_eigenvalue > 0.0);
  REQUIRE(certificate.dynamics);
  CHECK(certificate.dynamics->slowest < 0.0);
  CHECK(certificate.dynamics->settling_seconds.value() > 0.0);
  REQUIRE(certificate.tolerance_margin);
  CHECK(*certificate.tolerance_margin > 0.0);
  const ToleranceResult result = tolerate(
      circuit.reduction(), {.relative = 0.5 * *certificate.tolerance_margin, .trials = 20});
  CHECK(result.trials == 20);
}

TEST_CASE("what ngspice makes of a skin's scene is the digital answer, as far as its parts explain",
          "[lab][skin_network][long]") {
  AnyScene scene = read_any_scene(SCENES "/skins/circuit.toml");
  const bool pressure_alone = GENERATE(false, true);
  auto& skin = std::get<SkinScene>(scene);
  skin.network.settling_accuracy.reset();  // transients are other tests'
  skin.network.tolerance.reset();
  if (pressure_alone) {
    skin.sensor.rows = skin.sensor.columns = 8;
    skin.sensor.reads = {Quantity::stress_x};
  }
  const lab::SceneCircuit circuit = lab::simulated_circuit(scene);
  REQUIRE(circuit.nodes() == (pressure_alone ? 64 : 48));
  Ngspice ngspice;
  const lab::Relaxation relaxation = lab::relax(circuit, ngspice);
  CAPTURE(relaxation.difference, relaxation.explained.limit);
  CHECK_FALSE(relaxation.disagreement());
  CHECK(relaxation.difference < relaxation.explained.total());
  CHECK(relaxation.difference < 1e-2);
  CHECK(relaxation.names.back() == (pressure_alone ? "p_7_7" : "qz_3_3"));
  REQUIRE(relaxation.certificate);
  CHECK(relaxation.certificate->stability == Stability::stable);
  // The answer is that of the library: this scene states alpha, and has no constraints.
  const lab::Experiment run = lab::run(skin);
  REQUIRE(run.results.front().has_answer());
  CHECK(l2_difference(circuit.direct(), run.results.front().answer.tractions) < 1e-12);
}

TEST_CASE("a circuit of a skin has the scene's alpha and weight, and cells of its own",
          "[lab][skin_network]") {
  const auto of = [](const std::string& more) {
    Small small(more);
    return lab::simulated_circuit(small.problem.scene());
  };
  const lab::SceneCircuit weighed = of("tangential_weight = \"evidence\"\nspacing = 1.0\n");
  REQUIRE(weighed.alpha().tangential_weight);
  CHECK(weighed.alpha().value == alpha);
  const lab::SceneCircuit coarse =
      of("spacing = 0.5\nmargin = 1.0\n[network]\nspacing = 1.0\n"
         "realization = \"least_squares\"\n");
  CHECK(coarse.nodes() == 3 * 6 * 6);
  CHECK(coarse.fits(Realization::ideal));
  CHECK_THROWS_WITH(of("friction_limit = 0.5\nspacing = 1.0\n"),
                    ContainsSubstring("holds no constraints"));
  CHECK_THROWS_WITH(of("spacing = 0.25\n"), ContainsSubstring("branches of P"));
}

TEST_CASE("a skin too large for a circuit is refused with the count and what takes fewer",
          "[lab][skin_network]") {
  const auto why = lab::too_large(Realization::ideal, 243, 48);
  CHECK_THAT(why.value_or(""), ContainsSubstring("29403 branches of P, more than 20000") &&
                                   ContainsSubstring("least_squares takes two arrays of 48 x 243"));
  CHECK_FALSE(lab::too_large(Realization::least_squares, 243, 48));
  CHECK_THAT(lab::too_large(Realization::least_squares, 1000, 48).value_or(""),
             ContainsSubstring("1048 amplifiers, more than 1024"));
}
