#include "tactile_net/pages/certificate_page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pages/frames_section.hpp"
#include "pages/pad_drawing.hpp"
#include "pages/parts.hpp"
#include "pages/skin_figures.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/network/board.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/json/network_json.hpp"
#include "tactile_net/report/words/board_words.hpp"
#include "tactile_net/report/words/datasheet_words.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/opamp_words.hpp"
#include "tactile_net/report/words/parts_words.hpp"
#include "tactile_net/report/words/refinement_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::Curve;
using drawing::element;
using drawing::Figure;
using drawing::Figures;
using drawing::html_list;
using drawing::html_table;
using drawing::Page;
using drawing::Plot;
using report::answers;
using report::cells;
using report::circuit_in_words;
using report::in_words;
using report::material_in_words;
using report::sensor_in_words;
using report::tolerance_in_words;

Figure poles_figure(const Dynamics& dynamics) {
  Plot plot{"The circuit's poles", "real part [1/s]", "imaginary part [rad/s]", {}, {}};
  double least = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  Curve dying{"dies away", {}, 1, true};
  Curve growing{"grows", {}, 2, true};
  for (const auto& pole : dynamics.poles) {
    Curve& curve = pole.real() < 0.0 ? dying : growing;
    curve.x.push_back(pole.real());
    curve.y.push_back(pole.imag());
    const double size = std::abs(pole);
    if (size > 0.0) least = std::min(least, size);
    largest = std::max(largest, size);
  }
  for (Curve* curve : {&dying, &growing})
    if (!curve->y.empty()) plot.curves.push_back(std::move(*curve));
  plot.linear_within = largest > 0.0 ? std::max(least, 1e-9 * largest) : 1.0;
  return {"poles", "time",
          "Every pole of the circuit; both axes are logarithmic on either side of 0. One left of 0 "
          "dies away, one right of it grows and is the end of the answer; the rightmost takes the "
          "longest. Those on the horizontal line do not ring; the steeper they stand above and "
          "below it, the longer they ring.",
          std::move(plot)};
}

/// The unit [s] in which a time has one to three digits before its point.
std::pair<std::string, double> unit_of_time(double seconds) {
  for (const auto& [unit, scale] : {std::pair("s", 1.0), {"ms", 1e-3}, {"µs", 1e-6}})
    if (seconds >= scale) return {unit, scale};
  return {"ns", 1e-9};
}

Figure settling_figure(const lab::Certification& c) {
  const Dynamics& dynamics = *c.certificate().dynamics;
  Plot plot;
  plot.title = "From a step of all inputs to the answer";
  plot.y_label = "|v - v end| / |v end|";
  plot.logarithmic_y = true;
  constexpr std::size_t stretches = 400;
  const double horizon = dynamics.settling_seconds ? 1.5 * *dynamics.settling_seconds
                                                   : 5.0 / std::abs(dynamics.slowest);
  // Of ringing that is faster than a stretch of time the crest is found: where it is sampled more
  // rarely than it rings, its phases are as good as random, and some are near the crest.
  const double work = static_cast<double>(stretches) * std::pow(dynamics.states, 2);
  const auto looks = static_cast<std::size_t>(std::clamp(4e8 / work, 2.0, 16.0));
  const double stretch = horizon / static_cast<double>(stretches);
  const std::vector<double> errors = step_errors(
      c.circuit.network().state_space(), stretch / static_cast<double>(looks), looks * stretches);
  Curve crest{"error of all node voltages", {errors.front()}, 1};
  if (dynamics.settling_seconds) crest.label = "largest error still to come";
  for (std::size_t k = 0; k < stretches; ++k) {
    const auto from = errors.begin() + static_cast<std::ptrdiff_t>(k * looks);
    crest.y.push_back(*std::max_element(from, from + static_cast<std::ptrdiff_t>(looks) + 1));
  }
  if (dynamics.settling_seconds)
    for (std::size_t k = stretches; k-- > 0;) crest.y[k] = std::max(crest.y[k], crest.y[k + 1]);
  plot.curves.push_back(std::move(crest));
  const auto [unit, seconds] = unit_of_time(horizon);
  plot.x_label = "time [" + unit + "]";
  for (std::size_t k = 0; k <= stretches; ++k)
    plot.x.push_back(stretch * static_cast<double>(k) / seconds);
  if (dynamics.settling_seconds) {
    Curve settled{"settled: " + brief(c.certificate().accuracy),
                  std::vector<double>(stretches + 1, c.certificate().accuracy)};
    settled.dashed = true;
    plot.curves.push_back(std::move(settled));
  }
  return {"settling", "time",
          dynamics.settling_seconds
              ? "The largest error of the answer that is still to come after the inputs step from "
                "0, by "
                "the exact solution of the circuit's linear equations; it has settled where that "
                "falls below the dashed line. A straight slope is one pole: the slowest that the "
                "inputs excite enough to be seen; steps are ringing."
              : "The distance from the answer that the circuit should come to rest at: it grows, "
                "in the end at the rate of its rightmost pole.",
          std::move(plot)};
}

/// The share of builds that err by at most so much; nothing if every build is unstable.
void add_builds(Plot& plot, const std::string& label, std::size_t colour,
                const ToleranceResult& result) {
  Curve curve{label, {}, colour};
  for (const double error : result.errors) {
    if (!std::isfinite(error)) break;
    curve.x.push_back(error);
    curve.y.push_back(static_cast<double>(curve.x.size()) / static_cast<double>(result.trials));
  }
  curve.marks = curve.x.size() == 1;
  if (!curve.x.empty()) plot.curves.push_back(std::move(curve));
}

Figure builds_figure(const lab::Certification& c) {
  const ToleranceOptions options = c.circuit.tolerance();
  Plot plot{"Builds with real parts: how far they err",
            "error of the answer, relative",
            "share of builds",
            {},
            {},
            true};
  plot.from_zero = true;
  plot.y_end = 1.02;
  const Realization own = c.circuit.options().realization;
  const bool own_ladder = c.certificate().ladder;
  const auto colour = [](Realization realization, bool ladder) {
    return 1 + static_cast<std::size_t>(realization) + (ladder ? realizations.size() : 0);
  };
  for (const auto& one : c.recommendation.candidates)
    if (!c.tolerance || one.realization != own || one.ladder != own_ladder)
      add_builds(plot, circuit_in_words(one.realization, one.ladder),
                 colour(one.realization, one.ladder), one.tolerance);
  if (c.tolerance)
    add_builds(plot, circuit_in_words(own, own_ladder) + " (this)", colour(own, own_ladder),
               *c.tolerance);
  if (plot.curves.empty()) return {};
  Curve accurate{"accurate: " + brief(options.accuracy), {0.0, 1.0}};
  accurate.x = {options.accuracy, options.accuracy};
  accurate.dashed = true;
  plot.curves.push_back(std::move(accurate));
  return {
      "builds", "parts",
      "The share of builds whose answer errs by at most so much, further left is better; a "
      "realisation's yield is where its curve crosses the dashed line. A curve that ends "
      "below 1 is unstable in the rest of its builds, a realisation without a curve in all that "
      "were drawn.",
      std::move(plot)};
}

Figure resistors_figure(const FlatCircuit& circuit) {
  std::vector<double> ohms = resistances(circuit);
  std::sort(ohms.begin(), ohms.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  Plot plot{"The resistors it takes", "resistance [ohm]", "resistors up to this", {}, {}, true};
  plot.from_zero = true;
  for (const bool negative : {false, true}) {
    Curve curve{negative ? "negative, in size" : "positive", {}, negative ? 2U : 1U};
    double count = 0.0;
    for (const double ohm : ohms) {
      if ((ohm < 0.0) != negative) continue;
      const double before = count++;
      if (!curve.x.empty() && curve.x.back() == std::abs(ohm)) {
        curve.y.back() = count;
        continue;
      }
      curve.x.insert(curve.x.end(), 2, std::abs(ohm));  // a step up
      curve.y.insert(curve.y.end(), {before, count});
    }
    if (!curve.x.empty()) plot.curves.push_back(std::move(curve));
  }
  return {"resistors", "parts",
          "How many resistors have at most this value. An upright step is one value, used as often "
          "as the step is high; the wider the curve, the more decades of parts must be bought.",
          std::move(plot)};
}

/// Errors over cycles, what is proven of them, and where arithmetic ends.
Figure refinement_figure(const lab::CircuitRefinement& refinement) {
  const RefinementTrials& trials = refinement.trials;
  Plot plot{"Refined cycle by cycle", "cycle", "|f - f*| / |f*|", {}, {}};
  plot.logarithmic_y = true;
  const std::size_t cycles = trials.cycles.size();
  for (std::size_t k = 1; k <= cycles; ++k) plot.x.push_back(static_cast<double>(k));
  const auto add = [&](const std::string& label, std::size_t colour, bool dashed, auto&& at) {
    Curve curve{label, {}, colour};
    curve.dashed = dashed;
    for (std::size_t k = 0; k < cycles; ++k) curve.y.push_back(at(k));
    if (std::all_of(curve.y.begin(), curve.y.end(),
                    [](double y) { return std::isfinite(y) && y > 0.0; }))
      plot.curves.push_back(std::move(curve));
  };
  add("median build", 1, false, [&](std::size_t k) { return trials.cycles[k].median; });
  add("95 of 100", 2, false, [&](std::size_t k) { return trials.cycles[k].p95; });
  add("worst of " + std::to_string(trials.builds), 3, false,
      [&](std::size_t k) { return trials.cycles[k].worst; });
  add("errors that conspire", 4, false, [&](std::size_t k) { return trials.cycles[k].adverse; });
  if (refinement.verdict != RefinementVerdict::refused) {
    const double rate = refinement.verdict == RefinementVerdict::proven
                            ? refinement.bound.contraction()
                            : refinement.bound.contraction_of_most();
    add("proven", 5, true, [&](std::size_t k) {
      return std::sqrt(refinement.bound.condition) * trials.first_energy *
             std::pow(rate, static_cast<double>(k));
    });
  }
  add("single precision ends", 6, true, [&](std::size_t) { return trials.single_floor; });
  add("double precision ends", 7, true, [&](std::size_t) { return trials.double_floor; });
  if (plot.curves.empty()) return {};
  return {"refinement", "refinement",
          "How far the answer is from the exact one after each cycle; the first is the circuit by "
          "itself. No build is above the dashed line that is proven, which also holds of errors "
          "that conspire; converters cost a factor a cycle, and only the arithmetic of the "
          "residual ends it.",
          std::move(plot)};
}

constexpr std::string_view voltages = "the tractions that the circuit's voltages stand for";

/// The pad with these tractions, none where nothing loads it.
Figure pad_of(const Scene& scene, std::span<const double> tractions) {
  const std::size_t count = std::min(surface(scene).count, tractions.size());
  return pad_figure(scene, {tractions.first(count), tractions.subspan(count)}, voltages, "pad",
                    "certificate.json");
}

Figure pad_of(const SkinScene& scene, std::span<const double> tractions) {
  const SurfaceGrid cells = grid(scene);
  const bool loaded = std::any_of(tractions.begin(), tractions.end(),
                                  [](double traction) { return traction != 0.0; });
  if (!loaded) return {};
  return {.name = "pad",
          .section = "pad",
          .caption = "Seen from outside: " + std::string(voltages) +
                     ", colours the pressure of each cell, arrows its drag, dots the taxels. A "
                     "node is named after its cell: p_3_5 of row 3 and column 5, from 0, qy_3_5 "
                     "and qz_3_5 its drags. The pointer tells what is under it; a click keeps a "
                     "cell for the curves through it.",
          .plot = {},
          .picture = skin_load(scene, cells, tractions, "The circuit's answer"),
          .data = "certificate.json",
          .type = "whole-row"};
}

std::vector<Figure> figures_of(const lab::Certification& c) {
  std::span<const double> tractions;
  if (c.circuit.loaded()) tractions = c.circuit.direct();
  std::vector<Figure> figures = {
      std::visit([&](const auto& scene) { return pad_of(scene, tractions); }, c.scene())};
  if (c.certificate().dynamics) {
    figures.push_back(poles_figure(*c.certificate().dynamics));
    const bool moves = c.certificate().dynamics->settling_seconds.value_or(1.0) > 0.0 &&
                       c.certificate().dynamics->slowest != 0.0;
    if (c.circuit.loaded() && moves) figures.push_back(settling_figure(c));
  }
  figures.push_back(builds_figure(c));
  figures.push_back(resistors_figure(c.circuit.network().flat()));
  if (c.refinement) figures.push_back(refinement_figure(*c.refinement));
  return figures;
}

/// The certificate's lines, and what its scene adds.
std::vector<std::string> known(const lab::Certification& c) {
  std::vector<std::string> lines = in_words(c.certificate());
  for (std::string& line : report::facts_in_words(c)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace

Page certificate_html(const lab::Certification& c, const Made& made) {
  const Figures figures(figures_of(c));
  Page page{.files = figures.data()};
  if (c.parts && c.parts->choice)
    page.files.insert(page.files.end(), {{"parts.csv", report::order_csv(*c.parts)},
                                         {"BOM.csv", report::bill_csv(*c.parts)}});
  if (c.board) page.files.emplace_back("copper.csv", report::copper_csv(*c.board));
  std::vector<std::pair<std::string, std::string>> schematic;
  if (c.writes_board()) {
    schematic = report::schematic_texts(*c.parts);
    page.files.insert(page.files.end(), {{"board.kicad_pcb", report::board_text(*c.parts)},
                                         {"board.kicad_pro", report::project_text()},
                                         {"board.pos.csv", report::positions_csv(*c.parts)},
                                         {"fabricate.py", std::string(fabrication_script())},
                                         schematic.front()});
  }

  if (c.datasheet)
    page.files.push_back({report::datasheet_file(c.circuit.file()),
                          report::datasheet_json(c.scene(), *c.datasheet)});

  std::string html = std::visit(
      [](const auto& scene) {
        return heading(scene.title, scene.file,
                       sensor_in_words(scene) + "; " + material_in_words(scene));
      },
      c.scene());
  html += answer_box(answers(c));
  html += element("p", in_words(c.recommendation));
  for (const CircuitRemark& remark : c.certificate().remarks)
    html += element("p", in_words(remark), "note");
  if (c.curves) html += element("p", in_words(*c.curves), "note");

  const std::string pad = figures.html("pad");
  const std::string facts = element("h2", "What is known of it") + html_list(known(c));
  // A skin's map has curves beside it, and takes the whole row.
  html += std::holds_alternative<SkinScene>(c.scene())
              ? facts + pad
              : "<div class=\"two top\">" + pad + "<div>" + facts + "</div></div>\n";

  html += element("h2", "Over time");
  if (!c.certificate().dynamics)
    html += element("p", takes_time(c.circuit.options().realization, c.circuit.options().parts)
                             ? "It has more than 1500 states: no poles, no settling."
                             : "Nothing here takes a time that is modelled, neither op-amps with a "
                               "bandwidth nor a capacitance: no poles, no settling.");
  html += figures.html("time");

  html += element("h2", "With real parts");
  if (c.tolerance) html += html_list(tolerance_in_words(c));
  if (!c.recommendation.candidates.empty()) html += html_table(cells(c.recommendation));
  if (c.parts)
    html += element("h3", "What to order") + html_table(cells(*c.parts)) +
            element("p", in_words(*c.parts));
  if (c.board) html += element("h3", "On its board") + html_list(in_words(*c.board));
  if (c.datasheet)
    html += element("h3", "Datasheet") + "<div class=\"worded\">" +
            html_table(cells(*c.datasheet)) + "</div>" + html_list(in_words(*c.datasheet));
  html += figures.html("parts");
  if (c.refinement)
    html += element("h2", "Refined in numbers") + html_list(report::in_words(*c.refinement)) +
            html_table(report::cycle_cells(*c.refinement)) + element("h3", "Does it pay?") +
            html_table(report::way_cells(*c.refinement)) + figures.html("refinement");
  html += colophon("The scene, the files, the command",
                   std::visit([](const auto& scene) { return scene_html(scene); }, c.scene()),
                   page.files, made);
  // The sheets are found from the first one.
  for (std::size_t k = 1; k < schematic.size(); ++k) page.files.push_back(std::move(schematic[k]));
  page.html = page_html(c.circuit.file() + " - tactile-net certify", html);
  return page;
}

}  // namespace tactile_net::pages
