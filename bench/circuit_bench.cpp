// Circuits: what their certificates, tolerances and decks promise, held against ngspice.
// With arguments only those floors, by number. A floor that is missed makes the exit status 1.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "bench/circuits.hpp"
#include "bench/measure.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/simulator/child_process.hpp"
#include "tests/network/networks.hpp"
#include "tests/network/problems.hpp"

namespace {

using namespace tactile_net;
using bench::Floors;
using bench::progress;
using bench::text;

constexpr OpAmp one_pole{.gain = 1e6, .bandwidth = 1e7};
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array with_amplifiers = {Realization::nic, Realization::rail, Realization::crossbar,
                                        Realization::least_squares};

const char* label(auto named) { return name(named).data(); }  // of literals

/// 1. Settling to 1e-3 as the certificate has it and as ngspice's transient shows it.
void settling_times(Floors& floors) {
  struct Kind {
    Realization realization;
    bool inverters;
  };
  double worst = 0.0;
  for (const std::size_t count : {21U, 41U})
    for (const double alpha : {1e-3, 1e-4, 1e-5}) {
      const ArrayNetwork network = array_network(count, alpha);
      for (const Kind kind :
           {Kind{Realization::nic, false}, Kind{Realization::rail, false},
            Kind{Realization::crossbar, false}, Kind{Realization::least_squares, false},
            Kind{Realization::crossbar, true}, Kind{Realization::least_squares, true}}) {
        const RealizationOptions options{
            .opamp = one_pole, .inverters = kind.inverters, .node_capacitance = 1e-11};
        const Dynamics promised =
            certify(kind.realization, network.problem, options).dynamics.value();
        const Transient seen =
            bench::transient(realize(kind.realization, network.problem, options), promised);
        const double certified = promised.settling_seconds.value_or(infinity);
        const double simulated = seen.settling_seconds.value_or(-infinity);
        worst = std::max(worst, std::abs(simulated / certified - 1.0));
        progress(text("%zu taxels, alpha %.0e, %s%s: certified %.4g us, ngspice %.4g us, %.2f %%",
                      count, alpha, label(kind.realization),
                      kind.inverters ? " with inverters" : "", 1e6 * certified, 1e6 * simulated,
                      100.0 * (simulated / certified - 1.0)));
      }
    }
  floors.at_most("1. settling time, certificate over ngspice, largest difference", worst, 0.02);
}

/// A symmetric matrix whose smallest eigenvalue is at least 1e-3 in size.
Matrix random_symmetric(bool definite, unsigned seed, std::mt19937& generator) {
  Matrix p = random_definite(3 + seed % 6, seed + 1, bench::log_uniform(generator, 1e-3, 0.1));
  if (definite) return p;
  const double shift = smallest_eigenvalue(p) + bench::log_uniform(generator, 1e-3, 0.1);
  for (std::size_t i = 0; i < p.rows; ++i) p(i, i) -= shift;
  return p;
}

/// 2. A circuit settles if and only if P is positive definite.
void verdicts(Floors& floors) {
  constexpr unsigned matrices = 300;
  constexpr unsigned simulated = 20;  // of each kind
  std::mt19937 generator(11);
  int certificates_wrong = 0;
  int poles_wrong = 0;
  int transients = 0;
  int ngspice_wrong = 0;
  for (unsigned trial = 0; trial < 2 * matrices; ++trial) {
    const bool definite = trial % 2 == 0;
    const Matrix p = random_symmetric(definite, trial / 2, generator);
    const NetworkProblem problem{.matrix = p, .right_side = std::vector<double>(p.rows, 1.0)};
    const double farad = bench::log_uniform(generator, 1e-13, 1e-9);
    for (std::size_t one = 0; one < 3; ++one) {
      const Realization realization = with_amplifiers[one];
      RealizationOptions options{.opamp = one_pole, .node_capacitance = farad};
      if (realization == Realization::crossbar) options.opamp.input_capacitance = farad;
      const bool stable = certify(realization, problem, options).stability == Stability::stable;
      if (stable != definite) ++certificates_wrong;
      // T1 and T5 hold for any bandwidths, T2 for equal ones.
      const Circuit circuit = bench::scattered(realize(realization, problem, options),
                                               realization != Realization::rail, true, generator);
      if ((bench::slowest(circuit) < 0.0) != definite) ++poles_wrong;
      if (trial >= 2 * simulated) continue;
      ++transients;
      const TransientEnd end = bench::transient(circuit, bench::dynamics(circuit)).end;
      const bool right = end == (definite ? TransientEnd::settles : TransientEnd::grows);
      if (!right) ++ngspice_wrong;
      progress(text("%s, %zu nodes, smallest eigenvalue %+.1e: ngspice says %s%s",
                    label(realization), p.rows, smallest_eigenvalue(p), label(end),
                    right ? "" : ", wrong"));
    }
  }
  floors.at_most(text("2. wrong verdicts on %u random P, three realizations: by certify (equal "
                      "bandwidths)",
                      2 * matrices),
                 certificates_wrong, 0);
  floors.at_most("2. by the state space (bandwidths x/÷10, 0.1 pF to 1 nF)", poles_wrong, 0);
  floors.at_most(
      text("2. by ngspice's transient, %d circuits of %u of these P", transients, 2 * simulated),
      ngspice_wrong, 0);
}

/// 3. What least squares gains in speed at small alpha.
void speed(Floors& floors) {
  const ArrayNetwork network = array_network(41, 1e-6);
  const auto settled = [&](Realization realization) {
    const Circuit circuit = realize(realization, network.problem, {.opamp = one_pole});
    return bench::transient(circuit, bench::dynamics(circuit)).settling_seconds.value();
  };
  const double least_squares = settled(Realization::least_squares);
  const double nic = settled(Realization::nic);
  floors.at_least(text("3. settling in ngspice, 41 taxels, alpha 1e-6: least_squares %.4g us, nic "
                       "%.4g us; nic over it",
                       1e6 * least_squares, 1e6 * nic),
                  nic / least_squares, 20);
}

/// 4. Least squares with complementary outputs is stable for every gain and all bandwidths.
void least_squares_stability(Floors& floors) {
  std::mt19937 generator(13);
  int circuits = 0;
  int unstable = 0;
  int simulated = 0;
  int unsettled = 0;
  for (const double alpha : {1e-3, 1e-6}) {
    const ArrayNetwork network = array_network(21, alpha);
    for (const double rho : {1.0, 10.0, 100.0})
      for (int power = -3; power <= 3; ++power)
        for (const bool spread : {false, true}) {
          const double ratio = std::pow(10.0, power / 1.5);
          const Circuit circuit = bench::scattered(
              realize(Realization::least_squares, network.problem,
                      {.opamp = one_pole, .residual_gain = rho, .bandwidth_ratio = ratio}),
              spread, false, generator);
          ++circuits;
          if (!(bench::slowest(circuit) < 0.0)) ++unstable;
          // Both ends without spread, and between them with it: the transient takes 160 steps per
          // ratio of the fastest bandwidth to the slowest.
          if (power != (rho == 1.0 ? -3 : rho == 10.0 ? 0 : 3) || spread != (rho == 10.0)) continue;
          const Transient seen = bench::transient(circuit, bench::dynamics(circuit));
          ++simulated;
          if (seen.end != TransientEnd::settles) ++unsettled;
          progress(text("alpha %.0e, rho %g, ratio %g%s: ngspice says %s, %.4g us, took %.0f s",
                        alpha, rho, ratio, spread ? ", spread" : "", label(seen.end),
                        1e6 * seen.settling_seconds.value_or(infinity), seen.seconds));
        }
  }
  floors.at_most(
      text("4. least_squares, unstable of %d (ratio 0.01 to 100, rho 1 to 100)", circuits),
      unstable, 0);
  floors.at_most(text("4. not settled in ngspice's transient, of %d", simulated), unsettled, 0);
}

/// 5. A thousand trials against a thousand runs of ngspice.
void monte_carlo(Floors& floors) {
  const ArrayNetwork network = array_network(41, 1e-3);
  const ToleranceOptions options{.relative = 0.01, .trials = 1000};
  for (const Realization one :
       {Realization::ideal, Realization::nic, Realization::crossbar, Realization::least_squares}) {
    const Circuit circuit = realize(one, network.problem);
    const Reduction reduction(circuit);
    std::vector<std::string> decks;  // each with its own draw
    for (std::size_t trial = 0; trial < 16; ++trial)
      decks.push_back(bench::deck_of(perturbed(circuit, drawn(reduction, options, trial))));
    const std::vector<std::string> nodes = output_names(circuit);
    const auto runs_of = [&](Simulator& simulator) {
      return [&, run = std::size_t{0}]() mutable {
        return bench::in_process(
            [&] { (void)operating_point(simulator, decks[run++ % decks.size()], nodes); });
      };
    };
    const auto tolerated = [&] {
      return bench::in_process([&] { (void)tolerate(reduction, options); });
    };
    Ngspice process;
    const auto [ours, rival] = bench::compare(15, tolerated, runs_of(process));
    floors.at_least(text("5. %zu trials, %s: %.0f ms; as many runs of ngspice %.1f s; ratio",
                         options.trials, label(one), 1e3 * ours.seconds, 1e3 * rival.seconds),
                    1e3 * rival.seconds / ours.seconds, 100);
  }
}

/// 6. What 1 % parts make of the answer.
void tolerances(Floors& floors) {
  const ArrayNetwork network = array_network(41, 1e-3);
  const ToleranceOptions options{.relative = 0.01, .trials = 1000};
  const auto median = [&](Realization realization) {
    return tolerate(Reduction(realize(realization, network.problem)), options).median;
  };
  progress(text("median error, 1 %% parts: nic %.2e (design 2.7e-2), crossbar %.2e (1.7e-2)",
                median(Realization::nic), median(Realization::crossbar)));
  const double all = median(Realization::least_squares);
  const Reduction reduction(realize(Realization::least_squares, network.problem));
  std::vector<bench::Cost> errors;
  for (std::size_t trial = 0; trial < options.trials; ++trial) {
    std::vector<double> siemens = drawn(reduction, options, trial);
    for (std::size_t r = 0; r < siemens.size(); ++r)
      if (reduction.resistors()[r].starts_with("Rs")) siemens[r] = reduction.siemens()[r];
    errors.push_back({try_out(reduction, siemens).error});
  }
  floors.at_most(text("6. median error of least_squares, 1 %% parts; with the stabiliser's exact "
                      "%.2e: the rest comes from its own resistors, whose differences cancel",
                      bench::median(errors).seconds),
                 all, 3e-3);
}

/// 7. What surrounds ngspice at 401 taxels: deck, files, reading, comparison.
void overhead(Floors& floors) {
  const SensorArray array{401, 0.05, {1.5}, {Quantity::strain_x}};
  const Material pad{1.0, 0.45};
  const double alpha = 1e-5;
  const std::vector<Contact> contacts = {RigidContact{.half_width = 2.0}};
  const std::vector<double> g = sampled_readings(array, pad, sample(contacts, array));
  const LinearProblem inverse = make_problem(array, pad, {.smoothing_length = 1.0});
  const std::vector<double> direct = tikhonov_solve(inverse, alpha, g);
  const Circuit circuit = realize(Realization::ideal, network_problem(inverse, alpha, g));

  const bench::TemporaryFile deck;
  const bench::TemporaryFile raw;
  std::ofstream(deck.name()) << bench::deck_of(circuit);
  double apart = infinity;
  const auto [ours, rival] = bench::compare(
      3,
      [&] {
        return bench::in_process(
            [&] { apart = relative_l2_error(bench::relaxed(circuit), direct); });
      },
      [&] {
        return bench::in_process([&] {
          const ProcessResult result =
              run_process({"ngspice", "-n", "-b", "-r", raw.name(), deck.name()});
          if (result.end != ProcessResult::End::exited || result.code != 0)
            throw std::runtime_error("ngspice failed");
        });
      });
  floors.at_most(text("7. ideal, 401 taxels, deck to comparison: %.2f s, %.1e apart; ngspice alone "
                      "%.2f s; ratio",
                      ours.seconds, apart, rival.seconds),
                 ours.seconds / rival.seconds, 1.5);
}

/// 8. Operating points against the direct solution.
void accuracy(Floors& floors) {
  const ArrayNetwork network = array_network(41, 1e-3);
  const auto error = [&](Realization realization, const RealizationOptions& options = {}) {
    const Analysis analysis = realization == Realization::lc
                                  ? Analysis{SingleFrequency{options.frequency}}
                                  : Analysis{DirectCurrent{}};
    return relative_l2_error(
        bench::relaxed(realize(realization, network.problem, options), analysis), network.direct);
  };
  for (const Realization one : {Realization::ideal, Realization::nic, Realization::rail,
                                Realization::crossbar, Realization::least_squares, Realization::lc})
    floors.at_most(text("8. operating point against the direct solution, %s", label(one)),
                   error(one), one == Realization::ideal ? 1e-11 : 1e-10);
  for (const Realization one : with_amplifiers) {
    const auto linear = steady_state(
        state_space(realize(one, network.problem, {.opamp = {.gain = 1e9, .bandwidth = 1e7}})));
    const double predicted = 1e9 / 1e5 * relative_l2_error(linear, network.direct);
    const double found = error(one, {.opamp = {.gain = 1e5}});
    floors.at_most(text("8. gain 1e5, %s: error %.3e, first order says %.3e; apart", label(one),
                        found, predicted),
                   std::abs(found / predicted - 1.0), 0.2);
  }
  const double near = error(Realization::ndr, {.device_volts = 10.0});
  const double far = error(Realization::ndr, {.device_volts = 20.0});
  floors.at_most(text("8. ndr, error %.3e at 10 V and %.3e at 20 V, ratio %.4f; off 4 by", near,
                      far, near / far),
                 std::abs(near / far / 4.0 - 1.0), 0.05);
}

}  // namespace

int main(int count, char** arguments) {
  constexpr std::array all = {settling_times, verdicts,   speed,    least_squares_stability,
                              monte_carlo,    tolerances, overhead, accuracy};
  Floors floors;
  for (std::size_t i = 0; i < all.size(); ++i) {
    bool wanted = count == 1;
    for (int k = 1; k < count; ++k) wanted = wanted || std::to_string(i + 1) == arguments[k];
    if (!wanted) continue;
    try {
      all[i](floors);
    } catch (const std::exception& error) {
      floors.broken(std::to_string(i + 1) + ". " + error.what());
    }
  }
  return floors.all_hold() ? EXIT_SUCCESS : EXIT_FAILURE;
}
