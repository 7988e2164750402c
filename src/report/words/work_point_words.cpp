#include "tactile_net/report/words/work_point_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"

namespace tactile_net::report {
namespace {

using Family = study::WorkCurve::Family;
using Setting = study::Knob::Kind;

// The words of which nothing is a number.

constexpr std::array<std::pair<study::Job::Kind, std::string_view>, 14> job_words = {{
    {study::Job::Kind::products, "products with M"},
    {study::Job::Kind::factorisations, "factorisations"},
    {study::Job::Kind::fft, "FFT"},
    {study::Job::Kind::constraints, "constraints"},
    {study::Job::Kind::fewer_taxels, "fewer taxels"},
    {study::Job::Kind::coarser_surface, "coarser surface"},
    {study::Job::Kind::kronecker, "Kronecker products"},
    {study::Job::Kind::gradients, "conjugate gradients"},
    {study::Job::Kind::array_sizes, "array sizes"},
    {study::Job::Kind::forward_model, "forward model"},
    {study::Job::Kind::circuit_sizes, "circuits over array sizes"},
    {study::Job::Kind::parts, "accuracy of parts"},
    {study::Job::Kind::moving, "moving contacts"},
    {study::Job::Kind::operating_points, "ngspice, operating points"},
}};

constexpr std::array<std::pair<Family, std::string_view>, 16> family_words = {{
    {Family::closed_form, "closed form (ch. 4)"},
    {Family::factorisation, "QR of every frame"},
    {Family::ring_filter, "FFT, array as a ring"},
    {Family::division, "dft: division (ch. 3)"},
    {Family::conjugate_gradients, "conjugate gradients, FFT"},
    {Family::active_set, "f_v >= 0, active set"},
    {Family::fewer_taxels, "fewer taxels"},
    {Family::coarser_surface, "coarser surface"},
    {Family::kronecker, "sum of Kronecker products"},
    {Family::singular_values, "singular values, any alpha"},
    {Family::matrix_gradients, "conjugate gradients, matrix"},
    {Family::friction_cone, "constraints, ADMM"},
    {Family::planned_constraints, "constraints, a plan's steps"},
    {Family::coarse_cells, "one cell a taxel, reflections float64"},
    {Family::integral, "readings by the integral"},
    {Family::discrete_sum, "readings by the discrete sum"},
}};

/// A number stands before these.
struct CountWords {
  Setting kind;
  bool optimal;
  std::string_view words;
};
constexpr std::array<CountWords, 8> count_words = {{
    {Setting::steps, false, " steps"},
    {Setting::steps, true, " steps, converged"},
    {Setting::terms, false, " terms"},
    {Setting::exchanges, false, " exchanges"},
    {Setting::exchanges, true, " exchanges, optimal"},
    {Setting::taxels, false, " taxels"},
    {Setting::surface_values, false, " surface values"},
    {Setting::panel_points, false, " points a panel"},
}};

/// The word beside `key` in a table of pairs.
std::string word(const auto& table, auto key) {
  for (const auto& [one, text] : table)
    if (one == key) return std::string(text);
  return {};
}

/// "reflections low rank float64"
std::string product_in_words(Structure structure, Precision precision) {
  if (structure == Structure::fft) return "FFT, ends corrected";
  std::string text = std::string(name(structure)) + ' ' + std::string(name(precision));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

/// "nic, 10 MHz", "ideal, 10 pF a node", "least_squares of 300 tractions, 10 MHz", "rail"
std::string circuit_curve_in_words(const study::WorkCurve& curve) {
  std::string text(name(*curve.realization));
  if (curve.tractions) text += " of " + std::to_string(*curve.tractions) + " tractions";
  if (curve.bandwidth) text += ", " + brief(*curve.bandwidth / 1e6) + " MHz";
  if (curve.node_capacitance) text += ", " + brief(*curve.node_capacitance * 1e12) + " pF a node";
  return text;
}

std::string ranks_in_words(const std::vector<std::size_t>& ranks) {
  std::string text = "rank ";
  for (std::size_t i = 0; i < ranks.size(); ++i)
    text += (i > 0 ? " + " : "") + std::to_string(ranks[i]);
  return text;
}

std::string settled_in_words(const study::Knob& knob) {
  std::string text = "settled to " + brief(study::settling_levels[knob.level]);
  if (knob.by_poles) text += ", by its poles";
  if (knob.scaled) text += ", scaled from " + brief(study::compared_bandwidth / 1e6) + " MHz";
  return text;
}

}  // namespace

std::string in_words(const study::Job& job) {
  if (job.kind == study::Job::Kind::settling)
    return "settling, " + std::string(name(*job.realization));
  return word(job_words, job.kind);
}

std::string in_words(const study::WorkCurve& curve) {
  switch (curve.family) {
    case Family::product:
      return product_in_words(*curve.structure, *curve.precision);
    case Family::circuit:
      return circuit_curve_in_words(curve);
    case Family::job:
      return in_words(*curve.job);
    default:
      return word(family_words, curve.family);
  }
}

std::string in_words(const study::Knob& knob) {
  switch (knob.kind) {
    case Setting::none:
      return {};
    case Setting::ranks:
      return ranks_in_words(knob.ranks);
    case Setting::halved_panels:
      return "31 points, halved to 1e-14";
    case Setting::settled:
      return settled_in_words(knob);
    case Setting::operating_point:
      return "operating point";
    case Setting::array:
      return std::to_string(knob.rows) + " x " + std::to_string(knob.columns) + " taxels";
    case Setting::terms:
    case Setting::steps:
    case Setting::exchanges:
    case Setting::taxels:
    case Setting::surface_values:
    case Setting::panel_points:
      break;
  }
  for (const CountWords& one : count_words)
    if (one.kind == knob.kind && one.optimal == knob.optimal)
      return std::to_string(knob.count) + std::string(one.words);
  return {};
}

std::string in_words(const study::Failure& failure) {
  using Kind = study::Failure::Kind;
  switch (failure.kind) {
    case Kind::refused:
      return failure.what;
    case Kind::disagrees:
      return in_words(*failure.disagreement);
    case Kind::no_frame:
      return "the frame was refused";
    case Kind::dead_taxels:
      return "the scene has dead taxels";
    case Kind::no_stride:
      return "no stride leaves both ends of " + std::to_string(failure.count) + " taxels in place";
    case Kind::not_stable:
      return "no settling: " + std::string(name(failure.stability));
    case Kind::unsettled:
      return "it does not settle";
    case Kind::no_time:
      return "it takes no time";
  }
  return {};
}

std::string in_words(const study::WorkPoint& point) {
  const std::string knob = in_words(point.knob);
  return knob.empty() ? in_words(point.curve) : in_words(point.curve) + ", " + knob;
}

std::string in_words(const study::StudyProgress& progress) {
  if (progress.stopping) return "stopping, after what has begun ...";
  std::string text = percent(progress.share) + ", " + in_words(progress.job);
  if (progress.seconds_left)
    text += ", about " + duration(std::ceil(*progress.seconds_left)) + " left";
  return text;
}

}  // namespace tactile_net::report
