// Real op-amps in ngspice: errors at rest, slewing, noise, and contacts that move.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <memory>
#include <sstream>

#include "network/angular_frequency.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/drawn_circuit.hpp"
#include "tactile_net/network/motion.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/network/soldered_error.hpp"
#include "tactile_net/network/static_errors.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tactile_net/simulator/step_response.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/network/opamps.hpp"
#include "tests/network/problems.hpp"
#include "tests/simulator/at_rest.hpp"
#include "tests/simulator/noise.hpp"

using namespace tactile_net;

namespace {

const std::vector<Realization> of_opamps = {Realization::nic, Realization::rail,
                                            Realization::crossbar, Realization::least_squares,
                                            Realization::lattice};

}  // namespace

TEST_CASE("every error of an op-amp is the same in ngspice's operating point", "[spice][opamp]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const Realization one : of_opamps) {
    const auto circuit = [&](OpAmp opamp) {
      opamp.gain = 1e6;
      opamp.bandwidth = 1e7;
      return realize(one, network.problem, {.scale = {1e-3, 3.0}, .opamp = opamp});
    };
    const std::vector<double> exact = at_rest(circuit({}));
    const auto moved = [&](const OpAmp& opamp) {
      return relative_l2_error(at_rest(circuit(opamp)), exact);
    };
    const OpAmp all{.offset = 1e-3,
                    .noise_voltage = 5e-9,
                    .noise_current = 1e-12,
                    .bias_current = 1e-7,
                    .common_mode_rejection = 1e5,
                    .slew = 1e7,
                    .output_resistance = 200.0};
    CAPTURE(name(one));
    const StaticErrors errors = static_errors(FlatCircuit(circuit(all)));
    CHECK_THAT(moved({.offset = 1e-3}), WithinRel(errors.offset.alike, 0.01));
    CHECK_THAT(moved({.bias_current = 1e-7}),
               WithinRel(errors.bias_current.alike, 0.01) || WithinAbs(0.0, 1e-6));
    CHECK_THAT(moved({.common_mode_rejection = 1e5}),
               WithinRel(errors.common_mode, 0.01) || WithinAbs(0.0, 1e-6));
    CHECK_THAT(moved({.output_resistance = 200.0}), WithinRel(errors.output_resistance, 0.01));
    // All of them together are the linear equations'.
    CHECK(relative_l2_error(at_rest(circuit(all)), operating_voltages(FlatCircuit(circuit(all)))) <
          1e-5);
  }
}

TEST_CASE("in ngspice a build's answer less that at rest has no offsets in it", "[spice][opamp]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  for (const Realization one :
       {Realization::crossbar, Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const auto circuit = [&](const OpAmp& opamp) {
      return realize(one, network.problem, {.scale = {1e-2, 1.0}, .opamp = opamp});
    };
    const FlatCircuit flat(circuit({.gain = 1e6,
                                    .bandwidth = 1e7,
                                    .offset = 1e-3,
                                    .offset_limit = 1e-3,
                                    .bias_current = 1e-6}));
    const Reduction reduction(flat);
    const std::vector<double> printed(reduction.siemens().begin(), reduction.siemens().end());
    const ResistorErrors off(std::vector<double>(printed.size(), 0.01));
    const std::vector<Load> loads = {flat.circuit().sources};
    const LoadedNetwork loaded(reduction, loads,
                               {.errors = opamp_errors(flat, loads), .tare = true});
    const std::vector<double> exact = at_rest(circuit({}));
    std::vector<double> errors;
    for (std::size_t build = 0; build < 3; ++build) {
      const Circuit built = drawn_circuit(flat, {printed, off}, 4, build);
      std::vector<double> read = at_rest(built);
      Circuit idle = built;
      Circuit plain = built;
      for (CurrentSource& source : idle.sources)
        if (!source.name.starts_with("Ib")) source.ampere = 0.0;
      for (AmplifierModel& model : plain.amplifiers) {
        model.opamp.offset.reset();
        model.opamp.bias_current.reset();
      }
      std::erase_if(plain.sources,
                    [](const CurrentSource& source) { return source.name.starts_with("Ib"); });
      const std::vector<double> rest = at_rest(idle);
      const std::vector<double> without = at_rest(plain);
      CHECK(relative_l2_error(read, without) > 1e-4);
      for (std::size_t i = 0; i < read.size(); ++i) read[i] -= rest[i];
      CHECK(relative_l2_error(read, without) < 1e-7);
      errors.push_back(relative_l2_error(read, exact));
    }
    std::sort(errors.begin(), errors.end());
    const std::vector<double> drawn = loaded.builds(printed, off, 3, 4);
    for (std::size_t k = 0; k < errors.size(); ++k)
      CHECK_THAT(errors[k], WithinRel(drawn[k], 0.01));
  }
}

TEST_CASE("ngspice rests where the linear equations do with each of an op-amp's keys, and without",
          "[spice][opamp]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  const auto check = [&](Realization one, unsigned set) {
    CAPTURE(name(one), set);
    const Circuit circuit =
        realize(one, network.problem, {.scale = {1e-3, 1.0}, .opamp = opamp_with(set)});
    CHECK(relative_l2_error(at_rest(circuit), operating_voltages(FlatCircuit(circuit))) < 1e-6);
  };
  constexpr unsigned all = (1U << further_keys.size()) - 1U;
  for (std::size_t key = 0; key < further_keys.size(); ++key)
    for (const unsigned set : {1U << key, all & ~(1U << key)}) check(Realization::crossbar, set);
  for (const Realization one : of_opamps) check(one, all);
}

TEST_CASE("ngspice settles in the certificate's time with output resistances and real inputs",
          "[spice][opamp]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const Realization one : {Realization::crossbar, Realization::lattice}) {
    RealizationOptions options{.opamp = {.gain = 1e6,
                                         .bandwidth = 1e7,
                                         .second_pole = 5e7,
                                         .input_capacitance = 1e-12,
                                         .common_mode_rejection = 1e4,
                                         .output_resistance = 300.0}};
    const Certificate certificate = certify(one, network.problem, options);
    const Circuit circuit = realize(one, network.problem, options);
    Ngspice ngspice;
    const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
    CAPTURE(name(one));
    REQUIRE(seen.end == TransientEnd::settles);
    CHECK_THAT(*seen.settling_seconds, WithinRel(*certificate.dynamics->settling_seconds, 0.02));
    // It is not the circuit without them.
    options.opamp.output_resistance.reset();
    CHECK(std::abs(*certify(one, network.problem, options).dynamics->settling_seconds /
                       *certificate.dynamics->settling_seconds -
                   1.0) > 0.03);
  }
}

TEST_CASE("ngspice slews as the certificate does with all else that a class has",
          "[spice][slewing]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  const RealizationOptions options{.scale = {2e-3, 20.0}, .opamp = opamp_classes()[1].opamp};
  for (const Realization one : {Realization::crossbar, Realization::lattice}) {
    CAPTURE(name(one));
    const Certificate certificate = certify(one, network.problem, options);
    const Circuit circuit = realize(one, network.problem, options);
    Ngspice ngspice;
    const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
    REQUIRE(seen.end == TransientEnd::settles);
    CHECK_THAT(*seen.settling_seconds, WithinRel(*certificate.dynamics->settling_seconds, 0.05));
    CHECK(*certificate.dynamics->settling_seconds > 1.1 * *certificate.dynamics->unslewed_seconds);
  }
}

TEST_CASE("ngspice slews as the certificate does", "[spice][slewing]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  for (const Realization one :
       {Realization::crossbar, Realization::lattice, Realization::least_squares})
    for (const double volts : {3.0, 30.0}) {
      const RealizationOptions options{.scale = {1e-3, volts},
                                       .opamp = {.gain = 1e6, .bandwidth = 1e7, .slew = 1e7}};
      const Certificate certificate = certify(one, network.problem, options);
      const Circuit circuit = realize(one, network.problem, options);
      Ngspice ngspice;
      const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
      CAPTURE(name(one), volts);
      REQUIRE(seen.end == TransientEnd::settles);
      CHECK_THAT(*seen.settling_seconds, WithinRel(*certificate.dynamics->settling_seconds, 0.05));
      if (volts > 10.0)
        CHECK(*certificate.dynamics->settling_seconds >
              1.3 * *certificate.dynamics->unslewed_seconds);
    }
}

TEST_CASE("ngspice is as far behind a moving contact as the certificate's state space",
          "[spice][motion]") {
  // A cylinder that moves over the array: readings in 40 pieces, after a while at rest.
  constexpr std::size_t count = 21;
  constexpr int knots = 40;
  constexpr double path = 0.4;
  constexpr double rest = 5e-6;
  const SensorArray array{count, 0.5, {1.5}, {Quantity::strain_x}};
  const Material pad{1.0, 0.45};
  const LinearProblem inverse = make_problem(array, pad, {.unknowns = 1, .smoothing_length = 1.0});
  const auto at = [&](double y) {
    const std::vector<Contact> contacts = {RigidContact{.center = y, .half_width = 2.0}};
    return network_problem(inverse, 1e-3, exact_readings(array, pad, contacts));
  };
  const NetworkProblem middle = at(0.0);
  std::vector<double> rate = at(1e-3).readings;
  const std::vector<double> before = at(-1e-3).readings;
  for (std::size_t i = 0; i < count; ++i) rate[i] = (rate[i] - before[i]) / 2e-3;
  for (const Realization one :
       {Realization::crossbar, Realization::lattice, Realization::least_squares}) {
    CAPTURE(name(one));
    const RealizationOptions options{.opamp = {.gain = 1e8, .bandwidth = 1e7}};
    const NetworkCircuit circuit(one, std::make_shared<const NetworkProblem>(middle), options);
    const MotionLag lag = motion_lag(circuit, rate);
    const double speed = 0.5 * 0.01 / lag.relative;  // half of the speed at 1 %
    std::vector<Circuit> places;
    for (int k = 0; k <= knots; ++k)
      places.push_back(realize(one, at(path * (static_cast<double>(k) / knots - 0.5)), options));
    const double stop = rest + path / speed;
    std::ostringstream out;
    write_deck(out, circuit.circuit(), {.title = "moving"}, Answer::raw_file,
               StepResponse{.step = stop / 4000.0, .stop = stop});
    std::string deck = out.str();
    std::size_t from = 0;
    for (std::size_t i = 0; i < circuit.circuit().sources.size(); ++i) {
      std::string wave = "PWL(0 " + shortest(places[0].sources[i].ampere);
      for (int k = 0; k <= knots; ++k)
        wave += ' ' + shortest(rest + path / speed * k / knots) + ' ' +
                shortest(places[static_cast<std::size_t>(k)].sources[i].ampere);
      from = deck.find("PWL(", from);
      REQUIRE(from != std::string::npos);
      deck.replace(from, deck.find(')', from) + 1 - from, wave + ')');
      from += 4;
    }
    Ngspice ngspice;
    const Simulation seen = ngspice.run(deck);
    const std::span<const double> time = seen.plot.vector("time");
    // In the middle of its path: behind by what it has moved on since.
    const double now = rest + 0.5 * path / speed;
    const auto next =
        static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), now) - time.begin());
    const double share = (now - time[next - 1]) / (time[next] - time[next - 1]);
    const double step = 0.01;
    const std::vector<double> f = solve_symmetric(middle.matrix, middle.right_side);
    const std::vector<double> ahead = solve_symmetric(middle.matrix, at(step).right_side);
    const std::vector<double> back = solve_symmetric(middle.matrix, at(-step).right_side);
    double behind = 0.0;
    double moved = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::span<const double> v = seen.plot.vector("v(n" + std::to_string(i) + ")");
      const double value = v[next - 1] + share * (v[next] - v[next - 1]);
      behind += std::pow(f[i] - value, 2);
      moved += std::pow(speed * (ahead[i] - back[i]) / (2.0 * step), 2);
    }
    CHECK_THAT(std::sqrt(behind / moved), WithinRel(lag.seconds, 0.05));
    CHECK_THAT(std::sqrt(behind) / l2_norm(f), WithinRel(0.005, 0.05));
  }
}

TEST_CASE("the noise of real inputs is ngspice's", "[spice][noise]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  struct Case {
    Realization realization;
    bool ladder = false;
    std::optional<double> node{};  // a ladder's nodes need one for their noise to have a size
    double input = 1e-11;          // noise current: residual amplifiers' low resistors hide less
    double bandwidth = 1e7;
    Inputs inputs = Inputs::current;
  };
  for (const Case& one : {Case{Realization::crossbar}, Case{Realization::lattice},
                          Case{.realization = Realization::lattice, .inputs = Inputs::voltage},
                          Case{.realization = Realization::least_squares, .input = 1e-10},
                          Case{Realization::least_squares, true, 1e-12, 1e-10, 1e6}}) {
    const Circuit circuit = realize(one.realization, network.problem,
                                    {.scale = {1e-3, 1.0},
                                     .opamp = {.gain = 1e6,
                                               .bandwidth = one.bandwidth,
                                               .noise_voltage = 5e-9,
                                               .noise_current = one.input},
                                     .inputs = one.inputs,
                                     .ladder = one.ladder,
                                     .node_capacitance = one.node});
    const OutputNoise expected = output_noise(FlatCircuit(circuit));
    CAPTURE(name(one.realization), one.ladder);
    const double all = expected.thermal(5, 5) + expected.amplifiers(5, 5);
    CHECK_THAT(noise_in_ngspice(circuit, "n5"), WithinRel(std::sqrt(all), 0.03));
    CHECK(expected.amplifiers(5, 5) > 0.1 * all);
  }
}

TEST_CASE("a second pole's stage adds no noise of its own in ngspice", "[spice][noise]") {
  // With a resistor of 1 kilo-ohm in it, 4 nV per root of Hz up to the second pole: twice what is
  // expected at 2 GHz, a fifth more where the amplifiers are slow.
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const Realization one : {Realization::crossbar, Realization::lattice})
    for (const OpAmp& opamp :
         {OpAmp{.gain = 1e6, .bandwidth = 1e7, .second_pole = 2e9, .noise_voltage = 1e-9},
          OpAmp{.gain = 1e6, .bandwidth = 3e5, .second_pole = 3e7, .noise_voltage = 1e-9}}) {
      CAPTURE(name(one), *opamp.second_pole);
      const Circuit circuit = realize(one, network.problem, {.opamp = opamp});
      const OutputNoise expected = output_noise(FlatCircuit(circuit));
      CHECK_THAT(noise_in_ngspice(circuit, "n5"),
                 WithinRel(std::sqrt(expected.thermal(5, 5) + expected.amplifiers(5, 5)), 0.03));
    }
}

TEST_CASE("ngspice settles in the certificate's time from where offsets hold the circuit",
          "[spice][opamp]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  for (const Realization one : {Realization::crossbar, Realization::lattice}) {
    const RealizationOptions options{
        .opamp = {.gain = 1e6, .bandwidth = 1e7, .offset = 0.05, .bias_current = 1e-6}};
    const Certificate certificate = certify(one, network.problem, options);
    const Circuit circuit = realize(one, network.problem, options);
    Ngspice ngspice;
    const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
    CAPTURE(name(one), certificate.errors->offset.alike);
    REQUIRE(seen.end == TransientEnd::settles);
    CHECK_THAT(*seen.settling_seconds, WithinRel(*certificate.dynamics->settling_seconds, 0.02));
  }
}

TEST_CASE("ngspice slews as the certificate does where cores that hold a voltage leak",
          "[spice][slewing]") {
  // At 10 V the finite gain asks for 6 % of the slew at rest.
  const ArrayNetwork network = array_network(7, 1e-3);
  for (const Realization one : {Realization::nic, Realization::crossbar}) {
    CAPTURE(name(one));
    RealizationOptions options{.scale = {1e-3, 10.0},
                               .opamp = {.gain = 1e4, .bandwidth = 1e7, .slew = 1e6}};
    if (one == Realization::nic) options.node_capacitance = 1e-11;
    const Certificate certificate = certify(one, network.problem, options);
    const Circuit circuit = realize(one, network.problem, options);
    Ngspice ngspice;
    const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
    REQUIRE(seen.end == TransientEnd::settles);
    REQUIRE(certificate.dynamics->settling_seconds);
    CHECK_THAT(*seen.settling_seconds, WithinRel(*certificate.dynamics->settling_seconds, 0.05));
  }
}

TEST_CASE("an operating point that takes steps back of gmin is one all the same",
          "[spice][opamp]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  OpAmp opamp = opamp_classes()[1].opamp;
  opamp.rail = 12.0;
  opamp.output_resistance = 50.0;
  for (const double volts : {1.0, 10.0, 20.0}) {
    CAPTURE(volts);
    const Circuit circuit =
        realize(Realization::lattice, network.problem, {.scale = {2e-3, volts}, .opamp = opamp});
    CHECK(relative_l2_error(at_rest(circuit), operating_voltages(FlatCircuit(circuit))) < 1e-4);
  }
}

TEST_CASE("the 1/f noise of real inputs is ngspice's", "[spice][noise]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  for (const Realization one :
       {Realization::crossbar, Realization::least_squares, Realization::lattice}) {
    // A corner at which 1/f is most of it.
    const Circuit circuit = realize(
        one, network.problem,
        {.scale = {1e-3, 1.0},
         .opamp = {.gain = 1e6, .bandwidth = 1e7, .noise_voltage = 5e-9, .noise_corner = 1e6}});
    const OutputNoise expected = output_noise(FlatCircuit(circuit));
    std::ostringstream out;
    write_deck(out, circuit, {.title = "1/f noise"}, Answer::raw_file);
    std::string deck = out.str();
    const std::string source = one == Realization::lattice ? "I0p" : "I0";
    deck.replace(deck.find(".op\n"), 4, ".noise v(n4) " + source + " dec 40 0.1 1e10\n");
    deck.insert(deck.find('\n', deck.find(source + ' ')), " AC 1");
    Ngspice ngspice;
    CAPTURE(name(one));
    const double all = expected.thermal(4, 4) + expected.amplifiers(4, 4) + expected.flicker(4, 4);
    CHECK_THAT(noise_of(ngspice.run(deck)), WithinRel(std::sqrt(all), 0.03));
    CHECK(expected.flicker(4, 4) > 0.2 * all);
  }
}

namespace {

/// Op-amps as they are sold, and what a board adds: 10 pF at inputs, 20 pF at nodes that nothing
/// drives, 30 pF behind 100 ohm at outputs, 0.05 pF across resistors.
RealizationOptions on_a_board(Realization one, bool ladder) {
  RealizationOptions options{.scale = {.siemens = 1e-2},
                             .opamp = {.gain = 1e6,
                                       .bandwidth = 1e7,
                                       .second_pole = 2.5e7,
                                       .input_capacitance = 10e-12,
                                       .differential_capacitance = 1e-12,
                                       .load_capacitance = 30e-12,
                                       .noise_voltage = 5e-9,
                                       .output_resistance = 100.0},
                             .ladder = ladder,
                             .resistor_capacitance = 5e-14};
  if (one == Realization::least_squares) {
    options.residual_gain = 1.0;
    options.bandwidth_ratio = 0.1;
  }
  if (!has_nodes_at_outputs(one, options)) options.node_capacitance = 20e-12;
  if (one == Realization::nic || one == Realization::rail) options.divider = 500.0;
  return options;
}

}  // namespace

TEST_CASE("ngspice settles in the certificate's time, with its noise, with all that a board adds",
          "[spice][opamp]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const auto& [one, ladder] :
       {std::pair(Realization::nic, false), std::pair(Realization::rail, false),
        std::pair(Realization::crossbar, false), std::pair(Realization::least_squares, false),
        std::pair(Realization::least_squares, true), std::pair(Realization::lattice, false)}) {
    CAPTURE(name(one), ladder);
    const RealizationOptions options = on_a_board(one, ladder);
    const Certificate certificate = certify(one, network.problem, options);
    const Circuit circuit = realize(one, network.problem, options);
    REQUIRE(certificate.stability == Stability::stable);
    Ngspice ngspice;
    const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
    REQUIRE(seen.end == TransientEnd::settles);
    CHECK_THAT(*seen.settling_seconds, WithinRel(*certificate.dynamics->settling_seconds, 0.05));
    const OutputNoise expected = output_noise(FlatCircuit(circuit));
    CHECK_THAT(noise_in_ngspice(circuit, "n5"),
               WithinRel(std::sqrt(expected.thermal(5, 5) + expected.amplifiers(5, 5)), 0.03));
    // It is not the circuit without any of them.
    for (std::optional<double> RealizationOptions::*key :
         {&RealizationOptions::node_capacitance, &RealizationOptions::resistor_capacitance}) {
      RealizationOptions without = options;
      (without.*key).reset();
      if (options.*key)
        CHECK(certify(one, network.problem, without).dynamics->poles !=
              certificate.dynamics->poles);
    }
    for (std::optional<double> OpAmp::*key :
         {&OpAmp::input_capacitance, &OpAmp::differential_capacitance, &OpAmp::load_capacitance}) {
      RealizationOptions without = options;
      (without.opamp.*key).reset();
      CHECK(certify(one, network.problem, without).dynamics->poles != certificate.dynamics->poles);
    }
  }
}

TEST_CASE("a board of 41 taxels at a fifth of its siemens grows in ngspice as the certificate says",
          "[spice][opamp][long]") {
  // design: +1.2e6 1/s at 2 mS, 10 pF at inputs and 20 pF at the residuals
  const ArrayNetwork network = array_network(41, 1e-3);
  RealizationOptions options{
      .scale = {.siemens = 2e-3}, .opamp = opamp_classes()[1].opamp, .node_capacitance = 20e-12};
  options.opamp.slew.reset();  // growth is linear
  options.opamp.input_capacitance = 10e-12;
  const Certificate certificate = certify(Realization::lattice, network.problem, options);
  CHECK(certificate.stability == Stability::unstable);
  CHECK_THAT(certificate.dynamics.value().slowest, WithinRel(1.2e6, 0.05));
  const Circuit circuit = realize(Realization::lattice, network.problem, options);
  // Several modes grow almost as fast: what the state space makes of the same step, and when.
  const StateSpace system = state_space(circuit);
  const auto states = static_cast<Eigen::Index>(system.states());
  const Eigen::EigenSolver<Eigen::MatrixXd> modes(view(system.dynamics));
  const Eigen::MatrixXcd shapes = modes.eigenvectors();
  const Eigen::MatrixXcd seen_shapes = view(system.output) * shapes;
  // The error e of x obeys e' = A e from -A^-1 b at the start.
  const Eigen::VectorXcd start =
      shapes.partialPivLu()
          .solve(Eigen::Map<const Eigen::VectorXd>(system.drive.data(), states)
                     .cast<std::complex<double>>())
          .cwiseQuotient(modes.eigenvalues());
  const auto error_at = [&](double time) {
    const Eigen::VectorXcd now =
        (modes.eigenvalues() * time).array().exp().matrix().cwiseProduct(start);
    return (seen_shapes * now).real().norm();
  };
  const double growth = certificate.dynamics->slowest;
  Ngspice ngspice({.time_limit = std::chrono::minutes(8)});
  const Waveforms seen = step_response(ngspice, circuit, {.step = 2e-9, .stop = 6.0 / growth});
  const std::vector<double> rest = at_rest(circuit);
  const auto largest = [&](double first, double last, auto&& error) {
    double found = 0.0;
    for (std::size_t k = 0; k < seen.time.size(); ++k)
      if (seen.time[k] * growth >= first && seen.time[k] * growth <= last)
        found = std::max(found, error(k));
    return found;
  };
  const auto growth_of = [&](auto&& error) {
    return std::log(largest(5.0, 6.0, error) / largest(2.0, 3.0, error)) * growth / 3.0;
  };
  const double expected = growth_of([&](std::size_t k) { return error_at(seen.time[k]); });
  const double found = growth_of([&](std::size_t k) {
    std::vector<double> v;
    for (const std::vector<double>& output : seen.voltages) v.push_back(output[k]);
    return l2_difference(v, rest);
  });
  CHECK(expected > 0.8 * growth);
  CHECK_THAT(found, WithinRel(expected, 0.05));
  options.scale.siemens = 1e-2;
  CHECK(certify(Realization::lattice, network.problem, options).stability == Stability::stable);
}

TEST_CASE("capacitors at outputs, at inputs and between nodes are ngspice's", "[spice][opamp]") {
  for (const Realization one :
       {Realization::crossbar, Realization::least_squares, Realization::lattice}) {
    Circuit circuit = realize(one, array_network(5, 1e-3).problem,
                              {.opamp = {.gain = 1e6,
                                         .bandwidth = 1e7,
                                         .second_pole = 2.5e7,
                                         .input_capacitance = 4e-12,
                                         .output_resistance = 100.0}});
    const std::vector<Node> outputs = circuit.outputs;
    const Node input = circuit.instances[0].pins[1];
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      const std::string place = std::to_string(k);
      circuit.capacitors.push_back({"Cload" + place, outputs[k], 0, 2e-11});
      if (k > 0) circuit.capacitors.push_back({"C" + place, outputs[k - 1], outputs[k], 5e-12});
    }
    circuit.capacitors.push_back({"Caround", outputs[0], input, 1e-12});
    circuit.capacitors.push_back({"Cbetween", input, circuit.instances[1].pins[1], 3e-12});
    const StateSpace system = state_space(circuit);
    const auto states = static_cast<Eigen::Index>(system.states());
    const Eigen::Map<const Eigen::VectorXd> drive(system.drive.data(), states);
    for (const double hertz : {1e5, 1e6, 1e7, 1e8}) {
      CAPTURE(name(one), hertz);
      std::ostringstream deck;
      write_deck(deck, circuit, {.title = "capacitors"}, Answer::raw_file, SingleFrequency{hertz});
      Ngspice ngspice;
      const std::vector<double> seen =
          operating_point(ngspice, deck.str(), output_names(circuit)).voltages;
      // Every source is at 90 degrees.
      const std::complex<double> j(0.0, 1.0);
      Eigen::MatrixXcd shifted = -view(system.dynamics).cast<std::complex<double>>();
      shifted.diagonal().array() += j * angular_frequency(hertz);
      const Eigen::VectorXcd x = shifted.partialPivLu().solve(j * drive);
      const Eigen::VectorXd expected = (view(system.output) * x).real();
      for (std::size_t k = 0; k < seen.size(); ++k)
        CHECK_THAT(seen[k],
                   WithinAbs(expected(static_cast<Eigen::Index>(k)), 1e-6 * expected.norm()));
    }
  }
}
