// The rules for alpha, the weight of tangential tractions and friction's cone on random contacts of
// a skin: docs/internals/skin.md. Readings are by a grid three times as fine as the solver's.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/tangential_weight.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/skin/forward.hpp"
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
  double largest;  // reading
};

/// Without noise.
std::vector<Contact> contacts(const SkinArray& skin, const LinearProblem& problem,
                              std::size_t count) {
  const SurfaceGrid fine =
      grid_of(skin, {.spacing = std::min(1e-3, skin.depths.front()) / 4.0, .margin = 4e-3});
  std::mt19937 random(20261123);
  std::vector<Contact> all(count);
  for (Contact& one : all) {
    std::vector<SkinLoad> loads = random_contacts(random, 0.5e-3 * static_cast<double>(skin.rows));
    if (problem.components == 1)
      for (SkinLoad& load : loads) std::get<SkinContact>(load).friction = 0.0;
    one.truth = cell_means(loads, problem.grid);
    one.truth.resize(problem.components * problem.grid.count());
    one.readings = sampled_readings(skin, silicone, fine, cell_means(loads, fine));
    one.largest = 0.0;
    for (const double reading : one.readings)
      one.largest = std::max(one.largest, std::abs(reading));
  }
  return all;
}

struct NoisyReadings {
  std::vector<double> readings;
  double rms;
};

NoisyReadings with_noise(const Contact& contact, double share, std::mt19937& random) {
  NoisyReadings noisy{contact.readings, share * contact.largest};
  std::normal_distribution<double> noise(0.0, noisy.rms);
  for (double& reading : noisy.readings) reading += noise(random);
  return noisy;
}

struct Setting {
  const char* name;
  std::size_t count;
  double depth;
  std::vector<Quantity> reads;
};

/// Each rule's errors over those of the best alpha, and the default's, with the noise known and
/// not. @return whether no frame of the default is more than three times as wrong as the best
bool compare_rules(std::size_t frames) {
  const std::vector<Quantity> pressure{Quantity::stress_x};
  const std::array settings{Setting{"12 x 12 x 3, depth two pitches", 12, 2e-3, press_and_drag},
                            Setting{"12 x 12, depth two pitches", 12, 2e-3, pressure},
                            Setting{"10 x 10 x 3, depth one pitch", 10, 1e-3, press_and_drag},
                            Setting{"10 x 10, depth one pitch", 10, 1e-3, pressure},
                            Setting{"8 x 8 x 3, depth half a pitch", 8, 5e-4, press_and_drag},
                            Setting{"8 x 8, depth half a pitch", 8, 5e-4, pressure},
                            Setting{"4 x 4 x 3, depth two pitches", 4, 2e-3, press_and_drag},
                            Setting{"4 x 4, depth one pitch", 4, 1e-3, pressure}};
  constexpr std::array rules{AlphaRule::rgcv,     AlphaRule::gcv, AlphaRule::aicc,
                             AlphaRule::evidence, AlphaRule::gml, AlphaRule::discrepancy};
  constexpr std::size_t places = 50;  // frame after frame, from the first again
  std::printf(
      "| skin | noise | rgcv | gcv | aicc | evidence | gml | discrepancy | default, noise known | "
      "not known |\n|---|---|---|---|---|---|---|---|---|---|\n");
  bool holds = true;
  for (const Setting& setting : settings) {
    const SkinArray skin = square_skin(setting.count, setting.depth, setting.reads);
    SkinProblemOptions options;
    options.components = setting.reads.size() == 1 ? 1 : 3;
    const LinearProblem problem = make_problem(skin, silicone, options);
    const TikhonovFamily family(problem);
    const AlphaTables tables(family.singular_values(), independent_readings(problem));
    const double largest =
        *std::max_element(family.singular_values().begin(), family.singular_values().end());
    const std::vector<Contact> all = contacts(skin, problem, places);
    std::mt19937 random(7);
    for (const double share : {0.001, 0.01, 0.05}) {
      std::vector<std::vector<double>> ratios(rules.size());
      for (std::size_t k = 0; k < frames; ++k) {
        const Contact& contact = all[k % places];
        const NoisyReadings noisy = with_noise(contact, share, random);
        const FilterFrame frame = family.analyse(noisy.readings);
        const auto at = [&](double alpha) {
          return error(family.solve(frame, alpha), contact.truth);
        };
        double best = std::numeric_limits<double>::infinity();
        double best_power = 0.0;
        const auto try_at = [&](double power) {
          if (const double here = at(largest * largest * std::pow(10.0, power)); here < best) {
            best = here;
            best_power = power;
          }
        };
        for (int i = 0; i < 28; ++i) try_at(-0.35 * i);
        for (const double middle = best_power; const int i : {-3, -2, -1, 1, 2, 3})
          try_at(middle + 0.09 * i);
        for (std::size_t r = 0; r < rules.size(); ++r)
          ratios[r].push_back(at(choose_alone(frame, tables, rules[r], noisy.rms).alpha) / best);
      }
      std::printf("| %s | %g %% |", setting.name, 100.0 * share);
      const auto print_one = [&](std::vector<double> values) {
        std::sort(values.begin(), values.end());
        std::printf(" %.2f, %.2f |", values[values.size() * 19 / 20], values.back());
        return values.back();
      };
      for (const auto& values : ratios) print_one(values);
      for (const bool known : {true, false}) {
        const auto at = std::find(rules.begin(), rules.end(), default_rule(tables, known));
        holds &= print_one(ratios[static_cast<std::size_t>(at - rules.begin())]) <= 3.0;
      }
      std::printf("\n");
    }
  }
  return holds;
}

void compare_shares(std::size_t count) {
  const SkinArray skin = square_skin(count, 2e-3);
  LinearProblem problem = make_problem(skin, silicone);
  constexpr std::array shares{1.0, 0.5, 1.0 / 3.0, 0.2};
  std::vector<std::vector<double>> ratios(shares.size());
  std::vector<double> gains, steps;
  std::mt19937 random(20261123);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Contact& contact : contacts(skin, problem, 12)) {
    const NoisyReadings noisy = with_noise(contact, 1e-3 * std::pow(50.0, unit(random)), random);
    problem.tangential_weight = likeliest_tangential_weight(problem, noisy.readings, noisy.rms);
    const TikhonovFamily family(problem);
    const FilterFrame frame = family.analyse(noisy.readings);
    const double alpha = choose_alone(frame, AlphaRule::aicc).alpha;
    const auto at = [&](double share) {
      const ConeSolution found =
          ConeTikhonov(problem, share * alpha, {.friction_limit = friction_limit})
              .solve(noisy.readings);
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

int main(int count, char** words) {
  const bool holds = compare_rules(count > 1 ? std::stoul(words[1]) : 100);
  compare_shares(12);
  std::printf("the default is never more than 3 times as wrong as the best alpha: %s\n",
              holds ? "holds" : "DOES NOT HOLD");
  return holds ? 0 : 1;
}
