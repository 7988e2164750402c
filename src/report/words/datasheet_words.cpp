#include "tactile_net/report/words/datasheet_words.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/unit_text.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"

namespace tactile_net::report {
namespace {

using FigureKind = lab::DatasheetFigure::Kind;
using FigureVerdict = lab::DatasheetFigure::Verdict;

std::string title_of(FigureKind kind) {
  switch (kind) {
    case FigureKind::error:
      return "error at rest";
    case FigureKind::offset:
      return "offset";
    case FigureKind::settling:
      return "settling time";
    case FigureKind::noise:
      return "noise, rms";
    case FigureKind::supply_current:
      return "supply current";
  }
  return {};
}

std::string value_text(FigureKind kind, double value) {
  if (!std::isfinite(value)) return kind == FigureKind::settling ? "never" : "unbounded";
  if (kind == FigureKind::settling) return duration(value);
  return kind == FigureKind::supply_current ? with_unit(value, "A") : percent(value);
}

std::string verdict_text(const lab::DatasheetFigure& figure) {
  switch (figure.verdict()) {
    case FigureVerdict::no_limit:
      return "-";
    case FigureVerdict::passes:
      return "pass";
    case FigureVerdict::fails:
      return "FAIL";
    case FigureVerdict::open:
      return "not decided by these draws";
  }
  return {};
}

std::string missing_in_words(const lab::MissingFigure& one) {
  using Reason = lab::MissingFigure::Reason;
  const std::string what = title_of(one.kind) + " is not told: ";
  switch (one.reason) {
    case Reason::no_bandwidth:
      return what + "nothing takes a time that is modelled; give the op-amps a bandwidth";
    case Reason::too_many_states:
      return what + "the circuit has more than " + std::to_string(lab::most_datasheet_states) +
             " states, whose draws would take hours";
    case Reason::no_noise:
      return what + "the op-amps state none, or it has no size; give noise_voltage under opamp";
    case Reason::no_part:
      return what + "it is a part's; name one under [network], opamp = \"THS4551\"";
    case Reason::no_offset:
      return what + "the op-amps state none; give offset under opamp";
  }
  return {};
}

std::string temperature_text(const lab::Datasheet& sheet) {
  const auto& temperature = sheet.drawn.common.temperature;
  return temperature ? "300 K and " + brief(temperature->kelvin) + " K either way" : "300 K";
}

}  // namespace

std::string conditions_in_words(const lab::Datasheet& sheet, const lab::DatasheetFigure& figure) {
  switch (figure.kind) {
    case FigureKind::error:
      return std::string("at rest, ") +
             (sheet.drawn.tare ? "less the answer without readings, " : "") +
             "relative to the exact answer" +
             (sheet.loads > 1
                  ? ", rms over the contacts at " + std::to_string(sheet.loads) + " places"
                  : std::string());
    case FigureKind::offset:
      return "without readings, over the answer";
    case FigureKind::settling:
      return "from a step of all readings to within " + percent(sheet.settling_accuracy) +
             " of the end";
    case FigureKind::noise:
      return "of all outputs over the answer, at " + temperature_text(sheet);
    case FigureKind::supply_current:
      return "at rest under the scene's load; of each op-amp itself the data sheet's typical";
  }
  return {};
}

std::vector<std::vector<std::string>> cells(const lab::Datasheet& sheet) {
  std::vector<std::vector<std::string>> rows = {
      {"figure", "min", "typ", "max", "95 of 100 lie between", "limit", "verdict", "conditions"}};
  for (const lab::DatasheetFigure& one : sheet.figures)
    rows.push_back(
        {title_of(one.kind), value_text(one.kind, one.least), value_text(one.kind, one.typical),
         value_text(one.kind, one.p95_most),
         value_text(one.kind, one.p95_least) + " and " + value_text(one.kind, one.p95_most),
         one.limit ? value_text(one.kind, *one.limit) : "-", verdict_text(one),
         conditions_in_words(sheet, one)});
  return rows;
}

std::vector<std::string> in_words(const lab::Datasheet& sheet) {
  std::vector<std::string> lines;
  std::string of =
      circuit_in_words(sheet.realization, sheet.ladder) + ", " + std::to_string(sheet.opamps) +
      " op-amps" + (sheet.opamp_part.empty() ? "" : " " + sheet.opamp_part) +
      (sheet.ordered ? ", of the parts to order" : ", of " + kinds_of_errors(sheet.drawn)) +
      (sheet.on_board ? ", with its board's copper" : "");
  if (sheet.drawn.bandwidth)
    of += "; op-amps' bandwidths within " + percent(*sheet.drawn.bandwidth);
  lines.push_back("datasheet of " + of);
  std::string drawn;
  for (const lab::DatasheetFigure& one : sheet.figures)
    drawn +=
        (drawn.empty() ? "" : ", ") + std::to_string(one.builds) + " for " + title_of(one.kind);
  lines.push_back("builds drawn, with which nothing was chosen: " + drawn +
                  "; typ is their median, max what 95 of 100 of all builds are within, with a "
                  "confidence of 97.5 % (Clopper and Pearson)");
  if (sheet.unstable > 0)
    lines.push_back(std::to_string(sheet.unstable) + " of the builds are UNSTABLE");
  if (sheet.drift_unknown)
    lines.push_back(
        "what the op-amps' offsets drift by with the temperature is not known, and left out: give "
        "offset_drift under opamp");
  for (const lab::MissingFigure& one : sheet.missing) lines.push_back(missing_in_words(one));
  return lines;
}

std::string_view unit_of(FigureKind kind) noexcept {
  switch (kind) {
    case FigureKind::settling:
      return "s";
    case FigureKind::supply_current:
      return "A";
    case FigureKind::error:
    case FigureKind::offset:
    case FigureKind::noise:
      break;
  }
  return "1";
}

std::string datasheet_file(const std::string& scene) {
  return std::filesystem::path(scene).stem().string() + ".datasheet.json";
}

}  // namespace tactile_net::report
