#include <cmath>
#include <iostream>
#include <vector>

#include "docs/figures/circuits/numbers.hpp"
#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/sensing/exact.hpp"

namespace tactile_net::circuits {

NetworkProblem array_problem(std::size_t count, double alpha) {
  const SensorArray array{count, count > 30 ? 0.25 : 0.5, {1.5}, {Quantity::strain_x}};
  const Material pad{1.0, 0.45};
  const std::vector<Contact> contacts = {RigidContact{.half_width = 2.0}};
  const LinearProblem inverse = make_problem(array, pad, {.smoothing_length = 1.0});
  return network_problem(inverse, alpha, exact_readings(array, pad, contacts));
}

namespace {

std::string error(double value) { return std::isfinite(value) ? percent(value) : "unstable"; }

struct Case {
  Realization realization;
  std::size_t count;
  double alpha;
  bool ladder = false;
};

constexpr Case cases[] = {{Realization::least_squares, 21, 1e-3},
                          {Realization::least_squares, 21, 1e-5},
                          {Realization::least_squares, 41, 1e-3},
                          {Realization::least_squares, 21, 1e-3, true},
                          {Realization::least_squares, 41, 1e-3, true},
                          {Realization::lattice, 21, 1e-3},
                          {Realization::lattice, 21, 1e-5},
                          {Realization::lattice, 41, 1e-3},
                          {Realization::crossbar, 21, 1e-3},
                          {Realization::crossbar, 21, 1e-5}};

}  // namespace

std::string arrays_table() {
  const std::vector<int> bits = {4, 6, 8, 10, 12, 16};
  const std::vector<double> siemens = {1e-3, 1e-4, 1e-5};
  std::string text = "| realisation | N, alpha |";
  for (const int one : bits) text += " " + std::to_string(one) + " bits |";
  text += " noise |";
  for (const double one : siemens) text += " wires, " + brief(one) + " S |";
  text += "\n|---|---|";
  for (std::size_t k = 0; k < bits.size() + siemens.size() + 1; ++k) text += "---|";
  text += '\n';
  for (const Case& one : cases) {
    std::cerr << "arrays, " << name(one.realization) << ' ' << one.count << '\n';
    const NetworkProblem network = array_problem(one.count, one.alpha);
    const auto median = [&](double scale, const ToleranceOptions& options) {
      return error(tolerate(Reduction(realize(one.realization, network,
                                              {.scale = {scale, 1.0}, .ladder = one.ladder})),
                            options)
                       .median);
    };
    text += "| " + std::string(name(one.realization)) + (one.ladder ? ", ladder" : "") + " | " +
            std::to_string(one.count) + ", " + brief(one.alpha) + " |";
    for (const int b : bits) text += " " + median(1e-3, {.bits = b}) + " |";
    text += " " + median(1e-3, {.cell_noise = 0.005, .trials = 200}) + " |";
    for (const double scale : siemens) text += " " + median(scale, {.wire_resistance = 0.5}) + " |";
    text += '\n';
  }
  return text + '\n';
}

}  // namespace tactile_net::circuits
