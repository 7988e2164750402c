#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "tactile_net/network/conductances.hpp"
#include "tactile_net/network/state_space.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/network/opamps.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

constexpr double boltzmann = 1.380649e-23;
constexpr double kelvin = 300.15;
const OpAmp noisy{.gain = 1e9, .bandwidth = 1e7, .noise_voltage = 5e-9};

OutputNoise noise_of(Realization one, const NetworkProblem& problem,
                     const RealizationOptions& options) {
  return output_noise(FlatCircuit(realize(one, problem, options)));
}

double rms(double variance) { return std::sqrt(variance); }

}  // namespace

TEST_CASE("a resistor across a capacitor makes k T / C, whatever the resistor", "[noise]") {
  for (const double siemens : {1e-6, 1e-3, 1.0}) {
    Circuit circuit = resistor_and_capacitor();
    circuit.resistors[0].siemens = siemens;
    const OutputNoise noise = output_noise(FlatCircuit(circuit));
    CHECK_THAT(noise.thermal(0, 0), WithinRel(boltzmann * kelvin / 1e-9, 1e-12));
    CHECK(noise.amplifiers(0, 0) == 0.0);
    CHECK_THAT(output_noise(FlatCircuit(circuit), 2.0 * kelvin).thermal(0, 0),
               WithinRel(2.0 * boltzmann * kelvin / 1e-9, 1e-12));
  }
}

TEST_CASE("a crossbar's resistors are in equipartition: W k T P^-1", "[noise]") {
  const NetworkProblem problem = array_network(11, 1e-3).problem;
  const OutputNoise noise = noise_of(Realization::crossbar, problem, {.opamp = noisy});
  for (std::size_t i = 0; i < 11; ++i) {
    std::vector<double> unit(11);
    unit[i] = 1.0;
    const std::vector<double> column = solve_symmetric(problem.matrix, unit);
    for (std::size_t j = 0; j < 11; ++j)
      CHECK_THAT(noise.thermal(j, i),
                 WithinAbs(angular_bandwidth * boltzmann * kelvin / 1e-3 * column[j],
                           1e-6 * noise.thermal(i, i)));
  }
}

TEST_CASE("the noise of circuits is what was designed for", "[noise]") {
  const NetworkProblem problem = array_network(21, 1e-3).problem;
  const auto centre = [&](Realization one, double siemens) {
    const OutputNoise noise = noise_of(one, problem, {.scale = {siemens, 1.0}, .opamp = noisy});
    return rms(noise.thermal(10, 10) + noise.amplifiers(10, 10));
  };
  CHECK_THAT(centre(Realization::crossbar, 1e-3), WithinRel(139.4e-6, 0.01));
  CHECK_THAT(centre(Realization::least_squares, 1e-3), WithinRel(100.5e-6, 0.03));
  // Less from more conductance, until the amplifiers' own is left.
  CHECK(centre(Realization::lattice, 1e-3) < centre(Realization::lattice, 1e-4));
  const OutputNoise heavy =
      noise_of(Realization::lattice, problem, {.scale = {1e3, 1.0}, .opamp = noisy});
  CHECK(heavy.thermal(10, 10) < 1e-4 * heavy.amplifiers(10, 10));
}

TEST_CASE("noise that has no size is refused", "[noise]") {
  const NetworkProblem problem = array_network(5, 1e-3).problem;
  CHECK_THROWS_AS(noise_of(Realization::nic, problem, {.opamp = noisy}), std::domain_error);
  CHECK_NOTHROW(noise_of(Realization::nic, problem, {.opamp = noisy, .node_capacitance = 1e-11}));
  OpAmp slow = noisy;
  slow.second_pole = 1e6;
  CHECK_THROWS_AS(noise_of(Realization::least_squares, problem, {.opamp = slow}),
                  std::domain_error);
  CHECK_THROWS_AS(output_noise(FlatCircuit(resistor_and_capacitor()), -1.0), std::invalid_argument);
  CHECK_THROWS_AS(check(OpAmp{.noise_voltage = 5e-9}), std::invalid_argument);
  CHECK_THROWS_AS(check(OpAmp{.bandwidth = 1e6, .noise_voltage = 0.0}), std::invalid_argument);
}

TEST_CASE("1/f noise of one pole has its integral in closed form", "[noise][flicker]") {
  // A crossbar of one node is a follower of one pole at a = W P / D = W: e^2 f_c/f through it is
  // e^2 f_c log(1 + a^2/w0^2) / 2 from w0 on.
  NetworkProblem problem = array_network(3, 1e-3).problem;
  problem.matrix = {1, 1, {2.0}};
  problem.right_side = {1.0};
  OpAmp opamp = noisy;
  opamp.gain = 1e15;
  for (const double corner : {1.0, 1e3, 1e6})
    for (const double lowest : {0.1, 1e5, 1e9}) {
      opamp.noise_corner = corner;
      const Circuit circuit = realize(Realization::crossbar, problem, {.opamp = opamp});
      const OutputNoise noise = output_noise(FlatCircuit(circuit), kelvin, lowest);
      const double ratio = 1e7 / lowest;
      CHECK_THAT(noise.flicker(0, 0),
                 WithinRel(0.5 * 5e-9 * 5e-9 * corner * std::log1p(ratio * ratio), 1e-9));
    }
}

TEST_CASE("1/f noise is the integral of what every frequency adds", "[noise][flicker]") {
  // Of circuits that ring, and of slow ones: against the sum over frequencies of |C (jw - A)^-1
  // B|^2.
  for (const double alpha : {1e-3, 1e-5})
    for (const Realization one :
         {Realization::crossbar, Realization::least_squares, Realization::lattice}) {
      CAPTURE(alpha, name(one));
      OpAmp opamp = noisy;
      opamp.noise_corner = 1e4;
      const FlatCircuit circuit(realize(one, array_network(5, alpha).problem, {.opamp = opamp}));
      const StateSpace system = state_space(circuit);
      const double lowest = 50.0;
      const OutputNoise noise = output_noise(circuit, kelvin, lowest);
      const auto states = static_cast<Eigen::Index>(system.states());
      const Eigen::MatrixXd a = view(system.dynamics);
      const Eigen::MatrixXd c = view(system.output);
      // Each amplifier's own noise enters its state, W e.
      double sum = 0.0;
      const double step = 0.002;
      for (double x = std::log(lowest) + 0.5 * step; x < std::log(1e10); x += step) {
        const double hertz = std::exp(x);
        Eigen::MatrixXcd shifted = -a.cast<std::complex<double>>();
        shifted.diagonal().array() += std::complex<double>(0.0, 2.0 * std::numbers::pi * hertz);
        const Eigen::RowVectorXcd row = c.row(2).cast<std::complex<double>>();
        const Eigen::VectorXcd through = shifted.transpose().partialPivLu().solve(row.transpose());
        sum += step * through.head(states).squaredNorm();
      }
      const double expected = sum * std::pow(angular_bandwidth * 5e-9, 2) * 1e4;
      CHECK_THAT(noise.flicker(2, 2), WithinRel(expected, 2e-3));
    }
}

TEST_CASE("1/f noise grows with its corner, and asks for a white noise to exceed", "[noise]") {
  const NetworkProblem problem = array_network(5, 1e-3).problem;
  OpAmp opamp = noisy;
  CHECK(noise_of(Realization::lattice, problem, {.opamp = opamp}).flicker(2, 2) == 0.0);
  opamp.noise_corner = 100.0;
  const double once = noise_of(Realization::lattice, problem, {.opamp = opamp}).flicker(2, 2);
  opamp.noise_corner = 200.0;
  CHECK_THAT(noise_of(Realization::lattice, problem, {.opamp = opamp}).flicker(2, 2),
             WithinRel(2.0 * once, 1e-12));
  CHECK_THROWS_AS(check(OpAmp{.bandwidth = 1e6, .noise_corner = 10.0}), std::invalid_argument);
  opamp.noise_corner = -1.0;
  CHECK_THROWS_AS(check(opamp), std::invalid_argument);
  const FlatCircuit circuit(resistor_and_capacitor());
  CHECK_THROWS_AS(output_noise(circuit, kelvin, 0.0), std::invalid_argument);
}
