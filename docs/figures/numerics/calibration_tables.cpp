// Writes docs/internals/calibration.md: how often calibrations tell the truth, and what they do to
// the tractions.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/traction_field.hpp"
#include "tests/calibration/next_press_trial.hpp"
#include "tests/calibration/next_skin_press_trial.hpp"
#include "tests/calibration/simulated_log.hpp"

namespace {

using namespace tactile_net;

constexpr unsigned logs_each = 200;  // of every row

constexpr const char* introduction = R"(# Calibrations over many logs

Written by `tactile-net-calibration-tables docs/internals/calibration.md` (target `tactile_net_calibration_tables`); no number here is typed in.

Set-up: 41 taxels 0.5 mm apart read stress_x, 1.5 mm deep in a bonded layer of 3 mm, nu 0.45; 20 cylinders at random places within 8 mm, half
widths 0.6 to 2 mm, 50 to 400 N/m; gains 5 % apart, offsets of two noise rms, 20 unloaded frames; white noise of a share of the log's largest
reading. LOGS logs in every row. The nominal scene is wrong by 15 % in depth, 10 % in thickness and 0.03 in nu, at random.

## The truth and the standard deviations

*depth*, *gains*: rms errors; *cover*: how often the truth lies within 1.96 stated standard deviations, which should be 0.95; gains where no force is
known about their mean. *residuals*: their rms over the noise. *failed*: logs whose fit was not `ok`.

| noise | known | depth, cover | thickness cover | nu cover | gains, cover | residuals | failed |
|---|---|---|---|---|---|---|---|
)";

std::string text(const char* format, auto... values) {
  std::array<char, 256> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

/// The introduction with the number of logs in it.
std::string introduction_of(unsigned logs) {
  std::string words = introduction;
  const std::string mark = "LOGS";
  words.replace(words.find(mark), mark.size(), std::to_string(logs));
  return words;
}

std::string coverage_row(double noise, const char* known, const LogOptions& like) {
  double depth2 = 0.0, gain2 = 0.0, rms = 0.0;
  double depth = 0.0, thickness = 0.0, nu = 0.0, gains = 0.0;
  unsigned failed = 0;
  for (unsigned seed = 0; seed < logs_each; ++seed) {
    LogOptions options = like;
    options.noise = noise;
    const SimulatedLog made = simulated_log(1000 + seed, options);
    const PressFit fit = fit_presses(made.model(), made.log);
    failed += fit.verdict == FitVerdict::ok ? 0U : 1U;
    const auto within = [](double error, double sd) {
      return std::abs(error) < 1.96 * sd ? 1.0 : 0.0;
    };
    const auto cover = [&](PadParameter parameter, double truth) {
      return within(fit.at(parameter).value - truth, fit.at(parameter).sd) / logs_each;
    };
    depth2 += std::pow(fit.at(PadParameter::depth).value / 1.5e-3 - 1.0, 2) / logs_each;
    rms += fit.rms / logs_each;
    depth += cover(PadParameter::depth, 1.5e-3);
    thickness += cover(PadParameter::thickness, 3e-3);
    nu += cover(PadParameter::poisson_ratio, 0.45);
    double mean = 0.0;
    const auto n = static_cast<double>(made.gains.size());
    if (!like.knows_force)
      for (std::size_t j = 0; j < made.gains.size(); ++j)
        mean += std::log(fit.gains[j] / made.gains[j]) / n;
    for (std::size_t j = 0; j < made.gains.size(); ++j) {
      const double error = std::log(fit.gains[j] / made.gains[j]) - mean;
      gain2 += error * error / n / logs_each;
      gains += within(error, fit.gain[j].sd / fit.gain[j].value) / n / logs_each;
    }
  }
  return text("| %g %% | %s | %.2f %%, %.3f | %.3f | %.3f | %.1f %%, %s | %.3f | %u |\n",
              100.0 * noise, known, 100.0 * std::sqrt(depth2), depth, thickness, nu,
              100.0 * std::sqrt(gain2), like.knows_force ? text("%.3f", gains).c_str() : "-", rms,
              failed);
}

/// What a calibration does to tractions: new contacts, nothing pulls, alpha a tenth of rgcv's.
struct Errors {
  double resultant2 = 0.0;
  std::vector<double> field{};
};

void reconstruct(const SensorArray& array, const Material& pad, const std::vector<double>& gains,
                 const std::vector<std::vector<double>>& frames,
                 const std::vector<Contact>& contacts, Errors& errors) {
  const LineProblemOptions options{.smoothing_length = array.depths.front(),
                                   .surface = {.basis = SurfaceBasis::hats}};
  const LinearProblem problem = make_problem(array, pad, options);
  const TikhonovFamily family(problem);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    std::vector<double> readings = frames[i];
    for (std::size_t j = 0; j < readings.size(); ++j) readings[j] /= gains[j];
    const double alpha = 0.1 * choose_alone(family.analyse(readings), AlphaRule::rgcv).alpha;
    const ConstrainedSolution found =
        ConstrainedTikhonov(problem, alpha, {.nonnegative = true}).solve(readings);
    const TractionField truth =
        sample(std::vector<Contact>{contacts[i]}, surface_of(array, options.surface));
    errors.field.push_back(relative_l2_error(found.tractions, truth.normal));
    double force = 0.0;
    for (const double value : found.tractions) force += problem.grid.spacing_y * value;
    errors.resultant2 += std::pow(force / resultant(contacts[i], Traction::normal) - 1.0, 2);
  }
}

std::string traction_rows(double noise) {
  constexpr unsigned logs = 8;
  constexpr std::size_t contacts_each = 12;
  enum Row { nominal, all_known, force_only, shape_only, truth, rows };
  std::array<Errors, rows> errors;
  for (unsigned seed = 0; seed < logs; ++seed) {
    const auto log = [&](bool width, bool force) {
      return simulated_log(
          3000 + seed,
          {.noise = noise, .knows_width = width, .knows_centre = width, .knows_force = force});
    };
    const SimulatedLog made = log(true, true);
    std::mt19937_64 random(9000 + seed);
    std::normal_distribution<double> normal;
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::vector<Contact> contacts;
    std::vector<PressState> presses;
    for (std::size_t i = 0; i < contacts_each; ++i) {
      const RigidContact contact{.center = uniform(-6e-3, 6e-3),
                                 .half_width = uniform(0.6e-3, 2e-3),
                                 .force = uniform(100.0, 400.0)};
      contacts.emplace_back(contact);
      presses.push_back({contact.shape, std::log(contact.force), contact.center,
                         std::log(contact.half_width), 0.0});
    }
    const PressModel model(made.array, made.truth);
    const PressReadings clean = model.readings(model.nominal(), presses, false);
    std::vector<std::vector<double>> frames(contacts_each);
    for (std::size_t i = 0; i < contacts_each; ++i)
      for (std::size_t j = 0; j < made.gains.size(); ++j)
        frames[i].push_back(made.gains[j] * clean.value(i, j) +
                            made.log.unloaded.rms.front() * normal(random));
    SensorArray array = made.array;
    const std::vector<double> ones(made.gains.size(), 1.0);
    // A nominal scene that is wrong by 20 % in depth and 13 % in thickness, either way.
    const double side = seed % 2 == 0 ? 1.0 : -1.0;
    Material wrong = made.truth;
    array.depths = {1.5e-3 * (1.0 + 0.2 * side)};
    wrong.layer->thickness *= 1.0 + 0.13 * side;
    reconstruct(array, wrong, ones, frames, contacts, errors[nominal]);
    reconstruct(made.array, made.truth, made.gains, frames, contacts, errors[truth]);
    for (const auto& [row, width, force] : {std::tuple{all_known, true, true},
                                            {force_only, false, true},
                                            {shape_only, false, false}}) {
      const SimulatedLog other = log(width, force);
      const PressFit fit = fit_presses(other.model(), other.log);
      Material found = other.nominal;
      found.poisson_ratio = fit.at(PadParameter::poisson_ratio).value;
      found.layer->thickness = fit.at(PadParameter::thickness).value;
      array.depths = {fit.at(PadParameter::depth).value};
      reconstruct(array, found, fit.gains, frames, contacts, errors[row]);
    }
  }
  const std::array names = {"nominal", "calibrated: force, centre, width known",
                            "calibrated: force known", "calibrated: rods, nothing known",
                            "the true parameters"};
  std::string result;
  for (std::size_t row = 0; row < rows; ++row) {
    std::sort(errors[row].field.begin(), errors[row].field.end());
    result += text("| %g %% | %s | %.1f %% | %.1f %% |\n", 100.0 * noise, names[row],
                   100.0 * std::sqrt(errors[row].resultant2 / (logs * contacts_each)),
                   100.0 * errors[row].field[errors[row].field.size() / 2]);
  }
  return result;
}

struct ChoiceRow {
  PressChoice choice;
  const char* words;
};

template <class Trial>
std::string next_press_rows(const std::vector<ChoiceRow>& rows) {
  std::string result = "| more presses | readings | depth | gains |\n|---|---|---|---|\n";
  for (const auto& [choice, words] : rows) {
    const TrialErrors errors = trial_errors<Trial>(choice);
    result += text("| %s | %.1f %% | %.1f %% | %.1f %% |\n", words, 100.0 * errors.readings,
                   100.0 * errors.depth, 100.0 * errors.gains);
  }
  return result;
}

std::string time_rows() {
  std::string result;
  for (const std::size_t presses : {20U, 200U, 2000U}) {
    const SimulatedLog made = simulated_log(1, {.presses = presses});
    const PressModel model = made.model();
    const auto start = std::chrono::steady_clock::now();
    const PressFit fit = fit_presses(model, made.log);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result += text("| %zu | %.2f s | %zu |\n", presses, seconds, fit.iterations);
  }
  return result;
}

std::string coverage() {
  std::string rows = introduction_of(logs_each);
  for (const double noise : {0.01, 0.003}) {
    const auto add = [&](const char* known, const LogOptions& options) {
      std::cerr << noise << ", " << known << '\n';
      rows += coverage_row(noise, known, options);
    };
    add("force, centre, width", {});
    add("force", {.knows_width = false, .knows_centre = false});
    add("shape only", {.knows_width = false, .knows_centre = false, .knows_force = false});
  }
  return rows;
}

std::string tractions() {
  std::string rows =
      "Twelve new contacts for each of 8 logs, nothing "
      "pulls, alpha a tenth of what `rgcv` chooses; the nominal scene is wrong by 20 % in "
      "depth and 13 % in\nthickness, and its gains are 1. *resultant*: rms error of the force; "
      "*field*: median error of the tractions in the 2-norm.\n\n"
      "| noise | scene | resultant | field |\n|---|---|---|---|\n";
  for (const double noise : {0.003, 0.01}) rows += traction_rows(noise);
  return rows;
}

std::string next_presses_of_lines() {
  return std::to_string(trials_each) +
         " logs with 1 % noise and two presses in the middle, a narrow and a wide one; forces are "
         "known, places within 0.1 mm, widths not. Then five more. rms errors:\n*readings*: those "
         "predicted under cylinders all over the array, in their own rms.\n\n" +
         next_press_rows<NextPressTrial>(
             {{PressChoice::none, "none"},
              {PressChoice::chosen, "five chosen by `--next 5`"},
              {PressChoice::even, "five at even places, largest force"},
              {PressChoice::random_full_force, "five at random, largest force"},
              {PressChoice::random, "five at random, force too"}});
}

std::string next_presses_of_skins() {
  return std::to_string(trials_each) +
         " logs of 5 x 5 taxels 2 mm apart, which read stress_x and shear_xy, 1 % noise, gains 5 % "
         "apart, the nominal depth 17 % too small; two presses in the middle by balls of 3 and 8 "
         "mm with the\nlargest force. Forces and radii are known, places within 0.1 mm. Then five "
         "more, balls of 3 to 8 mm. rms errors: *readings*: those predicted under both balls all "
         "over the skin, in their own rms.\n\n" +
         next_press_rows<NextSkinPressTrial>(
             {{PressChoice::none, "none"},
              {PressChoice::chosen, "five chosen by `--next 5`"},
              {PressChoice::even, "the corners and the middle, largest force"},
              {PressChoice::random_full_force, "five at random, largest force"},
              {PressChoice::random, "five at random, force too"}});
}

std::string times() {
  return "One fit of known loads, which takes one start, on one core of the machine "
         "that wrote this page, busy or not.\n\n| presses | time | iterations |\n|---|---|---|\n" +
         time_rows();
}

/// A part of the page; the first has the page's heading in it.
struct Section {
  std::string heading;
  std::string (*text)();
};

const std::array sections = {Section{"", coverage},
                             Section{"## What it does to the tractions\n\n", tractions},
                             Section{"## The next presses\n\n", next_presses_of_lines},
                             Section{"## The next presses on a skin\n\n", next_presses_of_skins},
                             Section{"## Time\n\n", times}};

/// @param one    a heading: that section alone is made, the others stay as they are in `before`
std::string page(const std::string& one, const std::string& before) {
  const auto start_of = [&](std::size_t i) {
    return i < sections.size() ? before.find('\n' + sections[i].heading) : before.size();
  };
  std::string result;
  bool found = false;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const std::string gap = i == 0 ? "" : "\n";
    if (one.empty() || sections[i].heading == "## " + one + "\n\n") {
      found = true;
      std::cerr << sections[i].heading;
      result += gap + sections[i].heading + sections[i].text();
      continue;
    }
    const std::size_t from = i == 0 ? 0 : start_of(i);
    if (from == std::string::npos) continue;  // it was never made
    std::size_t next = i + 1;
    while (next < sections.size() && start_of(next) == std::string::npos) ++next;
    result += before.substr(from, start_of(next) - from);
  }
  if (!found) throw std::invalid_argument("there is no section " + one);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    std::cerr << "usage: tactile-net-calibration-tables FILE.md [HEADING]\n";
    return 2;
  }
  try {
    std::string before;
    if (argc == 3) {
      std::ifstream file(argv[1], std::ios::binary);
      before.assign(std::istreambuf_iterator<char>(file), {});
    }
    frames::write_file(argv[1], page(argc == 3 ? argv[2] : "", before));
  } catch (const std::exception& error) {
    std::cerr << "tactile-net-calibration-tables: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
