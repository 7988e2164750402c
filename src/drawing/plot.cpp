#include "tactile_net/drawing/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/simulator/child_process.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::drawing {
namespace {

/// Colours that stay apart for colour-blind readers (Okabe and Ito), the truth in black.
constexpr std::array<std::string_view, 6> curve_colours = {"#000000", "#0072b2", "#d55e00",
                                                           "#009e73", "#cc79a7", "#e69f00"};

constexpr std::string_view grey = "#9aa0a6";

/// Answers that may be close: each is thinner than the one it covers, so that all are seen.
const std::array<std::string, 6> widths = {"2", "4", "2.5", "1.5", "1.5", "1.5"};

/// A gnuplot string: single-quoted, quotes doubled. A line break would end it, and begin a command.
std::string literal(std::string_view text) {
  std::string out = "'";
  for (const char c : printable(typeset(text)))
    out += c == '\'' ? std::string("''") : std::string(1, c);
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

/// The least and the greatest of the values that are finite.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// One axis through zero, as asinh(value / plot.linear_within), labelled at powers of ten.
std::string signed_axis(const Plot& plot, char axis, std::vector<double> Curve::*values) {
  Range range{0.0, 0.0};
  for (const Curve& curve : plot.curves)
    for (const double value : curve.*values) range.add(value);
  auto& [low, high] = range;
  const double within = plot.linear_within;
  // Rounding beside poles of another size is no scale of its own.
  if (std::max(-low, high) < within) {
    high = std::pow(10.0, std::ceil(std::log10(within)));
    low = -high;
  }
  const double largest = std::max({-low, high, within});
  const int first = static_cast<int>(std::ceil(std::log10(within)));
  const int last = static_cast<int>(std::floor(std::log10(largest)));
  const int sides = low < 0.0 && high > 0.0 ? 2 : 1;
  const int step = (last - first + 1) * sides / 6 + 1;
  const bool few = last - first < 2;  // then 3 and 30 are labelled too
  std::string labels = "'0' 0";
  for (int power = last; power >= first - 1; power -= step)
    for (const int digit : {3, 1})
      for (const double end : {low, high}) {
        const double tick = digit * std::pow(10.0, power);
        if ((digit == 3 && !few) || tick < within || tick > 1.5 * std::abs(end)) continue;
        labels += std::string(", '") + (end < 0.0 ? "-" : "") + std::to_string(digit) + "e" +
                  std::to_string(power) + "' " + number(std::copysign(tick, end));
      }
  const std::string scale = number(within);
  const std::string name(1, axis);
  const std::string from = number(low < 0.0 ? 2.0 * low : -within);
  const std::string to = number(high > 0.0 ? 2.0 * high : within);
  // The other axis' zero line, which gnuplot 5.4 misplaces on a nonlinear axis.
  const std::string zero = axis == 'x' ? "set arrow 1 from " + from + ",0 to " + to + ",0"
                                       : "set arrow 2 from 0," + from + " to 0," + to;
  return "\nset nonlinear " + name + " via asinh(" + name + "/" + scale + ") inverse " + scale +
         "*sinh(" + name + ")\nset " + name + "tics (" + labels + ")\nset " + name + "range [" +
         from + ":" + to + "]\nunset " + name + "zeroaxis\n" + zero +
         " nohead lc rgb '#999999' dt 3";
}

/// Labels at powers of ten, at most nine of them, and small marks between where they are few.
/// gnuplot's own begin anywhere if they are told their distance.
std::string decades(char axis, const Range& range) {
  const std::string name(1, axis);
  if (!(range.low > 0.0) || !std::isfinite(range.high)) return "\nset " + name + "tics auto";
  const int first = static_cast<int>(std::floor(std::log10(range.low))) - 1;
  const int last = static_cast<int>(std::ceil(std::log10(range.high))) + 1;
  const int step = (last - first - 2) / 8 + 1;
  std::string labels;
  for (int power = first - first % step; power <= last; ++power) {
    const std::string exponent = "1e" + std::to_string(power);
    const bool labelled = power % step == 0;
    labels += (labels.empty() ? "'" : ", '") + (labelled ? exponent : "") + "' " + exponent +
              (labelled ? "" : " 1");
    if (last - first > 6) continue;
    for (int digit = 2; digit < 10; ++digit)
      labels += ", '' " + std::to_string(digit) + "e" + std::to_string(power) + " 1";
  }
  return "\nset " + name + "tics (" + labels + ")";
}

/// The least and the greatest of a logarithmic axis, with room for what lies on them.
Range with_room(Range range) {
  const double room = std::max(1.3, std::pow(range.high / range.low, 0.05));
  return {range.low / room, range.high * room};
}

Range positive(const Plot& plot, std::vector<double> Curve::*values) {
  Range range;
  for (const Curve& curve : plot.curves)
    for (const double value : curve.*values)
      if (value > 0.0) range.add(value);
  return range;
}

/// The y axis; bands are cut off where they would hide the lines.
std::string y_range(const Plot& plot) {
  if (plot.logarithmic_y) {
    const Range range = with_room(positive(plot, &Curve::y));
    if (range.low > 0.0 && std::isfinite(range.high))
      return "\nset yrange [" + number(range.low) + ":" + number(range.high) + "]";
  }
  if (plot.y_end > 0.0) return "\nset yrange [0:" + number(plot.y_end) + "]";
  if (plot.from_zero) return "\nset yrange [0:*]";
  if (plot.y_at_least > 0.0)
    return "\nset yrange [*<-" + number(plot.y_at_least) + ":" + number(plot.y_at_least) + "<*]";
  Range lines;
  Range bands;
  for (const Curve& curve : plot.curves)
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      lines.add(curve.y[i]);
      if (curve.half_width.empty()) continue;
      bands.add(curve.y[i] - curve.half_width[i]);
      bands.add(curve.y[i] + curve.half_width[i]);
    }
  const double span = lines.high - lines.low;
  if (!(span > 0.0) || (bands.high < lines.high + span && bands.low > lines.low - span))
    return "\nset yrange [*:*]";
  return "\nset yrange [" + number(std::max(bands.low, lines.low - 0.5 * span)) + ":" +
         number(std::min(bands.high, lines.high + 0.5 * span)) + "]";
}

std::string axes(const Plot& plot) {
  if (plot.linear_within > 0.0)
    return signed_axis(plot, 'x', &Curve::x) + signed_axis(plot, 'y', &Curve::y);
  Range x;
  Range y;
  for (const Curve& curve : plot.curves) {
    for (const double value : curve.x.empty() ? plot.x : curve.x) x.add(value);
    for (const double value : curve.y) y.add(value);
  }
  std::string text = "\nunset logscale x\nset format x '%h'\nset autoscale x\nset xtics auto";
  if (plot.logarithmic_x)
    text = "\nset logscale x\nset format x '1e%T'" +
           (plot.x.empty() ? "\nset autoscale x" + decades('x', x)
                           : "\nset autoscale xfix" + labels_along(plot.x));
  text += "\nset offsets";
  if (plot.logarithmic_x && plot.x.empty())
    text +=
        " graph 0.03, graph 0.03, graph 0.03, graph " + std::string(plot.from_zero ? "0" : "0.03");
  return text +
         (plot.logarithmic_y ? "\nset logscale y\nset format y '1e%T'" + decades('y', y)
                             : "\nunset logscale y\nset format y '%h'\nset ytics auto") +
         y_range(plot);
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

std::string style_of(const Curve& curve, bool alone) {
  const std::size_t index = curve.colour % curve_colours.size();
  if (curve.dots) return " with points pt 7 ps " + std::string(curve.quiet ? "0.4" : "0.5");
  if (curve.quiet) return " with linespoints lw 1 pt 7 ps 0.4";
  // Beyond the colours the marks' shapes go on.
  const std::string mark = " pt " + std::to_string(4 + curve.colour % 9) + " ps 0.6";
  if (curve.marks) return " with linespoints lw 1.5" + mark;
  if (curve.width > 0.0) return " with lines lw " + number(curve.width);
  return " with lines lw " + (curve.dashed ? "1.5 dt 2" : alone ? "2.5" : widths[index]);
}

std::string colour_of(const Curve& curve) {
  return " lc rgb '" +
         std::string(curve.quiet ? grey : curve_colours[curve.colour % curve_colours.size()]) + "'";
}

constexpr double font = 16.0;          // on a telephone 500 units are 380 pixels: 12 pixels high
constexpr double plot_height = 290.0;  // of the axes' box

/// Words above points, each at the end of a hairline; from the lowest point upwards, each a line
/// above the one before.
std::string names_of(const Plot& plot) {
  struct Name {
    double x, y;
    const std::string* words;
  };
  std::vector<Name> names;
  for (const Curve& curve : plot.curves)
    for (std::size_t i = 0; i < curve.names.size(); ++i)
      if (!curve.names[i].empty()) names.push_back({curve.x[i], curve.y[i], &curve.names[i]});
  std::stable_sort(names.begin(), names.end(),
                   [](const Name& a, const Name& b) { return a.y < b.y; });
  const Range x = positive(plot, &Curve::x);
  const Range y = with_room(positive(plot, &Curve::y));
  const auto along = [](const Range& range, double value) {
    return std::log(value / range.low) / std::log(range.high / range.low);
  };
  double free = 0.0;
  std::string text;
  for (const Name& name : names) {
    const double line = 1.3 * font / plot_height;
    const double at = std::max(along(y, name.y) + line, free);
    free = at + line;
    // Right of the hairline, or as far right as the words still end inside; letters are half as
    // wide as high.
    const double width =
        0.52 * font * static_cast<double>(name.words->size()) / (plot.wide ? 950.0 : 380.0);
    const double left = std::max(0.0, std::min((along(x, name.x) + 0.03) / 1.06, 1.0 - width));
    const std::string place = "first " + number(name.x) + ", ";
    text += "set label " + literal(*name.words) + " at graph " + number(left) + ", graph " +
            number(at) + " left offset 0.4,0\nset label '' at " + place + "first " +
            number(name.y) + " point pt 7 ps 0.7\nset arrow from " + place + "first " +
            number(name.y) + " to " + place + "graph " + number(at) + " nohead lw 0.7 lc rgb '" +
            std::string(grey) + "'\n";
  }
  return text;
}

std::string script(const Plot& plot) {
  // The key stands under the plot, short labels side by side, and the picture grows with it.
  std::size_t longest = std::max(plot.band_label.size(), plot.quiet_label.size());
  std::size_t entries = (plot.band_label.empty() ? 0U : 1U) + (plot.quiet_label.empty() ? 0U : 1U);
  for (const Curve& curve : plot.curves) {
    if (curve.quiet) continue;
    longest = std::max(longest, curve.label.size());
    ++entries;
  }
  const std::string names = names_of(plot);
  const std::size_t columns = (longest > 22 ? 1U : 2U) * (plot.wide ? 2U : 1U);
  const std::size_t rows = (entries + columns - 1) / columns;
  const auto key = static_cast<double>(27 * rows);
  const double height = key + plot_height + 110.0;
  std::string text =
      "set terminal svg size " + std::string(plot.wide ? "1080," : "500,") + number(height) +
      " dynamic noenhanced font 'sans-serif," + number(font) + "' background '#ffffff'" +
      "\nset tmargin at screen " + number(1.0 - 36.0 / height) + "\nset bmargin at screen " +
      number((key + 74.0) / height) + "\nset key at screen 0.02, " + number((key + 8.0) / height) +
      " left top Left reverse samplen 1.5 spacing 1.1 maxrows " + std::to_string(rows) +
      "\nset title " + literal(plot.title) + "\nset xlabel " + literal(plot.x_label) +
      " offset 0,0.4" + "\nset ylabel " + literal(plot.y_label) + axes(plot) + "\n" + names;
  const auto sharing = std::count_if(plot.curves.begin(), plot.curves.end(), [](const Curve& c) {
    return c.x.empty() && !c.dots && !c.dashed;
  });
  // Bands first: they lie under every line.
  std::string bands;
  std::string lines;
  std::string band_title = literal(plot.band_label);
  std::string quiet_title = literal(plot.quiet_label);
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const Curve& curve = plot.curves[i];
    text += data_block(plot, curve, i);
    const std::string data = "$c" + std::to_string(i);
    const std::string title = curve.quiet ? std::exchange(quiet_title, "''") : literal(curve.label);
    lines += (lines.empty() ? "" : ", ") + data + " using 1:2" + style_of(curve, sharing < 2) +
             colour_of(curve) + " title " + title;
    if (!curve.half_width.empty())
      bands += data + " using 1:3:4 with filledcurves fs transparent solid 0.18 noborder" +
               colour_of(curve) + " title " + std::exchange(band_title, "''") + ", ";
  }
  return text + "plot " + bands + lines + (names.empty() ? "\n" : "\nunset label\nunset arrow\n") +
         (plot.linear_within > 0.0
              ? "unset nonlinear x\nunset nonlinear y\nunset arrow\nset zeroaxis lc rgb "
                "'#999999'\nset xrange [*:*]\nset yrange [*:*]\n"
                "set ytics auto\n"
              : "");
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

}  // namespace tactile_net::drawing
