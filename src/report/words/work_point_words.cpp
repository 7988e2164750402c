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

// The words of which nothing is a number. Writers and readers below share every table.

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
constexpr std::string_view settling_job = "settling, ";  // and the realisation

constexpr std::array<std::pair<Family, std::string_view>, 15> family_words = {{
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
    {Family::coarse_cells, "one cell a taxel, reflections float64"},
    {Family::integral, "readings by the integral"},
    {Family::discrete_sum, "readings by the discrete sum"},
}};
constexpr std::string_view corrected_fft = "FFT, ends corrected";
constexpr std::string_view capacitance_unit = " pF a node";
// "least_squares of 300 tractions, 10 MHz", "16 x 16 taxels"
constexpr std::string_view of_nodes = " of ";
constexpr std::string_view nodes_unit = " tractions";
constexpr std::string_view by = " x ";
constexpr std::string_view array_unit = " taxels";

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
constexpr std::string_view halved_panels = "31 points, halved to 1e-14";
constexpr std::string_view operating_point = "operating point";
constexpr std::string_view rank = "rank ";
constexpr std::string_view plus = " + ";

/// The word beside `key` in a table of pairs.
std::string word(const auto& table, auto key) {
  for (const auto& [one, text] : table)
    if (one == key) return std::string(text);
  return {};
}

/// The key beside `text`.
auto key_of(const auto& table, std::string_view text)
    -> std::optional<std::decay_t<decltype(table.front().first)>> {
  for (const auto& [key, one] : table)
    if (one == text) return key;
  return std::nullopt;
}

std::optional<std::size_t> count_in(std::string_view text) {
  double number = 0.0;
  if (!read_number(text, number) || !(number >= 0.0 && number < 1e15) ||
      number != std::floor(number))
    return std::nullopt;
  return static_cast<std::size_t>(number);
}

/// "reflections low rank float64"
std::string product_in_words(Structure structure, Precision precision) {
  if (structure == Structure::fft) return std::string(corrected_fft);
  std::string text = std::string(name(structure)) + ' ' + std::string(name(precision));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

/// "nic, 10 MHz", "ideal, 10 pF a node", "rail"
std::string circuit_curve_in_words(const study::WorkCurve& curve) {
  std::string text(name(*curve.realization));
  if (curve.tractions)
    text += std::string(of_nodes) + std::to_string(*curve.tractions) + std::string(nodes_unit);
  if (curve.bandwidth) text += ", " + brief(*curve.bandwidth / 1e6) + " MHz";
  if (curve.node_capacitance)
    text += ", " + brief(*curve.node_capacitance * 1e12) + std::string(capacitance_unit);
  return text;
}

std::string ranks_in_words(const std::vector<std::size_t>& ranks) {
  std::string text(rank);
  for (std::size_t i = 0; i < ranks.size(); ++i)
    text += (i > 0 ? std::string(plus) : "") + std::to_string(ranks[i]);
  return text;
}

std::optional<study::Knob> ranks_named(std::string_view text) {
  study::Knob knob{.kind = Setting::ranks};
  for (text.remove_prefix(rank.size());;) {
    const std::size_t end = text.find(plus);
    const std::optional<std::size_t> one = count_in(text.substr(0, end));
    if (!one) return std::nullopt;
    knob.ranks.push_back(*one);
    if (end == text.npos) return knob;
    text.remove_prefix(end + plus.size());
  }
}

std::string settled_in_words(const study::Knob& knob) {
  std::string text = "settled to " + brief(study::settling_levels[knob.level]);
  if (knob.by_poles) text += ", by its poles";
  if (knob.scaled) text += ", scaled from " + brief(study::compared_bandwidth / 1e6) + " MHz";
  return text;
}

/// Every circuit's curve that is known without a number of the scene.
std::vector<study::WorkCurve> circuits() {
  std::vector<study::WorkCurve> curves;
  for (const Realization realization : realizations) {
    study::WorkCurve curve{.family = Family::circuit, .realization = realization};
    curves.push_back(curve);
    for (const double bandwidth : study::bandwidths) {
      curve.bandwidth = bandwidth;
      curves.push_back(curve);
    }
  }
  return curves;
}

std::optional<study::WorkCurve> capacitive_circuit_named(std::string_view text) {
  const std::size_t comma = text.find(", ");
  if (comma == text.npos || !text.ends_with(capacitance_unit)) return std::nullopt;
  double picofarad = 0.0;
  const std::size_t first = comma + 2;
  const std::optional<Realization> realization = realization_named(text.substr(0, comma));
  if (!realization || text.size() < first + capacitance_unit.size() ||
      !read_number(text.substr(first, text.size() - first - capacitance_unit.size()), picofarad))
    return std::nullopt;
  return study::WorkCurve{
      .family = Family::circuit, .realization = realization, .node_capacitance = 1e-12 * picofarad};
}

/// A circuit whose nodes are counted: as if they were not, and their count.
std::optional<study::WorkCurve> counted_circuit_named(std::string_view text) {
  const std::size_t first = text.find(of_nodes);
  const std::size_t last = text.find(nodes_unit);
  if (first == text.npos || last == text.npos || last < first + of_nodes.size())
    return std::nullopt;
  const auto count = count_in(text.substr(first + of_nodes.size(), last - first - of_nodes.size()));
  const std::string rest =
      std::string(text.substr(0, first)) + std::string(text.substr(last + nodes_unit.size()));
  if (!count) return std::nullopt;
  for (study::WorkCurve& curve : circuits())
    if (circuit_curve_in_words(curve) == rest) {
      curve.tractions = count;
      return curve;
    }
  return std::nullopt;
}

std::optional<study::Knob> array_named(std::string_view text) {
  const std::size_t middle = text.find(by);
  if (middle == text.npos || !text.ends_with(array_unit)) return std::nullopt;
  const std::size_t second = middle + by.size();
  if (text.size() < second + array_unit.size()) return std::nullopt;
  const auto rows = count_in(text.substr(0, middle));
  const auto columns = count_in(text.substr(second, text.size() - second - array_unit.size()));
  if (!rows || !columns) return std::nullopt;
  return study::Knob{.kind = Setting::array, .rows = *rows, .columns = *columns};
}

}  // namespace

std::string in_words(const study::Job& job) {
  if (job.kind == study::Job::Kind::settling)
    return std::string(settling_job) + std::string(name(*job.realization));
  return word(job_words, job.kind);
}

std::optional<study::Job> job_named(std::string_view text) {
  if (text.starts_with(settling_job)) {
    const auto realization = realization_named(text.substr(settling_job.size()));
    if (!realization) return std::nullopt;
    return study::Job{.kind = study::Job::Kind::settling, .realization = realization};
  }
  const auto kind = key_of(job_words, text);
  return kind ? std::optional(study::Job{*kind}) : std::nullopt;
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

std::optional<study::WorkCurve> curve_named(std::string_view text) {
  using enum Structure;
  // What studies of lines once called it.
  constexpr std::string_view older = "parity";
  std::string own(text);
  if (text.starts_with(older)) own.replace(0, older.size(), name(reflections));
  for (const Precision precision : {Precision::float64, Precision::float32})
    for (const Structure structure : {dense, low_rank, reflections, reflections_low_rank, fft})
      if (product_in_words(structure, precision) == own)
        return study::WorkCurve{
            .family = Family::product, .structure = structure, .precision = precision};
  if (const auto family = key_of(family_words, text)) return study::WorkCurve{.family = *family};
  for (const study::WorkCurve& curve : circuits())
    if (circuit_curve_in_words(curve) == text) return curve;
  if (const auto curve = capacitive_circuit_named(text)) return curve;
  if (const auto curve = counted_circuit_named(text)) return curve;
  if (const auto job = job_named(text)) return study::WorkCurve{.family = Family::job, .job = job};
  return std::nullopt;
}

std::string in_words(const study::Knob& knob) {
  switch (knob.kind) {
    case Setting::none:
      return {};
    case Setting::ranks:
      return ranks_in_words(knob.ranks);
    case Setting::halved_panels:
      return std::string(halved_panels);
    case Setting::settled:
      return settled_in_words(knob);
    case Setting::operating_point:
      return std::string(operating_point);
    case Setting::array:
      return std::to_string(knob.rows) + std::string(by) + std::to_string(knob.columns) +
             std::string(array_unit);
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

std::optional<study::Knob> knob_named(std::string_view text) {
  if (text.empty()) return study::Knob{};
  if (text.starts_with(rank)) return ranks_named(text);
  if (text == halved_panels) return study::Knob{.kind = Setting::halved_panels};
  if (text == operating_point) return study::Knob{.kind = Setting::operating_point};
  if (const auto array = array_named(text)) return array;
  for (std::size_t level = 0; level < study::settling_levels.size(); ++level)
    for (const bool by_poles : {false, true})
      for (const bool scaled : {false, true}) {
        const study::Knob knob{
            .kind = Setting::settled, .level = level, .by_poles = by_poles, .scaled = scaled};
        if (settled_in_words(knob) == text) return knob;
      }
  for (const CountWords& one : count_words)
    if (text.ends_with(one.words))
      if (const auto count = count_in(text.substr(0, text.size() - one.words.size())))
        return study::Knob{.kind = one.kind, .count = *count, .optimal = one.optimal};
  return std::nullopt;
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
