/// @file
/// A study made by hand: what once was measured, of each curve a point or two.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "tactile_net/study/study.hpp"

namespace tactile_net::study::by_hand {

using Family = WorkCurve::Family;
using Kind = Job::Kind;
using Setting = Knob::Kind;

inline WorkCurve product(Structure structure, Precision precision) {
  return {.family = Family::product, .structure = structure, .precision = precision};
}

inline WorkCurve circuit(Realization realization, std::optional<double> bandwidth = {}) {
  return {.family = Family::circuit, .realization = realization, .bandwidth = bandwidth};
}

inline WorkCurve ideal_circuit(double farad) {
  return {.family = Family::circuit, .realization = Realization::ideal, .node_capacitance = farad};
}

/// To the last section; `seconds` are median, low and high.
inline void add(Study& study, const WorkCurve& curve, const Knob& knob, TimeOf time_of,
                const std::array<double, 3>& seconds, std::optional<double> to_solution,
                std::optional<double> to_truth) {
  WorkPoint point;
  point.curve = curve;
  point.knob = knob;
  point.time_of = time_of;
  point.seconds = seconds[0];
  point.seconds_low = seconds[1];
  point.seconds_high = seconds[2];
  point.error_to_solution = to_solution;
  point.error_to_truth = to_truth;
  study.sections.back().points.push_back(std::move(point));
}

/// A cylinder on 21 taxels, as it was once measured; of each curve a point or two.
inline Study measured() {
  Study study;
  Scene scene;
  scene.file = "pressed.toml";
  scene.sensor = {.count = 21, .pitch = 0.5, .depths = {1.0}, .reads = {Quantity::stress_x}};
  study.input.problem = lab::SceneProblem(scene);
  study.input.alpha = 1e-3;
  study.input.agreement = 1.7033990924008644e-15;
  study.input.solution_error = 0.09099117971275976;
  study.input.noise_rms = 0.0015831552460761403;
  study.input.noise_floor = 0.03178768786614584;
  study.clock = 3693300412.4502926;
  study.processor = "AMD EPYC";
  study.sections.push_back({.job = {Kind::products}});
  add(study, product(Structure::dense, Precision::float64), {}, TimeOf::frame,
      {5.778125e-08, 5.764453125e-08, 5.78984375e-08}, 1.7033990924008643e-14, 0.09099117971275954);
  add(study, product(Structure::reflections, Precision::float64), {}, TimeOf::frame,
      {6.8619140625e-08, 6.859765625e-08, 7.14921875e-08}, 1.7033990924008643e-14,
      0.09099117971275951);
  add(study, product(Structure::reflections_low_rank, Precision::float64),
      {.kind = Setting::ranks, .ranks = {11, 10}}, TimeOf::frame,
      {1.0003515625e-07, 9.912890625e-08, 1.008125e-07}, 1.7033990924008643e-14,
      0.09099117971275911);
  add(study, product(Structure::dense, Precision::float32), {}, TimeOf::frame,
      {6.48828125e-08, 6.48046875e-08, 6.49609375e-08}, 5.813874928759419e-08, 0.09099116192355575);
  add(study, product(Structure::fft, Precision::float64), {.kind = Setting::ranks, .ranks = {1, 1}},
      TimeOf::frame, {2.01703125e-07, 2.011640625e-07, 2.023359375e-07}, 0.02464185221652351,
      0.09450559300692017);
  add(study, product(Structure::fft, Precision::float64),
      {.kind = Setting::ranks, .ranks = {11, 10}}, TimeOf::frame,
      {2.25734375e-07, 2.250234375e-07, 2.268984375e-07}, 1.7033990924008643e-14,
      0.09099117971275951);
  study.sections.push_back({.job = {Kind::factorisations}});
  add(study, {Family::closed_form}, {}, TimeOf::frame,
      {1.0093359375e-07, 1.00890625e-07, 1.010078125e-07}, 1.7033990924008643e-14,
      0.09099117971275943);
  add(study, {Family::factorisation}, {}, TimeOf::frame, {8.5558e-05, 8.5437e-05, 8.5978e-05},
      1.7033990924008643e-14, 0.09099117971275976);
  study.sections.push_back({.job = {Kind::fft}});
  add(study, {Family::ring_filter}, {}, TimeOf::frame, {4.49125e-07, 4.2565625e-07, 4.550625e-07},
      0.01324065723876638, 0.0915789114965547);
  add(study, {Family::division}, {}, TimeOf::frame,
      {2.678984375e-07, 2.6234375e-07, 3.14140625e-07}, {}, 0.014448559283121163);
  add(study, {Family::conjugate_gradients}, {.kind = Setting::steps, .count = 1}, TimeOf::frame,
      {1.2844375e-06, 1.266875e-06, 1.327e-06}, 0.09055827609573175, 0.12906980220190176);
  add(study, {Family::conjugate_gradients}, {.kind = Setting::steps, .count = 8}, TimeOf::frame,
      {1.00805e-05, 9.8095e-06, 1.0566e-05}, 1.7033990924008643e-14, 0.0909911797127613);
  study.sections.push_back({.job = {Kind::constraints}});
  add(study, {Family::active_set}, {.kind = Setting::exchanges, .count = 2}, TimeOf::frame,
      {4.847e-06, 4.747e-06, 4.957e-06}, {}, 1);
  add(study, {Family::active_set}, {.kind = Setting::exchanges, .count = 3, .optimal = true},
      TimeOf::frame, {7.7165e-05, 7.5092e-05, 8.1973e-05}, {}, 0.06781426742826878);
  study.sections.push_back({.job = {Kind::fewer_taxels}});
  add(study, {Family::fewer_taxels}, {.kind = Setting::taxels, .count = 11}, TimeOf::frame,
      {3.75654296875e-08, 3.69599609375e-08, 3.7751953125e-08}, {}, 0.17864203451652008);
  study.sections.push_back({.job = {Kind::forward_model}});
  add(study, {Family::integral}, {.kind = Setting::panel_points, .count = 15}, TimeOf::forward,
      {3.0535e-05, 3.0506e-05, 3.0576e-05}, {}, 3.3748688458978654e-12);
  add(study, {Family::integral}, {.kind = Setting::panel_points, .count = 31}, TimeOf::forward,
      {5.9679e-05, 5.9588e-05, 6.03e-05}, {}, 1.993533033845753e-16);
  add(study, {Family::integral}, {.kind = Setting::halved_panels}, TimeOf::forward,
      {8.9163e-05, 8.8973e-05, 8.9293e-05}, {}, 2.6058022572012957e-16);
  add(study, {Family::discrete_sum}, {}, TimeOf::forward,
      {9.808125e-07, 9.79625e-07, 1.5366875e-06}, {}, 0.05922791636095724);
  study.sections.push_back({.job = {Kind::settling, Realization::least_squares}});
  add(study, circuit(Realization::least_squares, 10e6), {.kind = Setting::settled, .level = 3},
      TimeOf::settling, {1.967733926389021e-06, 1.967733926389021e-06, 1.967733926389021e-06}, 0.01,
      {});
  study.sections.push_back({.job = {Kind::settling, Realization::nic}});
  add(study, circuit(Realization::nic, 10e6), {.kind = Setting::settled, .level = 3},
      TimeOf::settling, {1.1196447234710799e-06, 1.1196447234710799e-06, 1.1196447234710799e-06},
      0.01, {});
  add(study, circuit(Realization::nic, 1e6), {.kind = Setting::settled, .level = 3, .scaled = true},
      TimeOf::settling, {1.1196447234710799e-05, 1.1196447234710799e-05, 1.1196447234710799e-05},
      0.01, {});
  add(study, circuit(Realization::nic, 100e6),
      {.kind = Setting::settled, .level = 3, .scaled = true}, TimeOf::settling,
      {1.1196447234710799e-07, 1.1196447234710799e-07, 1.1196447234710799e-07}, 0.01, {});
  study.sections.push_back({.job = {Kind::settling, Realization::crossbar}});
  add(study, circuit(Realization::crossbar, 10e6), {.kind = Setting::settled, .level = 3},
      TimeOf::settling, {4.4482089959001167e-07, 4.4482089959001167e-07, 4.4482089959001167e-07},
      0.01, {});
  study.sections.push_back({.job = {Kind::settling, Realization::rail}});
  add(study, circuit(Realization::rail, 10e6), {.kind = Setting::settled, .level = 3},
      TimeOf::settling, {1.3521296245832036e-06, 1.3521296245832036e-06, 1.3521296245832036e-06},
      0.01, {});
  study.sections.push_back({.job = {Kind::settling, Realization::ideal}});
  add(study, ideal_circuit(10e-12), {.kind = Setting::settled, .level = 3}, TimeOf::settling,
      {6.326362071232991e-07, 6.326362071232991e-07, 6.326362071232991e-07}, 0.01, {});
  study.sections.push_back({.job = {Kind::parts}});
  study.sections.back().floors = {{Realization::nic, 0.01, 0.02583539322967185},
                                  {Realization::nic, 0.001, 0.002490677249989888},
                                  {Realization::rail, 0.01, 0.11861615111565246},
                                  {Realization::rail, 0.001, 0.011932986374459146},
                                  {Realization::crossbar, 0.01, 0.02813582738906404},
                                  {Realization::crossbar, 0.001, 0.002794135572499342},
                                  {Realization::least_squares, 0.01, 0.006320167423327584},
                                  {Realization::least_squares, 0.001, 0.000631958448873509}};
  study.sections.push_back({.job = {Kind::operating_points}});
  add(study, circuit(Realization::nic), {.kind = Setting::operating_point}, TimeOf::simulator,
      {0.037259756, 0.037259756, 0.037259756}, 3.813814133245498e-15, {});
  return study;
}

/// A curve of each kind that a study may hold.
inline std::vector<WorkCurve> every_curve() {
  std::vector<WorkCurve> curves = {ideal_circuit(12.3456789e-12)};
  for (const Structure structure : {Structure::dense, Structure::low_rank, Structure::reflections,
                                    Structure::reflections_low_rank})
    for (const Precision precision : {Precision::float64, Precision::float32})
      curves.push_back(product(structure, precision));
  curves.push_back(product(Structure::fft, Precision::float64));
  for (int i = static_cast<int>(Family::closed_form); i < static_cast<int>(Family::circuit); ++i)
    curves.push_back({.family = static_cast<Family>(i)});
  for (const Realization realization : realizations) {
    curves.push_back(circuit(realization));
    curves.push_back(circuit(realization, 10e6));
    curves.back().tractions = 300;
    for (const double bandwidth : bandwidths) curves.push_back(circuit(realization, bandwidth));
  }
  return curves;
}

inline std::vector<Knob> every_knob() {
  std::vector<Knob> knobs = {{},
                             {.kind = Setting::ranks, .ranks = {7}},
                             {.kind = Setting::ranks, .ranks = {24, 23}},
                             {.kind = Setting::exchanges, .count = 5, .optimal = true},
                             {.kind = Setting::steps, .count = 5, .optimal = true},
                             {.kind = Setting::array, .rows = 16, .columns = 8},
                             {.kind = Setting::halved_panels},
                             {.kind = Setting::operating_point}};
  for (const Setting kind : {Setting::steps, Setting::exchanges, Setting::taxels,
                             Setting::surface_values, Setting::panel_points, Setting::terms})
    knobs.push_back({.kind = kind, .count = 12});
  for (std::size_t level = 0; level < settling_levels.size(); ++level)
    for (const bool by_poles : {false, true})
      for (const bool scaled : {false, true})
        knobs.push_back(
            {.kind = Setting::settled, .level = level, .by_poles = by_poles, .scaled = scaled});
  return knobs;
}

inline std::vector<Job> every_job() {
  std::vector<Job> jobs;
  for (int i = 0; i <= static_cast<int>(Kind::operating_points); ++i) {
    jobs.push_back({static_cast<Kind>(i)});
    if (jobs.back().kind == Kind::settling) jobs.back().realization = Realization::crossbar;
  }
  return jobs;
}

}  // namespace tactile_net::study::by_hand
