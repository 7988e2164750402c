#include <algorithm>
#include <iostream>
#include <vector>

#include "docs/figures/circuits/numbers.hpp"
#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/network/allocation.hpp"
#include "tactile_net/network/soldered_error.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/sensing/exact.hpp"

namespace tactile_net::circuits {
namespace {

constexpr std::size_t builds = 200;

struct Form {
  Realization realization = Realization::lattice;
  bool ladder = false;
};

constexpr Form forms[] = {
    {Realization::least_squares}, {Realization::least_squares, true}, {Realization::lattice}};

/// 41 taxels under a cylinder that lies so far from their middle.
NetworkProblem problem_at(double center) {
  const SensorArray array{41, 0.25, {1.5}, {Quantity::strain_x}};
  const Material pad{1.0, 0.45};
  const std::vector<Contact> contacts = {RigidContact{.center = center, .half_width = 2.0}};
  const LinearProblem inverse = make_problem(array, pad, {.smoothing_length = 1.0});
  return network_problem(inverse, 1e-3, exact_readings(array, pad, contacts));
}

double p95_of(const LoadedNetwork& network, const Reduction& reduction,
              const std::vector<double>& tolerances) {
  const std::vector<double> errors = network.builds(reduction.siemens(), tolerances, builds, 1);
  return errors[errors.size() * 95 / 100];
}

std::string row(const Form& form, const std::vector<double>& centers, double target) {
  const RealizationOptions options{.ladder = form.ladder};
  const Reduction reduction(realize(form.realization, problem_at(0.0), options));
  std::vector<Load> loads;
  for (const double center : centers)
    loads.push_back(
        Reduction(realize(form.realization, problem_at(center), options)).equations().right_side);
  const LoadedNetwork all(reduction, loads);
  const AllocationOptions wanted{.target = target};
  const Allocation list = allocate(all.sensitivities(), wanted);
  std::vector<double> tolerances;
  for (const std::size_t one : list.class_of) tolerances.push_back(wanted.classes[one].tolerance);
  double worst = 0.0;
  for (const Load& load : loads)
    worst = std::max(
        worst, p95_of(LoadedNetwork(reduction, std::vector<Load>{load}), reduction, tolerances));
  const std::size_t better = list.class_of.size() - list.counts[0];
  return "| " + std::string(name(form.realization)) + (form.ladder ? ", ladder" : "") + " | " +
         std::to_string(loads.size()) + " | " + std::to_string(list.class_of.size()) + " | " +
         std::to_string(better) + " | " + brief(list.price) + " | " +
         percent(list.price / list.price_bound - 1.0) + " | " +
         percent(p95_of(all, reduction, tolerances)) + " | " + percent(worst) + " |\n";
}

}  // namespace

std::string allocations_table() {
  constexpr double eighth = 41 * 0.25 / 8.0;
  const std::vector<double> places[] = {
      {0.0}, {-eighth, 0.0, eighth}, {-2.0 * eighth, -eighth, 0.0, eighth, 2.0 * eighth}};
  std::string text =
      "| realisation | loads | resistors | better than 1 % | price | above the bound | 95 of 100 "
      "builds | the worst load's |\n|---|---|---|---|---|---|---|---|\n";
  for (const Form& form : forms)
    for (const std::vector<double>& centers : places) {
      std::cerr << "lists of parts, " << name(form.realization) << ", " << centers.size()
                << " loads\n";
      text += row(form, centers, 3e-3);
    }
  return text + '\n';
}

}  // namespace tactile_net::circuits
