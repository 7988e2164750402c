#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"
#include "tactile_net/report/words/work_point_words.hpp"

namespace tactile_net::report {
namespace {

using Size = std::pair<std::size_t, std::size_t>;  // rows, columns

constexpr double loop_seconds = 1e-3;
constexpr std::array<std::size_t, 2> reported_sides = {16, 32};  // along the longer side

/// What was timed of one array.
struct SizeTimes {
  std::optional<double> dense{};
  std::optional<double> exact{};
  std::optional<double> single{};
  std::optional<double> coarse{};
  std::optional<double> circuit{};

  /// The fastest arithmetic.
  [[nodiscard]] std::optional<double> digital() const {
    std::optional<double> least;
    for (const auto& one : {dense, exact, single, coarse})
      if (one && (!least || *one < *least)) least = one;
    return least;
  }
};

std::optional<double>& place_of(SizeTimes& times, const study::WorkCurve& curve) {
  if (curve.family == study::WorkCurve::Family::circuit) return times.circuit;
  if (curve.family == study::WorkCurve::Family::coarse_cells) return times.coarse;
  if (curve.structure == Structure::dense) return times.dense;
  return curve.precision == Precision::float32 ? times.single : times.exact;
}

bool fewer_taxels(const Size& a, const Size& b) { return a.first * a.second < b.first * b.second; }

std::vector<std::pair<Size, SizeTimes>> times_of(const study::Study& study) {
  std::map<Size, SizeTimes> sizes;
  for (const study::WorkPoint& point : study.points())
    if (point.measured() && point.knob.kind == study::Knob::Kind::array)
      place_of(sizes[{point.knob.rows, point.knob.columns}], point.curve) = point.seconds;
  std::vector<std::pair<Size, SizeTimes>> all(sizes.begin(), sizes.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return fewer_taxels(a.first, b.first); });
  return all;
}

std::string size_in_words(const Size& size) {
  return std::to_string(size.first) + " x " + std::to_string(size.second);
}

/// "takes 310 us exactly, 120 us in single precision and 90 us with one cell a taxel"
std::string takes(const SizeTimes& times) {
  std::vector<std::string> parts;
  if (times.exact) parts.push_back(duration(*times.exact) + " exactly");
  if (times.single) parts.push_back(duration(*times.single) + " in single precision");
  if (times.coarse) parts.push_back(duration(*times.coarse) + " with one cell a taxel");
  std::string text = "takes ";
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

std::string loop_verdict(const SizeTimes& times) {
  if (times.exact && *times.exact <= loop_seconds) return "in time";
  if (times.single && *times.single <= loop_seconds) return "in time in single precision";
  if (times.coarse && *times.coarse <= loop_seconds) return "in time only with one cell a taxel";
  return "not in time";
}

/// From where on the circuit is the faster one.
std::optional<std::string> crossover(const std::vector<std::pair<Size, SizeTimes>>& sizes) {
  const std::pair<Size, SizeTimes>* first = nullptr;  // from which on the circuit is faster
  const std::pair<Size, SizeTimes>* last = nullptr;   // of which both are known
  for (const auto& one : sizes) {
    if (!one.second.circuit || !one.second.digital()) continue;
    last = &one;
    if (*one.second.circuit >= *one.second.digital())
      first = nullptr;
    else if (first == nullptr)
      first = &one;
  }
  if (last == nullptr) return std::nullopt;
  const auto both = [](const std::pair<Size, SizeTimes>& one) {
    return duration(*one.second.circuit) + " beside " + duration(*one.second.digital());
  };
  const std::string circuit =
      "a circuit of two arrays with op-amps of 10 MHz settles to 1 % sooner than this machine "
      "has computed the fastest frame ";
  if (first != nullptr)
    return circuit + "from " + size_in_words(first->first) + " taxels on (" + both(*first) + ")";
  for (const auto& one : sizes)
    if (fewer_taxels(last->first, one.first) && one.second.digital() &&
        *one.second.digital() > *last->second.circuit)
      return circuit + "on none up to " + size_in_words(last->first) + " (" + both(*last) +
             "); if it settles no slower there, from " + size_in_words(one.first) + " on (" +
             duration(*one.second.digital()) + ")";
  return circuit + "on none up to " + size_in_words(sizes.back().first) + " taxels";
}

}  // namespace

std::vector<std::vector<std::string>> size_cells(const study::Study& study) {
  std::vector<std::vector<std::string>> rows = {{"taxels", "dense", "classes, exact",
                                                 "classes, single", "one cell a taxel",
                                                 "circuit settles"}};
  const auto cell = [](const std::optional<double>& seconds) {
    return seconds ? duration(*seconds) : std::string("-");
  };
  for (const auto& [size, times] : times_of(study))
    rows.push_back({size_in_words(size), cell(times.dense), cell(times.exact), cell(times.single),
                    cell(times.coarse), cell(times.circuit)});
  return rows;
}

std::vector<std::string> sizes_in_words(const study::Study& study) {
  const auto sizes = times_of(study);
  std::vector<std::string> text;
  std::string loop;
  for (const auto& [size, times] : sizes)
    for (const std::size_t side : reported_sides)
      if (std::max(size.first, size.second) == side && times.digital())
        loop += (loop.empty() ? "in a loop of 1 kHz a frame of " : "; one of ") +
                size_in_words(size) + " such taxels " + takes(times) + ": " + loop_verdict(times);
  if (!loop.empty()) text.push_back(std::move(loop));
  if (auto sentence = crossover(sizes)) text.push_back(std::move(*sentence));
  return text;
}

}  // namespace tactile_net::report
