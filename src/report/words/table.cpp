#include "tactile_net/report/words/table.hpp"

#include <algorithm>
#include <iomanip>
#include <ostream>

#include "numeric/named.hpp"
#include "report/words/number_words.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/board_words.hpp"
#include "tactile_net/report/words/contact_words.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/datasheet_words.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/opamp_words.hpp"
#include "tactile_net/report/words/parts_words.hpp"
#include "tactile_net/report/words/refinement_words.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::report {
namespace {

using ConditionMatrix = lab::Condition::Matrix;

constexpr Named<ConditionMatrix> matrices[] = {
    {ConditionMatrix::stacked, "W K above sqrt(alpha) L"},
    {ConditionMatrix::eliminated, "its own system of slopes"},
    {ConditionMatrix::circular, "the array as a ring"},
    {ConditionMatrix::kernel, "noise gain of the array as a ring"},
    {ConditionMatrix::normal, "P"},
};

std::string condition_number_in_words(const lab::Condition& condition) {
  return (condition.kind == lab::Condition::Kind::bound ? "<= " : "") + brief(condition.value);
}

/// Code points of UTF-8: "±" and "µ" are one column wide.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

void print_cells(std::ostream& out, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += row[i] + std::string(widths[i] - width(row[i]) + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    out << line << '\n';
  }
}

std::vector<std::vector<std::string>> comparison_cells(const lab::Experiment& experiment) {
  const bool two =
      std::any_of(experiment.results.begin(), experiment.results.end(),
                  [](const lab::MethodResult& result) { return result.errors.size() > 1; });
  std::vector<std::vector<std::string>> rows = {{"method", "alpha", "mean |error|", "relative L2"}};
  if (two) rows.front().emplace_back("tangential L2");
  for (const char* title : {"force", "condition", "rounding <=", "set-up", "per frame", "verdict"})
    rows.front().emplace_back(title);

  const Scene& scene = experiment.line();
  for (const lab::MethodResult& result : experiment.results) {
    const lab::FrameAnswer& answer = result.answer;
    std::vector<std::string> row = {std::string(name(result.method))};
    if (!result.has_answer()) {
      row.resize(rows.front().size() - 1, "-");
    } else {
      row.push_back(!answer.alpha.known() ? "-"
                    : answer.alpha.rule   ? brief(answer.alpha.value)
                                          : shortest(answer.alpha.value));
      row.push_back(in_unit(scene, Dimension::stress, result.errors.front().mean_abs));
      row.push_back(brief(result.errors.front().relative));
      if (two) row.push_back(result.errors.size() > 1 ? brief(result.errors[1].relative) : "-");
      row.push_back(in_unit(scene, Dimension::force, result.force));
      row.push_back(answer.condition && answer.condition->matrix == ConditionMatrix::stacked
                        ? condition_number_in_words(*answer.condition)
                        : "-");
      row.push_back(brief_or_dash(answer.error_bound));
      row.push_back(duration(result.setup_seconds));
      row.push_back(duration(result.frame_seconds));
    }
    row.emplace_back(name(answer.verdict));
    rows.push_back(std::move(row));
  }
  return rows;
}

Sentences remarks_in_words(const lab::Experiment& experiment, const lab::MethodResult& result) {
  Sentences said = remarks_in_words(result.answer);
  if (result.method == Method::network && experiment.relaxation) {
    const std::vector<std::string> circuit = warnings_of(*experiment.relaxation);
    said.warnings.insert(said.warnings.begin(), circuit.begin(), circuit.end());
  }
  return said;
}

std::string failure_in_words(const lab::Experiment& experiment, const lab::MethodResult& result) {
  if (!result.refusal.empty() || result.method != Method::network || !experiment.relaxation)
    return result.refusal;
  const std::optional<lab::Disagreement> disagreement = experiment.relaxation->disagreement();
  return disagreement ? in_words(*disagreement) : std::string();
}

std::vector<std::vector<std::string>> rule_cells(const AlphaSweep& sweep) {
  std::vector<std::vector<std::string>> rows = {{"rule", "alpha", "verdict"}};
  // Where the noise is stated, nobody needs to be told to state it: such a rule is none for so few
  // readings.
  const bool stated =
      std::any_of(sweep.curves.begin(), sweep.curves.end(),
                  [](const AlphaSweep::Curve& curve) { return needs_noise(curve.rule); });
  for (const AlphaSweep::Curve& curve : sweep.curves)
    rows.push_back({std::string(name(curve.rule)), brief(curve.choice.alpha),
                    stated && curve.choice.verdict == AlphaVerdict::noise_needed
                        ? "not for so few readings"
                        : std::string(name(curve.choice.verdict))});
  return rows;
}

std::string rule_used(const lab::Experiment& experiment) {
  if (const auto alpha = experiment.line().reconstruct.alpha)
    return "the scene gives " + shortest(*alpha);
  const auto rule = experiment.rule();
  return rule ? std::string(name(*rule)) + " was used" : "none was used";
}

std::string other_conditions_in_words(const lab::Experiment& experiment) {
  std::string text;
  for (const lab::MethodResult& result : experiment.results)
    if (const auto& condition = result.answer.condition;
        condition && condition->matrix != ConditionMatrix::stacked)
      text += (text.empty() ? "" : ", ") + std::string(name(result.method)) + " " +
              condition_number_in_words(*condition) + " (" +
              std::string(name_in<matrices>(condition->matrix)) + ")";
  return text;
}

std::string resultant_in_words(const Scene& scene, const UncertainResultant& resultant) {
  const auto number = [&](Dimension dimension, const Uncertain& value) {
    return scene.units || value.interval ? in_unit(scene.units, dimension, value)
                                         : brief(value.value) + " +- " + brief(value.deviation);
  };
  std::string text = "normal force " + number(Dimension::force, resultant.normal);
  if (resultant.tangential)
    text += ", tangential " + number(Dimension::force, *resultant.tangential);
  if (resultant.centre) text += ", centre " + number(Dimension::length, *resultant.centre);
  if (resultant.angle) text += ", angle " + number(Dimension::none, *resultant.angle) + " rad";
  return text;
}

void print_relaxation(std::ostream& out, const lab::Relaxation& relaxation) {
  out << "network: " << name(relaxation.realization) << ", " << relaxation.nodes << " nodes, "
      << elements_in_words(relaxation.elements) << '\n';
  for (const std::string& line : in_words(relaxation)) out << "  " << line << '\n';
}

void print_refinement(std::ostream& out, const lab::SimulatedRefinement& refinement) {
  for (const std::string& line : in_words(refinement)) out << line << '\n';
  if (!refinement.cycles.empty()) print_cells(out, cycle_cells(refinement));
}

void print_certificate(std::ostream& out, const lab::Certification& c) {
  std::string indent;
  for (const std::string& line : in_words(c.certificate())) {
    out << indent << line << '\n';
    indent = "  ";
  }
  for (const std::string& line : facts_in_words(c)) out << "  " << line << '\n';
  if (c.curves) out << "  warning: " << in_words(*c.curves) << '\n';
  if (c.tolerance)
    for (const std::string& line : tolerance_in_words(c)) out << "  " << line << '\n';
  out << '\n';
  if (!c.recommendation.candidates.empty()) print_cells(out, cells(c.recommendation));
  out << in_words(c.recommendation) << '\n';
  if (c.refinement) {
    out << '\n';
    for (const std::string& line : in_words(*c.refinement)) out << line << '\n';
    print_cells(out, cycle_cells(*c.refinement));
    out << '\n';
    print_cells(out, way_cells(*c.refinement));
  }
  if (c.parts) {
    out << '\n';
    print_cells(out, cells(*c.parts));
    out << in_words(*c.parts) << '\n';
  }
  if (c.board) {
    out << '\n';
    for (const std::string& line : in_words(*c.board)) out << line << '\n';
  }
  if (!c.datasheet) return;
  out << '\n';
  print_cells(out, cells(*c.datasheet));
  for (const std::string& line : in_words(*c.datasheet)) out << line << '\n';
}

void print_deck_answer(std::ostream& out, const std::string& file,
                       const decks::DeckAnswer& answer) {
  out << file << ": " << answer.nodes.size()
      << " nodes; ngspice against the header's voltages: " << brief(answer.difference)
      << (answer.difference <= answer.within ? " (agrees)" : " (DIFFERS)") << '\n';
  if (answer.difference <= answer.within) return;
  std::vector<decks::NodeAnswer> worst = answer.nodes;
  const auto off = [](const decks::NodeAnswer& one) { return std::abs(one.found - one.expected); };
  std::stable_sort(worst.begin(), worst.end(),
                   [&](const auto& a, const auto& b) { return off(a) > off(b); });
  worst.resize(std::min<std::size_t>(worst.size(), 5));
  std::vector<std::vector<std::string>> rows = {{"node", "expected", "found"}};
  for (const decks::NodeAnswer& one : worst)
    rows.push_back({one.node, shortest(one.expected), shortest(one.found)});
  print_cells(out, rows);
}

namespace {

/// Sensor, material and contacts, and which frame of a scene over time was solved.
void print_scene(std::ostream& out, const auto& scene) {
  out << scene.file << ": " << (scene.title.empty() ? "" : scene.title + "\n  ")
      << sensor_in_words(scene) << "; " << material_in_words(scene) << '\n';
  if (scene.time)
    out << "  " << time_in_words(scene) << " (" << option(Option::frame) << " takes another)\n";
  for (const std::string& contact : contacts_in_words(scene)) out << "  " << contact << '\n';
}

void print_network(std::ostream& out, const lab::Experiment& experiment) {
  const lab::MethodResult* network = experiment.result(Method::network);
  if (network == nullptr) return;
  out << '\n';
  if (experiment.relaxation) {
    print_relaxation(out, *experiment.relaxation);
    out << "  The circuit is off the true " << errors_in_words(*network) << ".\n";
  }
  if (const std::string failure = failure_in_words(experiment, *network); !failure.empty())
    out << (experiment.relaxation ? "  FAILED: " : "network: FAILED: ") << failure << '\n';
}

/// The answer first; then how it was found, and how far it is to be trusted.
void print_skin(std::ostream& out, const lab::Experiment& experiment) {
  const SkinScene& scene = experiment.skin();
  print_scene(out, scene);
  out << "  " << grid_in_words(scene, experiment.grid) << "\n\n";
  const lab::MethodResult& result = experiment.results.front();
  if (!result.has_answer()) {
    out << "FAILED: " << result.refusal << '\n';
    print_network(out, experiment);
    return;
  }
  const lab::FrameAnswer& answer = result.answer;
  print_cells(out, found_cells(experiment));
  if (const auto rows =
          patch_cells(scene.units, answer.patches, {}, true_contacts(experiment.scene));
      !rows.empty()) {
    out << '\n';
    print_cells(out, rows);
  }
  out << "verdict " << name(answer.verdict) << ", alpha " << brief(answer.alpha.value) << " ("
      << source(answer.alpha) << "), off the true " << errors_in_words(result) << "; data "
      << data_word(*answer.data, scene) << '\n';
  if (answer.cone)
    out << "cells that slide " << answer.cone->slip << ", stick " << answer.cone->stick
        << ", touch nothing " << answer.cone->separation << " (" << answer.cone->iterations
        << " iterations, residual " << brief(answer.cone->residual, 2) << ")\n";
  print_remarks(out, "", {.warnings = in_words(experiment.frame)});
  print_remarks(out, "", remarks_in_words(experiment, result));
  print_network(out, experiment);
}

}  // namespace

void print_experiment(std::ostream& out, const lab::Experiment& experiment) {
  if (experiment.of_skin()) return print_skin(out, experiment);
  const Scene& scene = experiment.line();
  print_scene(out, scene);
  const auto all = effects(scene);
  const auto absent =
      std::count_if(all.begin(), all.end(), [](const auto& e) { return !e.second; });
  if (const std::string places = surface_in_words(scene); !places.empty())
    out << "  " << places << '\n';
  out << "  forward model " << name(scene.forward)
      << "; effects simulated: " << effects_in_words(scene, true)
      << "; not in the scene, at no cost: "
      << (absent == 0 ? "none" : "the other " + std::to_string(absent)) << '\n';
  for (const std::string& warning : in_words(experiment.frame))
    out << "  warning: " << warning << '\n';
  out << '\n';
  print_cells(out, comparison_cells(experiment));
  if (const std::string others = other_conditions_in_words(experiment); !others.empty())
    out << "condition of other matrices: " << others << '\n';
  out << "force of the contacts: " << in_unit(scene, Dimension::force, experiment.frame.force)
      << " exact, " << in_unit(scene, Dimension::force, experiment.sampled_force)
      << " as pitch x sum of " << truth_in_words(scene) << '\n';
  for (const lab::MethodResult& result : experiment.results) {
    if (const auto& bands = result.answer.bands) {
      out << name(result.method) << ": " << resultant_in_words(scene, bands->resultant) << '\n';
      if (const auto rows =
              patch_cells(scene.units, bands->patches, {}, true_contacts(experiment.scene));
          !rows.empty())
        print_cells(out, rows);
    }
    print_remarks(out, std::string(name(result.method)) + ": ",
                  remarks_in_words(experiment, result));
    if (const std::string failure = failure_in_words(experiment, result); !failure.empty())
      out << name(result.method) << ": FAILED: " << failure << '\n';
  }
  if (experiment.sweep) {
    out << "\nalpha, by rule (" << rule_used(experiment) << "):\n";
    print_cells(out, rule_cells(*experiment.sweep));
  }
  if (experiment.relaxation) {
    out << '\n';
    print_relaxation(out, *experiment.relaxation);
  }
}

}  // namespace tactile_net::report
