#include "tactile_net/pages/tradeoff_page.hpp"

#include "pages/parts.hpp"
#include "pages/skin_figures.hpp"
#include "pages/tradeoff_figures.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"
#include "tactile_net/report/words/work_point_words.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::Figures;
using drawing::html_list;
using drawing::html_table;
using drawing::Page;
using report::answers;
using report::circuit_cells;
using report::in_words;
using report::material_in_words;
using report::sensor_in_words;
using report::time_in_words;

std::vector<std::vector<std::string>> simulator_cells(const study::Study& study) {
  std::vector<std::vector<std::string>> rows = {{"realisation", "ngspice", "difference"}};
  for (const study::WorkPoint& point : study.points())
    if (point.time_of == study::TimeOf::simulator && point.measured())
      rows.push_back(
          {in_words(point.curve), duration(point.seconds), brief(*point.error_to_solution)});
  return rows;
}

/// Which frame of a scene with [time] it is.
std::string moment(const Scene& scene) { return time_in_words(scene); }
std::string moment(const SkinScene& scene) { return "frame " + std::to_string(scene.frame); }

}  // namespace

Page study_html(const study::Study& study, const Made& made) {
  const Figures figures(tradeoff_figures(study));
  Page page{.files = figures.data()};

  std::string html = element("h1", "What accuracy costs in time");
  html += element("p", study.input.with_scene([&](const auto& scene) {
    return (scene.title.empty() ? "" : scene.title + ". ") + scene.file + ": " +
           sensor_in_words(scene) + "; " + material_in_words(scene) + "; alpha " +
           brief(study.input.alpha) + "." +
           (scene.time ? " Studied is " + moment(scene) + "." : "");
  }),
                  "quiet");
  html += answer_box(answers(study));
  if (!study.complete)
    html += element("p",
                    "The study was stopped: this is a part of it. Run it again with " +
                        option(Option::resume) + " to go on.",
                    "note");
  html += figures.html("");
  html += element("h2", "What nothing beats") + html_table(report::front_cells(study));
  html += html_list(in_words(study));
  if (const auto sizes = report::size_cells(study); sizes.size() > 1)
    html += element("h2", "Larger and smaller arrays") + figures.html("sizes") + html_table(sizes);
  const auto circuits = circuit_cells(study);
  if (circuits.size() > 1) {
    html += element("h2", "When a circuit is faster");
    html += element("p",
                    "Circuits of op-amps of 10 MHz. A controller that needs as many cycles as this "
                    "machine is slower than the circuit below the clock named; this machine is, if "
                    "the op-amps have the bandwidth named. The last column is the error that parts "
                    "of 1 % leave, median: waiting longer does not lessen it.");
    html += html_table(circuits) + figures.html("circuits");
  }
  if (const auto moving = report::moving_cells(study); moving.size() > 1) {
    html += element("h2", "Contacts that move");
    html += element(
        "p",
        "How far the answer is behind contacts that move steadily along y: circuits of op-amps of "
        "10 MHz, and loops that sample the readings, compute the exact answer at once and hold it "
        "until the next one. The last columns: from which speed on the circuit, built of parts of "
        "1 %, is nearer to the exact answer than that loop.");
    html += html_table(moving) + figures.html("moving");
  }
  const auto simulated = simulator_cells(study);
  if (simulated.size() > 1) {
    html += element("h2", "What ngspice takes");
    html += element("p",
                    "Wall time of ngspice for the operating point: the simulator's time, not the "
                    "circuit's, and how far its answer is from the exact solution.");
    html += html_table(simulated);
  }
  if (const std::string forward = figures.html("forward"); !forward.empty())
    html += element("h2", "The pad, and the way to its readings") + forward;
  const std::vector<std::string> failures = report::failures_in_words(study);
  if (!failures.empty()) html += element("h2", "What did not work") + html_list(failures);
  const std::string measured =
      element("p", "Measured on " + (study.processor.empty() ? "this machine" : study.processor) +
                       (study.clock > 0.0 ? " at " + brief(study.clock / 1e9) + " GHz" : "") +
                       ", pinned to one core, after a warm-up; medians of at least five batches, "
                       "with quartiles in the data. The exact solution is that of a QR; one by "
                       "singular values agrees to " +
                       brief(study.input.agreement) + ".");
  Made beside = made;
  beside.files.insert(beside.files.end(), {"tradeoff.csv", "tradeoff.json"});
  html += colophon(
      "How it was measured, the scene, the files",
      measured + study.input.with_scene([](const auto& scene) { return scene_html(scene); }),
      page.files, beside);
  page.html = page_html(study.input.file() + " - tactile-net tradeoff", html);
  return page;
}

}  // namespace tactile_net::pages
