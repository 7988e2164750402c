#include "pages/tradeoff_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pages/frames_section.hpp"
#include "pages/pad_drawing.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"
#include "tactile_net/report/words/work_point_words.hpp"
#include "tactile_net/study/work_precision.hpp"

namespace tactile_net::pages {
namespace {

using drawing::Curve;
using drawing::element;
using drawing::Figure;
using drawing::Plot;
using report::in_words;

constexpr double least_error = 1e-16;  // zero has no place on a logarithmic axis

double drawn(double error) { return std::max(error, least_error); }

/// The curve, at whatever bandwidth: what has one colour.
study::WorkCurve method_of(const study::WorkPoint& point) {
  if (point.curve.family != study::WorkCurve::Family::circuit) return point.curve;
  return {.family = point.curve.family, .realization = point.curve.realization};
}

/// A colour and a mark of its own for each method and each circuit: the same in every plot, and
/// never black, which is what they are measured against.
std::size_t colour_of(const std::vector<study::WorkPoint>& points, const study::WorkPoint& point) {
  std::vector<study::WorkCurve> methods;
  for (const study::WorkPoint& one : points)
    if (one.time_of == point.time_of &&
        std::find(methods.begin(), methods.end(), method_of(one)) == methods.end())
      methods.push_back(method_of(one));
  const auto at = static_cast<std::size_t>(
      std::find(methods.begin(), methods.end(), method_of(point)) - methods.begin());
  return at + at / 5 + 1;  // the colours are six, the first is black
}

/// The plot's curve of that label; a new one takes the point's colour.
Curve& curve_of(std::vector<Curve>& curves, const std::string& label,
                const std::vector<study::WorkPoint>& points, const study::WorkPoint& point) {
  for (Curve& curve : curves)
    if (curve.label == label) return curve;
  Curve& next = curves.emplace_back();
  next.label = label;
  next.marks = true;
  next.colour = colour_of(points, point);
  return next;
}

/// Every measured curve of one kind of time, over one kind of error. @param quiet  grey
std::vector<Curve> curves_of(const std::vector<study::WorkPoint>& points, study::ErrorOf error,
                             study::TimeOf time_of, bool quiet = false) {
  std::vector<Curve> curves;
  for (const study::WorkPoint& point : points) {
    if (!point.measured() || point.time_of != time_of || !(point.*error)) continue;
    Curve& curve = curve_of(curves, in_words(point.curve), points, point);
    curve.x.push_back(drawn(*(point.*error)));
    curve.y.push_back(point.seconds);
    curve.quiet = quiet;
  }
  return curves;
}

/// The points that nothing beats, as steps, each with its name.
Curve front_curve(const std::vector<study::WorkPoint>& points, study::ErrorOf error,
                  study::TimeOf time_of) {
  Curve curve;
  curve.label = "nothing beats these";
  curve.colour = 1;
  curve.width = 3.0;
  const auto add = [&](double x, double y, std::string words) {
    curve.x.push_back(x);
    curve.y.push_back(y);
    curve.names.push_back(std::move(words));
  };
  for (const std::size_t i : study::pareto_front(points, error, time_of)) {
    const study::WorkPoint& point = points[i];
    // A corner: as slow as this one, as inaccurate as the one before.
    if (!curve.x.empty()) add(curve.x.back(), point.seconds, "");
    add(drawn(*(point.*error)), point.seconds, in_words(point) + ", " + duration(point.seconds));
  }
  return curve;
}

/// A line across the plot at one error.
Curve border(const std::string& label, double error, const std::vector<Curve>& curves,
             std::size_t colour) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const Curve& curve : curves)
    for (const double seconds : curve.y) {
      low = std::min(low, seconds);
      high = std::max(high, seconds);
    }
  Curve line;
  line.label = label;
  line.colour = colour;
  line.dashed = true;
  line.x = {error, error};
  line.y = {low, high};
  return line;
}

Plot plot_of(std::string title, std::string x_label, std::string y_label,
             std::vector<Curve> curves) {
  Plot plot;
  plot.title = std::move(title);
  plot.x_label = std::move(x_label);
  plot.y_label = std::move(y_label);
  plot.curves = std::move(curves);
  plot.logarithmic_x = true;
  plot.logarithmic_y = true;
  return plot;
}

Curve constant_time_curve(const std::string& label, double from, double to, double seconds,
                          bool dashed) {
  Curve line;
  line.label = label;
  line.x = {from, to};
  line.y = {seconds, seconds};
  line.dashed = dashed;
  return line;
}

std::vector<Curve> circuit_curves(const study::Study& study,
                                  const std::vector<study::WorkPoint>& points) {
  std::vector<study::WorkPoint> shown;
  for (const study::WorkPoint& point : points)
    if (point.time_of == study::TimeOf::settling && point.measured() &&
        point.curve.bandwidth.value_or(study::compared_bandwidth) == study::compared_bandwidth)
      shown.push_back(point);
  std::vector<Curve> curves = curves_of(shown, study::to_solution, study::TimeOf::settling);
  if (curves.empty()) return curves;
  for (const study::StudySection& section : study.sections)
    for (const study::PartsFloor& floor : section.floors) {
      if (floor.relative != study::one_percent || !(floor.median.value_or(1.0) < 1.0)) continue;
      const auto circuit = std::find_if(shown.begin(), shown.end(), [&](const auto& point) {
        return point.curve.realization == floor.realization;
      });
      if (circuit != shown.end())
        curves.push_back(border(std::string(name(floor.realization)) + ", 1 % parts", *floor.median,
                                curves, colour_of(shown, *circuit)));
    }
  if (const auto frame = study::fastest_frame(points))
    curves.push_back(
        constant_time_curve("arithmetic here, " + duration(*frame), 1e-4, 1.0, *frame, false));
  return curves;
}

std::vector<Curve> crossover_curves(const study::Study& study,
                                    const std::vector<study::WorkPoint>& points) {
  std::vector<Curve> curves;
  for (const study::WorkPoint& point : points) {
    if (!point.settled_to_one_percent() || !point.curve.bandwidth) continue;
    const double bandwidth = *point.curve.bandwidth;
    Curve& curve = curve_of(curves, std::string(name(*point.curve.realization)), points, point);
    const auto at = std::lower_bound(curve.x.begin(), curve.x.end(), bandwidth);
    curve.y.insert(curve.y.begin() + (at - curve.x.begin()), point.seconds);
    curve.x.insert(at, bandwidth);
  }
  const auto frame = study::fastest_frame(points);
  if (curves.empty() || !frame) return curves;
  curves.push_back(constant_time_curve("this machine", 1e6, 100e6, *frame, false));
  if (study.clock > 0.0)
    for (const double clock : {400e6, 100e6}) {
      Curve line = constant_time_curve("a controller of " + brief(clock / 1e6) + " MHz", 1e6, 100e6,
                                       *frame * study.clock / clock, true);
      line.colour = clock > 200e6 ? 5 : 0;
      curves.push_back(std::move(line));
    }
  return curves;
}

/// How far from the truth each method ends, as bars: those of one problem are one bar, and each
/// surface is a problem of its own.
Figure truth_figure(const study::Study& study, const std::vector<study::WorkPoint>& points) {
  struct Bar {
    std::string label;
    double error;
  };
  const double exact = study.input.solution_error;
  std::vector<Bar> bars;
  std::size_t same = 0;
  std::vector<Curve> curves = curves_of(points, study::to_truth, study::TimeOf::frame);
  const study::WorkCurve constrained{.family = study::WorkCurve::Family::friction_cone};
  const study::WorkCurve planned{.family = study::WorkCurve::Family::planned_constraints};
  const study::WorkCurve surfaces{.family = study::WorkCurve::Family::coarser_surface};
  for (const study::WorkPoint& point : points)
    if (point.curve == surfaces && point.measured() && point.error_to_truth)
      bars.push_back({in_words(point) + ", " + duration(point.seconds), *point.error_to_truth});
  for (const Curve& curve : curves) {
    if (curve.label == in_words(surfaces)) continue;
    const double least = *std::min_element(curve.x.begin(), curve.x.end());
    if (curve.label == in_words(constrained) || curve.label == in_words(planned))
      bars.push_back({curve.label + ", " + duration(curve.y.back()), curve.x.back()});
    else if (std::abs(least - exact) < 0.01 * exact)
      ++same;
    else
      bars.push_back({curve.label, least});
  }
  if (same > 0) bars.push_back({std::to_string(same) + " that solve the same problem", exact});
  std::stable_sort(bars.begin(), bars.end(),
                   [](const Bar& a, const Bar& b) { return a.error < b.error; });
  const double full = std::clamp(bars.empty() ? 1.0 : bars.back().error, 1e-16, 1.0);
  std::string html = "<div class=\"bars valued\">\n";
  for (const Bar& bar : bars) {
    const double width = 1000.0 * std::min(1.0, bar.error / full);
    html += element("span", bar.label) + element("span", percent(bar.error), "value");
    html +=
        "<svg viewBox=\"0 0 1000 100\" preserveAspectRatio=\"none\" role=\"img\" aria-label=\"" +
        drawing::escaped(bar.label + ": " + percent(bar.error)) +
        "\"><rect class=\"room\" width=\"1000\" height=\"100\"/><rect class=\"" +
        (&bar == &bars.front() ? "least" : "dim") + "\" width=\"" + fixed(width, 1) +
        "\" height=\"100\"/></svg>\n";
  }
  curves.push_back(border("the exact solution", exact, curves, 0));
  return {
      .name = "error-to-truth",
      .section = "",
      .caption =
          "What a user gets: the distance from the true tractions, of each method's best. "
          "Methods of one problem end alike, however exact they are: regularisation, "
          "sampling and noise set it. Fewer taxels, a coarser surface and constraints are other "
          "problems.",
      .plot = plot_of("Time over error against the truth", "|f - truth| / |truth|",
                      "time of a frame [s]", std::move(curves)),
      .picture = html + "</div>\n",
      .type = "whole-row"};
}

/// A frame's time over the number of taxels, beside a circuit's and a loop's millisecond.
std::vector<Curve> size_curves(const std::vector<study::WorkPoint>& points) {
  std::vector<Curve> curves;
  for (const study::WorkPoint& point : points) {
    if (!point.measured() || point.knob.kind != study::Knob::Kind::array) continue;
    const auto label = [&] {
      if (point.curve.family == study::WorkCurve::Family::circuit)
        return "circuit, to 1 %, one cell a taxel";
      if (point.curve.family == study::WorkCurve::Family::coarse_cells)
        return "classes, one cell a taxel";
      if (point.curve.structure == Structure::dense) return "dense matrix";
      return point.curve.precision == Precision::float32 ? "classes, single precision"
                                                         : "classes, exact";
    };
    Curve& curve = curve_of(curves, label(), points, point);
    if (curve.x.empty()) curve.colour = curves.size() + (curves.size() > 5 ? 1 : 0);
    curve.x.push_back(static_cast<double>(point.knob.rows * point.knob.columns));
    curve.y.push_back(point.seconds);
    curve.width = point.curve.family == study::WorkCurve::Family::circuit ? 3.0 : 0.0;
  }
  if (curves.empty()) return curves;
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const Curve& curve : curves) {
    low = std::min(low, curve.x.front());
    high = std::max(high, curve.x.back());
  }
  curves.push_back(constant_time_curve("a loop of 1 kHz", low, high, 1e-3, true));
  return curves;
}

bool has_sizes_of_circuits(const std::vector<study::WorkPoint>& points) {
  return std::any_of(points.begin(), points.end(), [](const study::WorkPoint& point) {
    return point.measured() && point.time_of == study::TimeOf::settling &&
           point.knob.kind == study::Knob::Kind::array;
  });
}

/// Of one follower at every speed.
Curve error_curve(const study::MovingContacts& moving, const study::Follower& follower,
                  const std::vector<double>& speeds) {
  constexpr double least_shown = 1e-6;
  Curve curve;
  curve.label = in_words(follower);
  for (const double speed : speeds) {
    const double error = study::error_behind(moving, follower, speed);
    if (!(error > least_shown)) continue;
    curve.x.push_back(speed);
    curve.y.push_back(error);
  }
  if (!follower.realization) curve.width = 3.0;
  return curve;
}

/// Every follower, and what parts of 1 % leave of circuits at any speed.
std::vector<Curve> moving_curves(const study::Study& study, const study::MovingContacts& moving) {
  std::vector<Curve> curves;
  const std::vector<double> speeds = study::shown_speeds(moving);
  if (speeds.empty()) return curves;
  for (const study::Follower& one : moving.followers) {
    curves.push_back(error_curve(moving, one, speeds));
    curves.back().colour = curves.size();
  }
  for (const study::StudySection& section : study.sections)
    for (const study::PartsFloor& floor : section.floors) {
      const auto own = std::find_if(
          moving.followers.begin(), moving.followers.end(),
          [&](const study::Follower& one) { return one.realization == floor.realization; });
      if (floor.relative != study::one_percent || !(floor.median.value_or(1.0) < 1.0) ||
          own == moving.followers.end())
        continue;
      Curve line;
      line.label = in_words(*own) + ", 1 % parts";
      line.x = {speeds.front(), speeds.back()};
      line.y = {*floor.median, *floor.median};
      line.colour = 1 + static_cast<std::size_t>(own - moving.followers.begin());
      line.dashed = true;
      curves.push_back(std::move(line));
    }
  return curves;
}

/// How circuits and loops follow contacts that move; without a curve where nothing does.
Figure moving_figure(const study::Study& study) {
  Plot plot;
  plot.title = "Contacts that move: error over speed";
  plot.x_label = study.input.units() ? "speed [m/s]" : "speed [units of the pitch a second]";
  plot.y_label = "error of the answer, relative";
  plot.logarithmic_x = true;
  plot.logarithmic_y = true;
  plot.wide = true;
  for (const study::StudySection& section : study.sections)
    if (section.moving) plot.curves = moving_curves(study, *section.moving);
  return {.name = "moving",
          .section = "moving",
          .caption =
              "Behind contacts that move: how far the answer is from the exact one to where they "
              "are. Heavy: loops. Dashed: what parts of 1 % leave of a circuit at any speed "
              "(median). Right of where a loop's line crosses a dashed one the circuit is nearer. "
              "Beyond some tens of per cent the answer is one to another place.",
          .plot = std::move(plot)};
}

/// What the contacts do: of a line the pad in section, of a skin the map of its cells.
Figure contact_figure(const study::StudyInput& input) {
  const auto component = [&](std::size_t u) {
    return u < input.truth.size() ? std::span<const double>(input.truth[u])
                                  : std::span<const double>();
  };
  if (!input.is_skin())
    return pad_figure(input.line().scene(), {component(0), component(1)}, "what the contacts do",
                      "forward", "tradeoff.json");
  const lab::SkinSceneProblem& skin = input.skin();
  std::vector<double> truth;
  for (const std::vector<double>& one : input.truth)
    truth.insert(truth.end(), one.begin(), one.end());
  return {.name = "pad",
          .section = "forward",
          .caption =
              "Seen from outside: what the contacts do, colours the pressure, mean of each "
              "cell, arrows the drag, dots the taxels. The pointer tells what is under it; "
              "a click keeps a cell for the curves through it.",
          .plot = {},
          .picture = skin_load(skin.scene(), skin.grid(), truth, "What presses"),
          .data = "tradeoff.json",
          .type = "whole-row"};
}

}  // namespace

std::vector<Figure> tradeoff_figures(const study::Study& study) {
  const study::StudyInput& input = study.input;
  const std::vector<study::WorkPoint> points = study.points();
  const std::string noise = input.noise_stated ? "the scene's noise" : "noise of 1 %";
  std::vector<Figure> figures;
  const auto add = [&](std::string file, std::string caption, Plot plot, std::string section = "") {
    figures.push_back({std::move(file), std::move(section), std::move(caption), std::move(plot)});
  };

  std::vector<Curve> frames = curves_of(points, study::to_solution, study::TimeOf::frame, true);
  if (!frames.empty()) {
    frames.push_back(border(noise, input.noise_floor, frames, 0));
    frames.push_back(front_curve(points, study::to_solution, study::TimeOf::frame));
  }
  Plot plot = plot_of("Time over error against the exact solution", "|f - f*| / |f*|",
                      "time of a frame [s]", std::move(frames));
  plot.wide = true;
  plot.quiet_label = "all others, each in the file";
  add("error-to-solution",
      "What an algorithm adds: its distance from the exact solution of the same regularised "
      "problem, and what a frame costs on this machine. Left and down is better; the heavy line "
      "joins what nothing beats. An error left of the dashed line is smaller than what " +
          std::string(input.noise_stated ? "the scene's noise"
                                         : "noise of 1 % of the largest reading") +
          " does.",
      std::move(plot));
  if (std::isfinite(input.solution_error)) figures.push_back(truth_figure(study, points));

  add("circuits",
      "From a step of all inputs until the voltages stay within an error of the exact solution, by "
      "ngspice's waveform, of large ones by their poles, for op-amps of 10 MHz. The heavy line is "
      "the fastest arithmetic on this "
      "machine: a circuit is faster where it lies below. Dashed: with parts of 1 % a circuit comes "
      "no closer (median).",
      plot_of("Circuits: settling time over error", "|f - f*| / |f*|", "time to settle [s]",
              circuit_curves(study, points)),
      "circuits");
  add("crossover",
      "When is the circuit's answer immediate? Time to settle to 1 % over the op-amps' bandwidth, "
      "beside a frame's arithmetic on this machine, and on controllers of 400 and 100 MHz that "
      "need as many cycles. Right of a crossing the circuit is faster. Parts are exact here; what "
      "others leave is in the table below.",
      plot_of("Circuit against controller, to 1 %", "gain-bandwidth of the op-amps [Hz]",
              "time [s]", crossover_curves(study, points)),
      "circuits");

  figures.push_back(moving_figure(study));

  Plot sizes = plot_of("A frame's time over the size of the array", "taxels", "time [s]",
                       size_curves(points));
  sizes.wide = true;
  add("array-sizes",
      std::string("The same taxels on smaller and larger arrays: what a frame's product takes on "
                  "this machine, of the whole matrix, of the classes that the reflections make of "
                  "it, which are as exact, and with one cell a taxel, which is coarser. ") +
          (has_sizes_of_circuits(points)
               ? "The heavy line is a circuit of two arrays with op-amps of 10 MHz, until it has "
                 "settled to 1 %: where it lies lowest it is faster. "
               : "") +
          "Below the dashed line a loop of 1 kHz keeps up.",
      std::move(sizes), "sizes");

  figures.push_back(contact_figure(input));
  add("forward",
      "The way there: readings of the scene's contacts by the integral, with panels of more and "
      "more points, and by the thesis' discrete sum, against the integral itself.",
      plot_of("Forward model: error of the readings", "|g - g exact| / |g exact|", "time [s]",
              curves_of(points, study::to_truth, study::TimeOf::forward)),
      "forward");
  return figures;
}

}  // namespace tactile_net::pages
