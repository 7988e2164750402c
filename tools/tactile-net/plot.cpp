#include "plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "tactile_net/simulator/child_process.hpp"
#include "text.hpp"

namespace tactile_net::tool {
namespace {

/// Colours that stay apart for colour-blind readers (Okabe and Ito), the truth in black.
constexpr std::array<std::string_view, 6> colours = {"#000000", "#0072b2", "#d55e00",
                                                     "#009e73", "#cc79a7", "#e69f00"};

/// Each curve is thinner than the one it covers, so that equal answers are seen to be equal.
const std::array<std::string, 6> widths = {"1.5", "4.5", "2.5", "1", "1", "1"};

/// A gnuplot string: single-quoted, quotes doubled.
std::string literal(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

std::string number(double value) {
  std::string text;
  if (std::isfinite(value))
    append_number(text, value);
  else
    text = "NaN";
  return text;
}

/// A short logarithmic axis has labels at 1, 2 and 5: its powers of ten would be one or two.
std::string labels_along(const std::vector<double>& x) {  // of a plot whose curves share them
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  if (x.empty() || !(*low > 0.0) || *high > 1e3 * *low) return "\nset xtics auto";
  std::string labels;
  for (int power = static_cast<int>(std::floor(std::log10(*low))); std::pow(10.0, power) <= *high;
       ++power)
    for (const double digit : {1.0, 2.0, 5.0})
      labels += (labels.empty() ? "" : ", ") + brief(digit * std::pow(10.0, power));
  return "\nset format x '%g'\nset xtics (" + labels + ")";
}

std::string axes(const Plot& plot) {
  return (plot.logarithmic_x
              ? "\nset logscale x\nset format x '1e%T'" +
                    (plot.x.empty() ? "\nset autoscale x\nset xtics auto\nset offsets graph 0.03, "
                                      "graph 0.03, graph 0.03, graph 0.03"
                                    : "\nset autoscale xfix\nset offsets" + labels_along(plot.x))
              : "\nunset logscale x\nset format x '%h'\nset autoscale x"
                "\nset xtics auto\nset offsets") +
         (plot.logarithmic_y ? "\nset logscale y\nset format y '1e%T'"
                             : "\nunset logscale y\nset format y '%h'");
}

/// A curve's points as a named block of data.
std::string data_block(const Plot& plot, const Curve& curve, std::size_t index) {
  const std::vector<double>& x = curve.x.empty() ? plot.x : curve.x;
  std::string text = "$c" + std::to_string(index) + " << EOD\n";
  for (std::size_t i = 0; i < x.size(); ++i) {
    text += number(x[i]) + ' ' + number(curve.y[i]);
    if (!curve.half_width.empty())
      text += ' ' + number(curve.y[i] - curve.half_width[i]) + ' ' +
              number(curve.y[i] + curve.half_width[i]);
    text += '\n';
  }
  return text + "EOD\n";
}

std::string style_of(const Curve& curve) {
  const std::size_t index = curve.colour % colours.size();
  if (curve.dots) return " with points pt 7 ps 0.5";
  // Beyond the colours the marks' shapes go on.
  const std::string mark = " pt " + std::to_string(4 + curve.colour % 9) + " ps 0.6";
  return curve.marks ? " with linespoints lw 1.5" + mark
                     : " with lines lw " + (curve.dashed ? "1.5 dt 2" : widths[index]);
}

std::string script(const Plot& plot) {
  // The key stands under the plot, two labels in a row, and the picture grows with it.
  const std::size_t rows = (plot.curves.size() + 1) / 2;
  std::string text = "set terminal svg size 760," + std::to_string(350 + 18 * rows) +
                     " dynamic noenhanced font 'sans-serif,13' background '#ffffff'\nset title " +
                     literal(plot.title) + "\nset xlabel " + literal(plot.x_label) +
                     " offset 0,0.4" + "\nset ylabel " + literal(plot.y_label) + axes(plot) + "\n";
  // Bands first: they lie under every line.
  std::string bands;
  std::string lines;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const Curve& curve = plot.curves[i];
    text += data_block(plot, curve, i);
    const std::string data = "$c" + std::to_string(i);
    const std::string colour =
        " lc rgb '" + std::string(colours[curve.colour % colours.size()]) + "'";
    lines += (lines.empty() ? "" : ", ") + data + " using 1:2" + style_of(curve) + colour +
             " title " + literal(curve.label);
    if (!curve.half_width.empty())
      bands += data + " using 1:3:4 with filledcurves fs transparent solid 0.18 noborder" + colour +
               " notitle, ";
  }
  return text + "plot " + bands + lines + "\n";
}

}  // namespace

std::vector<std::string> draw(std::span<const Plot> plots) {
  std::string input =
      "set encoding utf8\nset grid lc rgb '#dddddd'\nset key below left Left reverse samplen 2\n"
      "set zeroaxis lc rgb '#999999'\n";
  for (const Plot& plot : plots) input += script(plot);

  const ProcessResult result = run_process({"gnuplot", "-d"}, {.folder = {}, .input = input});
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
    pictures.push_back(result.output.substr(begin, end + end_mark.size() - begin));
    at = end + end_mark.size();
  }
  if (pictures.size() != plots.size())
    throw std::runtime_error("gnuplot drew " + std::to_string(pictures.size()) + " of " +
                             std::to_string(plots.size()) + " plots");
  return pictures;
}

}  // namespace tactile_net::tool
