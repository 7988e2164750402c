#include "tactile_net/simulator/step_response.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "numeric/named.hpp"
#include "tactile_net/numeric/comparison.hpp"

namespace tactile_net {
namespace {

std::vector<double> at(const Waveforms& waveforms, std::size_t k) {
  std::vector<double> values;
  for (const auto& voltage : waveforms.voltages) values.push_back(voltage[k]);
  return values;
}

double distance(std::span<const double> a, std::span<const double> b) {
  std::vector<double> difference(a.begin(), a.end());
  for (std::size_t i = 0; i < b.size(); ++i) difference[i] -= b[i];
  return l2_norm(difference);
}

double slowest_bandwidth(const Circuit& circuit) {
  double hertz = std::numeric_limits<double>::infinity();
  for (const AmplifierModel& model : circuit.amplifiers)
    hertz = std::min(hertz, model.opamp.bandwidth.value_or(hertz));
  return hertz;
}

double fastest_bandwidth(const Circuit& circuit) {
  double hertz = 0.0;
  for (const AmplifierModel& model : circuit.amplifiers)
    hertz = std::max(hertz, model.opamp.bandwidth.value_or(0.0));
  return hertz;
}

/// How fast the outputs' size grows over the last third of the time.
double growth_of(const Waveforms& waveforms) {
  const std::size_t last = waveforms.time.size() - 1;
  const double from = waveforms.time[last] * 2.0 / 3.0;
  const auto first = static_cast<std::size_t>(
      std::lower_bound(waveforms.time.begin(), waveforms.time.end(), from) -
      waveforms.time.begin());
  // A ringing mode: the largest value early and late in that time.
  const auto largest = [&](std::size_t begin, std::size_t end) {
    double value = 0.0;
    double time = 0.0;
    for (std::size_t k = begin; k < end; ++k)
      if (const double now = l2_norm(at(waveforms, k)); now > value) {
        value = now;
        time = waveforms.time[k];
      }
    return std::pair(value, time);
  };
  const std::size_t middle = (first + last) / 2;
  const auto [early, t0] = largest(first, middle);
  const auto [late, t1] = largest(middle, last + 1);
  return t1 > t0 && early > 0.0 ? std::log(late / early) / (t1 - t0) : 0.0;
}

}  // namespace

std::string_view name(TransientEnd end) noexcept {
  return name_in<Enumerators<TransientEnd>::all>(end);
}

Waveforms step_response(Simulator& simulator, const Circuit& circuit,
                        const StepResponse& response) {
  std::ostringstream deck;
  write_deck(deck, circuit, {.title = "step response"}, Answer::raw_file, response);
  const Simulation simulation = simulator.run(deck.str());
  const auto refuse = [](const std::string& text) {
    throw SimulatorError(SimulatorError::Cause::bad_result, text, {});
  };
  if (simulation.plot.plot != "Transient Analysis" || simulation.plot.points < 2)
    refuse("the simulator gave '" + simulation.plot.plot + "', not a transient");
  Waveforms waveforms{.time = {}, .voltages = {}, .seconds = simulation.seconds};
  try {
    const std::span<const double> time = simulation.plot.vector("time");
    waveforms.time.assign(time.begin(), time.end());
    for (const Node node : circuit.outputs) {
      const std::span<const double> v = simulation.plot.vector("v(" + circuit.nodes[node] + ")");
      waveforms.voltages.emplace_back(v.begin(), v.end());
    }
  } catch (const std::out_of_range& error) {
    refuse(std::string("the simulator's answer lacks a node: ") + error.what());
  }
  return waveforms;
}

std::optional<double> settling_time(const Waveforms& waveforms, std::span<const double> end,
                                    double accuracy) {
  const double limit = accuracy * l2_norm(end);
  double before = std::numeric_limits<double>::infinity();
  std::optional<double> settled;
  for (std::size_t k = 0; k < waveforms.time.size(); ++k) {
    const double now = distance(at(waveforms, k), end);
    if (now > limit) {
      settled.reset();
    } else if (!settled) {  // between two points on a straight line of logarithms
      const double share =
          k > 0 && now > 0.0 ? std::log(before / limit) / std::log(before / now) : 1.0;
      settled =
          k > 0 ? waveforms.time[k - 1] + share * (waveforms.time[k] - waveforms.time[k - 1]) : 0.0;
    }
    before = now;
  }
  return settled;
}

Transient settle(Simulator& simulator, const Circuit& circuit, const Certificate& certificate,
                 std::span<const double> end) {
  if (!certificate.dynamics) throw std::invalid_argument("the certificate has no dynamics");
  const Dynamics& dynamics = *certificate.dynamics;
  const double size = l2_norm(end);
  Transient seen;
  if (size == 0.0) throw std::invalid_argument("without a load there is nothing to settle to");
  const auto bounded = [&](const Waveforms& waveforms) {
    return l2_norm(at(waveforms, waveforms.time.size() - 1)) <= 1e3 * size;
  };
  const auto grown = [&](const Waveforms& waveforms) {
    seen.end = TransientEnd::grows;
    seen.growth = growth_of(waveforms);
    seen.mode = at(waveforms, waveforms.time.size() - 1);
    const double length = l2_norm(seen.mode);
    for (double& value : seen.mode) value /= length;
    return seen;
  };
  const auto run = [&](const StepResponse& response) {
    Waveforms waveforms = step_response(simulator, circuit, response);
    seen.seconds += waveforms.seconds;
    seen.simulated = response.stop;
    return waveforms;
  };

  // A kick shows modes that a symmetric load leaves asleep, and would change a settling time.
  const double kick = dynamics.slowest < 0.0 ? 0.0 : 0.1;
  try {
    const double slow = slowest_bandwidth(circuit);
    if (std::isfinite(slow)) {
      const double step = 0.02 / fastest_bandwidth(circuit);
      const double stop =
          std::clamp(20.0 / (2.0 * std::numbers::pi * slow), 20.0 * step, 1e5 * step);
      const Waveforms early = run({.step = step, .stop = stop, .kick = kick});
      if (!bounded(early)) return grown(early);
    }
    double horizon = 25.0 / std::max(std::abs(dynamics.slowest), 1e-300);
    if (dynamics.slowest < 0.0 && dynamics.settling_seconds.value_or(0.0) > 0.0)
      horizon = 2.0 * *dynamics.settling_seconds;
    // A decay is straight in its logarithm; ringing needs its periods resolved.
    double step = horizon / 800.0;
    if (dynamics.damping < 0.9) {
      step = horizon / 4000.0;
      if (const double fast = fastest_bandwidth(circuit); fast > 0.0)
        step = std::max(std::min(step, 0.02 / fast), horizon / 20000.0);
    }
    const Waveforms waveforms = run({.step = step, .stop = horizon, .kick = kick});
    if (!bounded(waveforms)) return grown(waveforms);
    seen.end_error = distance(at(waveforms, waveforms.time.size() - 1), end) / size;
    seen.settling_seconds = settling_time(waveforms, end, certificate.accuracy);
    seen.end = seen.settling_seconds ? TransientEnd::settles : TransientEnd::unsettled;
  } catch (const SimulatorError& error) {
    if (error.cause() == SimulatorError::Cause::diverged)
      seen.end = TransientEnd::grows;
    else if (error.cause() == SimulatorError::Cause::timed_out)
      seen.end = TransientEnd::unfinished;
    else
      throw;
    error.discard();  // the verdict says it all
  }
  return seen;
}

}  // namespace tactile_net
