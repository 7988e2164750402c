#include "tactile_net/pages/bench_page.hpp"

#include <algorithm>
#include <cmath>

#include "pages/parts.hpp"
#include "pages/skin_figures.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/report/words/board_bench_words.hpp"

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

Figure errors_figure(const lab::BoardBench& bench) {
  std::vector<double> errors = bench.diagnosis.part_errors;
  std::sort(errors.begin(), errors.end());
  Plot plot{"The parts' errors, as the responses tell them",
            "relative error of a conductance",
            "share of parts",
            {},
            {}};
  plot.from_zero = true;
  plot.y_end = 1.02;
  Curve curve{"parts", {}, 1};
  for (std::size_t k = 0; k < errors.size(); ++k) {
    curve.x.push_back(errors[k]);
    curve.y.push_back(static_cast<double>(k + 1) / static_cast<double>(errors.size()));
  }
  plot.curves.push_back(std::move(curve));
  return {"errors", "parts",
          "The share of parts whose error is at most so much. What the responses leave open is "
          "taken for 0: the curve is narrower than the parts' own.",
          std::move(plot)};
}

}  // namespace

Page bench_html(const AnyScene& scene, const lab::BoardBench& bench, const Made& made) {
  const Figures figures({errors_figure(bench)});
  Page page{.files = figures.data()};
  page.files.push_back({"correction.csv", report::correction_csv(bench)});
  const auto [title, file] =
      std::visit([](const auto& one) { return std::pair(one.title, one.file); }, scene);
  std::string html =
      heading(title, file,
              std::to_string(bench.parts.size()) + " resistors; " + std::to_string(bench.patterns) +
                  " patterns, " + std::to_string(bench.outputs.size()) + " outputs");
  const std::vector<std::string> lines = report::in_words(bench);
  html +=
      element("p", lines.front(), bench.verdict() == lab::BenchVerdict::healthy ? "good" : "bad");
  html += html_list({lines.begin() + 1, lines.end()});
  const auto candidates = report::candidate_cells(bench);
  if (!candidates.empty())
    html += element("h2", "Single faults, the most likely first") + html_table(candidates);
  html += element("h2", "Parts that are furthest off") + html_table(report::part_cells(bench));
  html += figures.html("parts");
  html += colophon("The scene, the files, the command",
                   std::visit([](const auto& one) { return scene_html(one); }, scene), page.files,
                   made);
  page.html = page_html(file + " - tactile-net bench", html);
  return page;
}

}  // namespace tactile_net::pages
