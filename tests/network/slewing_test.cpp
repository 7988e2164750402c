// Circuits whose amplifiers cannot follow at any rate: T8, and settling with it.
#include "tactile_net/network/slewing.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/opamp.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/network/networks.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

/// The states' rates with the slewing ones bent.
std::vector<double> rates(const StateSpace& system, const std::vector<double>& x) {
  std::vector<double> result = system.drive;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) result[i] += system.dynamics(i, j) * x[j];
  for (const StateSpace::Slewing& one : system.slewing) {
    double& rate = result[one.state];
    rate = slewing_rate(rate + one.leak * x[one.state], one.limit) - one.leak * x[one.state];
  }
  return result;
}

/// dV/dt of V = e'P e / 2, e the outputs' distance from where they rest, over its size.
double energy_rate(const StateSpace& system, const Matrix& p, const std::vector<double>& x) {
  const std::vector<double> rest = steady_state(system);
  const std::vector<double> rate = rates(system, x);
  const std::size_t n = rest.size();
  std::vector<double> e(n), slope(n);
  for (std::size_t i = 0; i < n; ++i) {
    e[i] = system.direct[i] - rest[i];
    for (std::size_t j = 0; j < x.size(); ++j) {
      e[i] += system.output(i, j) * x[j];
      slope[i] += system.output(i, j) * rate[j];
    }
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) sum += e[i] * p(i, j) * slope[j];
  return sum;
}

std::vector<double> random_states(std::size_t count, std::mt19937& generator, double size) {
  std::vector<double> x(count);
  for (double& one : x) one = size * (2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0);
  return x;
}

/// A buffer of 2 V behind 1 mS.
StateSpace buffer(const OpAmp& opamp) {
  Circuit circuit;
  const Node in = add_node(circuit, "in");
  const Node out = add_node(circuit, "n0");
  circuit.outputs = {out};
  circuit.amplifiers = {{"opamp", opamp, Outputs::single}};
  circuit.instances = {{"X0", {in, out, out}, "opamp"}};
  circuit.resistors = {{"R0", in, 0, 1e-3}};
  circuit.sources = {{"I0", in, 2e-3}};
  return state_space(circuit);
}

}  // namespace

TEST_CASE("an amplifier that slews follows its exact solution", "[slewing]") {
  // x' = s tanh(w (v - x) / s): sinh(w (v - x) / s) falls as exp(-w t); the leak adds its share.
  const double w = 2.0 * std::numbers::pi * 1e6;
  for (const double slew : {1e9, 1e7, 1e6, 3e5}) {
    CAPTURE(slew);
    const StateSpace system = buffer({.gain = 1e9, .bandwidth = 1e6, .slew = slew});
    const double demand = w * 2.0 / slew;
    CHECK_THAT(slewing_demand(system), WithinRel(demand, 1e-6));
    for (const double accuracy : {1e-2, 1e-4}) {
      // sinh of large numbers by their logarithms
      const double first = demand > 30.0 ? demand - std::log(2.0) : std::log(std::sinh(demand));
      const double exact = (first - std::log(std::sinh(accuracy * demand))) / w;
      CHECK_THAT(slewing_settling_time(system, accuracy, -w).value(),
                 WithinRel(exact, 0.002 + 0.6 * slewing_leak * demand));
    }
  }
}

TEST_CASE("a core that leaks a share of its slew at rest settles all the same", "[slewing]") {
  const double w = 2.0 * std::numbers::pi * 1e6;
  for (const double slew : {5e6, 1e6, 3e5}) {  // asked for at rest: 1.2 %, 6 %, 21 %
    CAPTURE(slew);
    const StateSpace system = buffer({.gain = 200.0, .bandwidth = 1e6, .slew = slew});
    // Runge and Kutta's steps, until nothing moves.
    const double step = 1e-3 / w;
    std::vector<double> x = {0.0};
    std::vector<double> walk = x;
    for (int k = 0; k < 80'000; ++k) {
      const double k1 = rates(system, x)[0];
      const double k2 = rates(system, {x[0] + 0.5 * step * k1})[0];
      const double k3 = rates(system, {x[0] + 0.5 * step * k2})[0];
      const double k4 = rates(system, {x[0] + step * k3})[0];
      x[0] += step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
      walk.push_back(x[0]);
    }
    REQUIRE(std::abs(rates(system, x)[0]) < 1e-6 * slew);
    std::size_t last = walk.size();
    while (std::abs(walk[last - 1] - x[0]) <= 1e-3 * steady_state(system)[0]) --last;
    const auto settles = slewing_settling_time(system, 1e-3, -w);
    REQUIRE(settles);
    CHECK_THAT(*settles, WithinRel(step * static_cast<double>(last), 3e-3));
  }
}

TEST_CASE("a circuit begins where its offsets hold it", "[slewing][state_space]") {
  // From 1 V to 3 V: to 1e-3 in ln(2/3 / 1e-3) time constants; a slew out of reach changes nothing.
  const double w = 2.0 * std::numbers::pi * 1e6;
  const OpAmp opamp{.gain = 1e9, .bandwidth = 1e6, .offset = 1.0};
  const StateSpace system = buffer(opamp);
  CHECK_THAT(steady_state(system)[0], WithinRel(3.0, 1e-6));
  CHECK_THAT(step_errors(system, 1e-9, 1)[0], WithinRel(2.0 / 3.0, 1e-6));
  const double exact = std::log(2000.0 / 3.0) / w;
  CHECK_THAT(settling_time(system, 1e-3, -w).value(), WithinRel(exact, 2e-3));
  OpAmp slewing = opamp;
  slewing.slew = 1e12;
  CHECK_THAT(slewing_settling_time(buffer(slewing), 1e-3, -w).value(), WithinRel(exact, 2e-3));
  CHECK(buffer({.gain = 1e9, .bandwidth = 1e6}).idle_drive.empty());
}

TEST_CASE("a slew that nothing reaches changes nothing", "[slewing]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const Realization one :
       {Realization::crossbar, Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const OpAmp opamp{.gain = 1e6, .bandwidth = 1e7};
    OpAmp slewing = opamp;
    slewing.slew = 1e12;
    const Certificate without = certify(one, network.problem, {.opamp = opamp});
    const Certificate with = certify(one, network.problem, {.opamp = slewing});
    CHECK_THAT(*with.dynamics->settling_seconds,
               WithinRel(*without.dynamics->settling_seconds, 2e-3));
    CHECK_THAT(*with.dynamics->unslewed_seconds,
               WithinRel(*without.dynamics->settling_seconds, 1e-12));
    CHECK(with.dynamics->poles == without.dynamics->poles);
    CHECK_FALSE(without.dynamics->unslewed_seconds);
    CHECK(with.remarks.size() == without.remarks.size());
  }
}

TEST_CASE("slewing's settling times are those that were designed for", "[slewing]") {
  // design: SR = 10 V/us, settling to 1e-3 [us] at 1, 3 and 10 V
  const ArrayNetwork network = array_network(21, 1e-3);
  const auto settles = [&](Realization one, double volts) {
    const OpAmp opamp{.gain = 1e6, .bandwidth = 1e7, .slew = 1e7};
    const Certificate c = certify(one, network.problem, {.scale = {1e-3, volts}, .opamp = opamp});
    return 1e6 * c.dynamics->settling_seconds.value();
  };
  CHECK_THAT(settles(Realization::crossbar, 1.0), WithinRel(1.83, 0.02));
  CHECK_THAT(settles(Realization::crossbar, 3.0), WithinRel(1.93, 0.03));
  CHECK_THAT(settles(Realization::crossbar, 10.0), WithinRel(2.43, 0.03));
  CHECK_THAT(settles(Realization::lattice, 3.0), WithinRel(1.56, 0.03));
  CHECK_THAT(settles(Realization::lattice, 10.0), WithinRel(1.95, 0.03));
  CHECK_THAT(settles(Realization::least_squares, 10.0), WithinRel(3.13, 0.03));
}

TEST_CASE("capacitance at the inputs delays the slewing, and does not hide it", "[slewing]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  for (const Realization one : {Realization::crossbar, Realization::lattice}) {
    CAPTURE(name(one));
    const auto certified = [&](double farad) {
      RealizationOptions options{.scale = {2e-3, 10.0},
                                 .opamp = {.gain = 1e6, .bandwidth = 1e7, .slew = 1e7}};
      if (farad > 0.0) options.opamp.input_capacitance = farad;
      return certify(one, network.problem, options);
    };
    const Certificate without = certified(0.0);
    const Certificate with = certified(1e-15);
    CHECK_THAT(*with.dynamics->settling_seconds,
               WithinRel(*without.dynamics->settling_seconds, 1e-3));
    const auto demand = [](const Certificate& c) {
      for (const CircuitRemark& remark : c.remarks)
        if (remark.kind == CircuitRemark::Kind::slews) return remark.value;
      return 0.0;
    };
    CHECK(demand(without) > 1e7);
    CHECK_THAT(demand(with), WithinRel(demand(without), 0.1));
    CHECK(*certified(4e-12).dynamics->settling_seconds >
          1.1 * *certified(4e-12).dynamics->unslewed_seconds);
  }
}

TEST_CASE("T8: a circuit that slews loses energy from everywhere", "[slewing][theorem][property]") {
  std::mt19937 generator(7);
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    // A crossbar of any P, op-amps slewing by any amount.
    const Matrix p = random_definite(6, seed, 1e-3);
    const NetworkProblem problem{.matrix = p, .right_side = std::vector<double>(6, 1.0)};
    const OpAmp opamp{.gain = 1e9, .bandwidth = 1e6, .slew = 1e6};
    const Certificate c = certify(Realization::crossbar, problem, {.opamp = opamp});
    REQUIRE(c.slewing);
    CHECK(c.slewing->holds());
    const StateSpace system =
        state_space(realize(Realization::crossbar, problem, {.opamp = opamp}));
    for (int k = 0; k < 20; ++k)
      CHECK(energy_rate(system, p, random_states(system.states(), generator, 100.0)) < 0.0);
  }
  const ArrayNetwork network = array_network(9, 1e-3);
  const OpAmp opamp{.gain = 1e9, .bandwidth = 1e6, .slew = 1e5};
  CHECK(certify(Realization::lattice, network.problem, {.opamp = opamp}).slewing->holds());
  const StateSpace lattice =
      state_space(realize(Realization::lattice, network.problem, {.opamp = opamp}));
  for (int k = 0; k < 200; ++k)
    CHECK(energy_rate(lattice, network.problem.matrix,
                      random_states(lattice.states(), generator, 10.0)) < 0.0);
}

TEST_CASE("T8 of a lattice holds at finite gain, while the slew holds the outputs",
          "[slewing][theorem][property]") {
  std::mt19937 generator(5);
  const ArrayNetwork network = array_network(9, 1e-3);
  // What holds 1 V at rest: 0.66 of the slew and less of it, then 0.67.
  const auto opamp = [](double gain, double share) {
    return OpAmp{
        .gain = gain, .bandwidth = 1e6, .slew = 2.0 * std::numbers::pi * 1e6 / gain / share};
  };
  double volts = 0.0;
  for (const double gain : {30.0, 1e3, 1e5})
    for (const double share : {1e-3, 0.1, 0.5}) {
      CAPTURE(gain, share);
      const RealizationOptions options{.opamp = opamp(gain, share)};
      const Circuit circuit = realize(Realization::lattice, network.problem, options);
      const StateSpace system = state_space(circuit);
      const std::size_t n = system.states();
      // At rest a bent rate is what holds the output: (A + leak) x = unbent(leak x) - b.
      Eigen::MatrixXd unslewed = view(system.dynamics);
      Eigen::VectorXd leak = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n));
      double limit = 0.0;
      for (const StateSpace::Slewing& one : system.slewing) {
        leak(static_cast<Eigen::Index>(one.state)) = one.leak;
        limit = one.limit;
      }
      unslewed.diagonal() += leak;
      const auto unbent = [&](double rate) {
        double low = -1e3 * limit;
        double high = 1e3 * limit;
        for (int k = 0; k < 200; ++k) {
          const double middle = 0.5 * (low + high);
          (slewing_rate(middle, limit) < rate ? low : high) = middle;
        }
        return 0.5 * (low + high);
      };
      Eigen::VectorXd held = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n));
      for (int k = 0; k < 200; ++k) {
        Eigen::VectorXd right = leak.cwiseProduct(held);
        for (double& one : right) one = unbent(one);
        right -= view(std::span<const double>(system.drive));
        held = unslewed.partialPivLu().solve(right);
      }
      const std::vector<double> rest(held.begin(), held.end());
      REQUIRE(view(std::span<const double>(rates(system, rest))).norm() < 1e-6 * limit);
      volts = 0.0;
      for (const double one : steady_state(system)) volts = std::max(volts, std::abs(one));
      const bool holds = certify(Realization::lattice, network.problem, options).slewing->holds();
      CHECK(holds == (share * volts <= 2.0 / 3.0));
      if (!holds) continue;
      // Its energy about that rest falls from everywhere.
      for (int k = 0; k < 200; ++k) {
        const double size = std::pow(10.0, static_cast<double>(k % 6) - 4.0);
        std::vector<double> x = random_states(n, generator, size);
        for (std::size_t i = 0; i < n; ++i) x[i] += rest[i];
        const std::vector<double> rate = rates(system, x);
        double fall = 0.0;
        for (std::size_t i = 0; i < network.problem.matrix.rows; ++i) {
          double e = 0.0;
          for (std::size_t j = 0; j < n; ++j) e += system.output(i, j) * (x[j] - rest[j]);
          for (std::size_t m = 0; m < network.problem.matrix.rows; ++m) {
            double slope = 0.0;
            for (std::size_t j = 0; j < n; ++j) slope += system.output(m, j) * rate[j];
            fall += e * network.problem.matrix(i, m) * slope;
          }
        }
        CHECK(fall < 0.0);
      }
    }
  // A gain so low that the slew does not hold the outputs is named.
  const RealizationOptions weak{.opamp = opamp(30.0, 0.7 / volts)};
  CHECK(certify(Realization::lattice, network.problem, weak).slewing->unmet.value().condition ==
        TheoremCondition::slew_holds_outputs);
}

TEST_CASE("T8: a crossbar's op-amps may slew and be fast each as it likes",
          "[slewing][theorem][property]") {
  std::mt19937 generator(11);
  const auto spread = [&] {  // over a factor of 30 to either side
    return std::pow(30.0, 2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0);
  };
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const Matrix p = random_definite(6, seed, 1e-3);
    const NetworkProblem problem{.matrix = p, .right_side = std::vector<double>(6, 1.0)};
    Circuit circuit = realize(Realization::crossbar, problem, {.opamp = {.gain = 1e9}});
    circuit.amplifiers.clear();
    for (Instance& x : circuit.instances) {
      x.subcircuit = "of_" + x.name;
      circuit.amplifiers.push_back(
          {x.subcircuit,
           {.gain = 1e9, .bandwidth = 1e6 * spread(), .slew = 1e6 * spread()},
           Outputs::complementary});
    }
    const StateSpace system = state_space(circuit);
    for (int k = 0; k < 20; ++k)
      CHECK(energy_rate(system, p, random_states(system.states(), generator, 100.0)) < 0.0);
    CHECK(slewing_settling_time(system, 1e-3, poles(system).front().real()));
  }
}

TEST_CASE("outside T8's conditions energy may rise, and it says that it does not apply",
          "[slewing][theorem]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  const OpAmp slewing{.gain = 1e9, .bandwidth = 1e6, .slew = 1e5};
  struct Outside {
    TheoremCondition condition;
    RealizationOptions options;
  };
  std::vector<Outside> outside(4, {TheoremCondition::no_second_pole, {.opamp = slewing}});
  outside[0].options.opamp.second_pole = 2e6;
  outside[1].condition = TheoremCondition::no_input_capacitance;
  outside[1].options.opamp.input_capacitance = 1e-12;
  outside[2].condition = TheoremCondition::no_output_resistance;
  outside[2].options.opamp.output_resistance = 50.0;
  outside[3].condition = TheoremCondition::complementary_outputs;
  outside[3].options.inverters = true;
  std::mt19937 generator(3);
  for (const Realization one : {Realization::crossbar, Realization::lattice})
    for (const Outside& it : outside) {
      CAPTURE(name(one), static_cast<int>(it.condition));
      const Certificate c = certify(one, network.problem, it.options);
      CHECK(c.slewing.value().unmet.value().condition == it.condition);
      if (it.condition == TheoremCondition::no_output_resistance) continue;  // shown for few loads
      const StateSpace system = state_space(realize(one, network.problem, it.options));
      // Outputs near their rest, the other states anywhere: they drive the outputs away.
      std::vector<double> x = random_states(system.states(), generator, 1.0);
      const std::vector<double> rest = steady_state(system);
      std::vector<std::size_t> of_output(rest.size());
      for (std::size_t i = 0; i < rest.size(); ++i) {
        while (system.output(i, of_output[i]) == 0.0) ++of_output[i];
        x[of_output[i]] = rest[i];
      }
      const std::vector<double> rate = rates(system, x);
      for (const std::size_t k : of_output) x[k] += 1e-12 * rate[k];
      CHECK(energy_rate(system, network.problem.matrix, x) > 0.0);
    }
  RealizationOptions loaded{.opamp = slewing, .node_capacitance = 1e-12};
  CHECK(certify(Realization::lattice, network.problem, loaded).slewing->unmet->condition ==
        TheoremCondition::no_node_capacitance);
  // Nothing is proven of the others.
  for (const Realization one : {Realization::nic, Realization::rail, Realization::least_squares})
    CHECK_FALSE(certify(one, network.problem, {.opamp = slewing}).slewing);
}

TEST_CASE("a certificate warns of slewing, with the volts that end it", "[slewing][certificate]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  RealizationOptions options{.scale = {1e-3, 10.0},
                             .opamp = {.gain = 1e6, .bandwidth = 1e7, .slew = 1e7}};
  const auto warning = [&]() -> std::optional<CircuitRemark> {
    for (const CircuitRemark& one :
         certify(Realization::crossbar, network.problem, options).remarks)
      if (one.kind == CircuitRemark::Kind::slews) return one;
    return std::nullopt;
  };
  REQUIRE(warning());
  CHECK(warning()->value > 1e7);
  options.scale.volts = 0.999 * warning()->repair;
  CHECK_FALSE(warning());
}
