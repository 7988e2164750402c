#include "docs/figures/thesis/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/simulator/child_process.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::thesis {
namespace {

using drawing::Curve;
using drawing::Plot;

constexpr std::array<std::string_view, 6> colours = {"#000000", "#0072b2", "#d55e00",
                                                     "#009e73", "#cc79a7", "#e69f00"};
/// Answers that may be close: each is thinner than the one it covers, so that all are seen.
constexpr std::array<std::string_view, 6> widths = {"2", "4", "2.5", "1.5", "1.5", "1.5"};

/// A gnuplot string: single-quoted, quotes doubled. A line break would end it, and begin a command.
std::string literal(std::string_view text) {
  std::string out = "'";
  for (const char c : printable(drawing::typeset(text)))
    out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

std::string number(double value) { return std::isfinite(value) ? shortest(value) : "NaN"; }

std::string script(const Plot& plot) {
  constexpr double plot_height = 290.0;  // of the axes' box
  std::size_t longest = 0;
  for (const Curve& curve : plot.curves) longest = std::max(longest, curve.label.size());
  // The key stands under the plot, short labels side by side, and the picture grows with it.
  const std::size_t columns = longest > 22 ? 1 : 2;
  const std::size_t rows = (plot.curves.size() + columns - 1) / columns;
  const auto key = static_cast<double>(27 * rows);
  const double height = key + plot_height + 110.0;
  std::string text =
      "set terminal svg size 500," + number(height) +
      " dynamic noenhanced font 'sans-serif,16' background '#ffffff'"
      "\nset tmargin at screen " +
      number(1.0 - 36.0 / height) + "\nset bmargin at screen " + number((key + 74.0) / height) +
      "\nset key at screen 0.02, " + number((key + 8.0) / height) +
      " left top Left reverse samplen 1.5 spacing 1.1 maxrows " + std::to_string(rows) +
      "\nset title " + literal(plot.title) + "\nset xlabel " + literal(plot.x_label) +
      " offset 0,0.4\nset ylabel " + literal(plot.y_label) + "\nset offsets\n";
  const auto sharing = std::count_if(plot.curves.begin(), plot.curves.end(),
                                     [](const Curve& c) { return c.x.empty() && !c.dots; });
  std::string lines;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const Curve& curve = plot.curves[i];
    const std::vector<double>& x = curve.x.empty() ? plot.x : curve.x;
    const std::string data = "$c" + std::to_string(i);
    text += data + " << EOD\n";
    for (std::size_t k = 0; k < x.size(); ++k)
      text += number(x[k]) + ' ' + number(curve.y[k]) + '\n';
    text += "EOD\n";
    const std::size_t colour = curve.colour % colours.size();
    lines += (lines.empty() ? "" : ", ") + data + " using 1:2" +
             (curve.dots ? std::string(" with points pt 7 ps 0.5")
                         : " with lines lw " + std::string(sharing < 2 ? "2.5" : widths[colour])) +
             " lc rgb '" + std::string(colours[colour]) + "' title " + literal(curve.label);
  }
  return text + "plot " + lines + '\n';
}

}  // namespace

std::vector<std::string> draw(std::span<const Plot> plots) {
  std::string input =
      "set encoding utf8\nset title offset 0,-0.4\nset grid lc rgb '#dddddd'\n"
      "set zeroaxis lc rgb '#999999'\n";
  for (const Plot& plot : plots) input += script(plot);

  const ProcessResult result = run_process({"gnuplot", "-d"}, {.input = input, .confined = true});
  if (result.end == ProcessResult::End::not_found)
    throw std::runtime_error("gnuplot is not installed: apt install gnuplot-nox");
  if (result.end != ProcessResult::End::exited || result.code != 0)
    throw std::runtime_error("gnuplot failed: " + result.errors.substr(0, 300));

  std::vector<std::string> pictures;
  constexpr std::string_view end_mark = "</svg>";
  for (std::size_t at = 0;;) {
    const std::size_t begin = result.output.find("<svg", at);
    const std::size_t end = result.output.find(end_mark, at);
    if (begin == std::string::npos || end == std::string::npos) break;
    std::string picture = result.output.substr(begin, end + end_mark.size() - begin);
    // Browsers would show gnuplot's names of its parts under the pointer.
    for (std::size_t title; (title = picture.find("<title>")) != std::string::npos;)
      picture.erase(title, picture.find("</title>", title) + 8 - title);
    pictures.push_back(std::move(picture));
    at = end + end_mark.size();
  }
  if (pictures.size() != plots.size())
    throw std::runtime_error("gnuplot drew " + std::to_string(pictures.size()) + " of " +
                             std::to_string(plots.size()) + " plots");
  return pictures;
}

}  // namespace tactile_net::thesis
