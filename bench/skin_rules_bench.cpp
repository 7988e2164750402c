// The rules for alpha, the weight of tangential tractions and friction's cone on random contacts of
// a skin: docs/internals/skin.md. Readings are by a grid three times as fine as the solver's.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/skin/cone.hpp"
#include "tactile_net/skin/family.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/tangential_weight.hpp"
#include "tests/skin/skins.hpp"

namespace {

using namespace tactile_net;

constexpr double friction_limit = 0.8;

double error(const std::vector<double>& found, const std::vector<double>& truth) {
  double wrong = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    wrong = std::hypot(wrong, found[i] - truth[i]);
    size = std::hypot(size, truth[i]);
  }
  return wrong / size;
}

void print(const std::string& what, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  std::printf("| %s | %.2f / %.2f / %.2f |\n", what.c_str(), values[n / 2], values[n * 19 / 20],
              values.back());
}

struct Contact {
  std::vector<double> truth, readings;
  double rms;
};

std::vector<Contact> contacts(const SkinArray& skin, const SkinGrid& grid, std::size_t count) {
  const SkinGrid fine = grid_of(skin, {.spacing = 1e-3 / 3.0, .margin = 4e-3});
  std::mt19937 random(20261123);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Contact> all(count);
  for (Contact& one : all) {
    const auto loads = random_contacts(random, 0.5e-3 * static_cast<double>(skin.rows));
    one.truth = cell_means(loads, grid);
    one.readings = sampled_readings(skin, silicone, fine, cell_means(loads, fine));
    double largest = 0.0;
    for (const double reading : one.readings) largest = std::max(largest, std::abs(reading));
    one.rms = largest * 1e-3 * std::pow(50.0, unit(random));
    std::normal_distribution<double> noise(0.0, one.rms);
    for (double& reading : one.readings) reading += noise(random);
  }
  return all;
}

void compare_rules(std::size_t count) {
  const SkinArray skin = square_skin(count, 2e-3);
  const SkinProblem problem = make_problem(skin, silicone);
  const SkinFamily family(problem);
  const AlphaTables tables(family.singular_values(), independent_readings(problem));
  constexpr std::array rules{AlphaRule::rgcv,     AlphaRule::gcv, AlphaRule::aicc,
                             AlphaRule::evidence, AlphaRule::gml, AlphaRule::discrepancy};
  std::vector<std::vector<double>> ratios(rules.size());
  for (const Contact& contact : contacts(skin, problem.grid, 60)) {
    const FilterFrame frame = family.analyse(contact.readings);
    const auto at = [&](double alpha) { return error(family.solve(frame, alpha), contact.truth); };
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 120; ++i) best = std::min(best, at(std::pow(10.0, -10.0 + i / 12.0)));
    for (std::size_t r = 0; r < rules.size(); ++r)
      ratios[r].push_back(at(choose_alone(frame, tables, rules[r], contact.rms).alpha) / best);
  }
  std::printf("%zu x %zu: error over the best alpha's, median / p95 / worst\n", count, count);
  for (std::size_t r = 0; r < rules.size(); ++r) print(std::string(name(rules[r])), ratios[r]);
}

void compare_shares(std::size_t count) {
  const SkinArray skin = square_skin(count, 2e-3);
  SkinProblem problem = make_problem(skin, silicone);
  constexpr std::array shares{1.0, 0.5, 1.0 / 3.0, 0.2};
  std::vector<std::vector<double>> ratios(shares.size());
  std::vector<double> gains, steps;
  for (const Contact& contact : contacts(skin, problem.grid, 12)) {
    problem.tangential_weight = likeliest_tangential_weight(problem, contact.readings, contact.rms);
    const SkinFamily family(problem);
    const FilterFrame frame = family.analyse(contact.readings);
    const double alpha = choose_alone(frame, AlphaRule::aicc).alpha;
    const auto at = [&](double share) {
      const SkinConeSolution found =
          SkinCone(problem, share * alpha, {.friction_limit = friction_limit})
              .solve(contact.readings);
      steps.push_back(static_cast<double>(found.iterations));
      return error(found.tractions, contact.truth);
    };
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 10; ++i) best = std::min(best, at(std::pow(10.0, 0.5 - i / 5.0)));
    for (std::size_t s = 0; s < shares.size(); ++s) ratios[s].push_back(at(shares[s]) / best);
    gains.push_back(best / error(family.solve(frame, alpha), contact.truth));
  }
  std::printf("%zu x %zu, friction's cone: error by a share of aicc's alpha over the best\n", count,
              count);
  for (std::size_t s = 0; s < shares.size(); ++s) print(std::to_string(shares[s]), ratios[s]);
  print("over that without constraints", gains);
  print("steps", steps);
}

}  // namespace

int main() {
  compare_rules(12);
  compare_rules(16);
  compare_shares(12);
}
