#include <algorithm>
#include <cmath>
#include <ostream>

#include "report/columns.hpp"
#include "report/load_dimension.hpp"
#include "report/recording_fields.hpp"
#include "report/words/number_words.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/report/words/check_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/verdict_words.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::report {
namespace {

std::optional<std::string> if_any(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

const std::optional<Units>& units_of(const AnyScene& scene) {
  return std::visit([](const auto& one) -> const std::optional<Units>& { return one.units; },
                    scene);
}

std::string seconds_in_words(const std::optional<double>& seconds) {
  return seconds ? brief(*seconds) + " s" : "-";
}

/// "fine", "needs a look", "no answer".
std::string standing_in_words(lab::Standing standing) {
  std::string words(enumerator_name(standing));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::size_t count_of(RecordingRows rows, lab::Standing standing) {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(),
                    [&](const lab::RecordingRow& row) { return row.standing() == standing; }));
}

}  // namespace

std::vector<RecordingTold> recordings_told(RecordingRows rows, const AnyScene& scene) {
  std::vector<RecordingTold> all;
  for (const lab::RecordingRow& row : rows) {
    RecordingTold& told = all.emplace_back(RecordingTold{.recording = row.name,
                                                         .standing = row.standing(),
                                                         .problem = if_any(row.problem),
                                                         .frames = row.frames,
                                                         .share_faultless = row.share_faultless(),
                                                         .share_doubted = row.share_doubted(),
                                                         .findings = row.findings.size(),
                                                         .force_frame = row.force_frame,
                                                         .force_time = row.force_time,
                                                         .slip_margin = row.slip_margin,
                                                         .duration = row.duration,
                                                         .seconds = row.seconds,
                                                         .page = if_any(row.page)});
    if (row.problem.empty()) told.verdict = lab::name(row.verdict);
    if (!row.findings.empty()) {
      told.finding = lab::name(row.findings.front());
      told.finding_text = in_words(row.findings.front(), scene);
    }
    if (row.bad_taxel) told.bad_taxel = taxel_name(scene, *row.bad_taxel);
    told.bad_taxel_frames = row.bad_taxel_frames;
    if (!row.force) continue;
    told.force = row.force->value;
    if (std::isfinite(row.force->deviation)) told.force_deviation = row.force->deviation;
  }
  return all;
}

std::string recordings_csv(RecordingRows rows, const AnyScene& scene) {
  return csv_of(recordings_told(rows, scene), std::holds_alternative<SkinScene>(scene));
}

std::string problem_in_words(const Diagnostic& first) {
  std::string text = first.line > 0 ? "line " + std::to_string(first.line) + ": " : "";
  text += first.message;
  return first.hint.empty() ? text : text + "; " + first.hint;
}

std::vector<Answer> answers(RecordingRows rows) {
  const std::string all = std::to_string(rows.size());
  const auto said = [&](lab::Standing standing, const std::string& meaning, bool is_bad) {
    const std::size_t count = count_of(rows, standing);
    return Answer{std::to_string(count) + " of " + all, meaning, is_bad && count > 0};
  };
  return {said(lab::Standing::fine, "recordings are fine", false),
          said(lab::Standing::needs_a_look,
               "need a look: many of their frames are not to be trusted, or their readings are "
               "suspicious",
               true),
          said(lab::Standing::no_answer, "could not be read or solved", true)};
}

std::string order_in_words() {
  return "The most suspicious recording stands first: one without an answer; then one that needs a "
         "look, which is one with more than a tenth of its frames not to be trusted, or with "
         "suspicious readings. Among these the larger share of such frames comes first, then more "
         "suspicions, then more frames that no contact explains, then the largest force that is "
         "less certain.";
}

std::string_view standing_meaning(lab::Standing standing) noexcept {
  return row_in<standings_told>(standing).text;
}

std::string worst_in_words(const lab::RecordingRow& row, const AnyScene& scene) {
  if (!row.problem.empty()) return row.problem;
  if (!row.findings.empty()) return in_words(row.findings.front(), scene);
  if (row.standing() == lab::Standing::fine) return {};
  const std::size_t faults = row.frames - row.faultless;
  const auto of_frames = [&](std::size_t some) {
    return " in " + std::to_string(some) + " of " + counted(row.frames, "frame");
  };
  if (row.bad_taxel && 2 * row.bad_taxel_frames >= faults)
    return "taxel " + taxel_name(scene, *row.bad_taxel) + " contradicts all others" +
           of_frames(row.bad_taxel_frames);
  return std::string(in_words(row.verdict)) + of_frames(faults);
}

std::vector<std::vector<std::string>> recording_cells(RecordingRows rows, const AnyScene& scene) {
  std::vector<std::vector<std::string>> cells = {
      {"recording", "standing", "frames to trust", "suspicions", "largest force to trust",
       "time of it", "least slip margin", "duration", "what is wrong"}};
  const std::optional<Units>& units = units_of(scene);
  for (const lab::RecordingRow& row : rows) {
    if (!row.problem.empty()) {
      cells.push_back({printable(row.name), standing_in_words(row.standing()), "-", "-", "-", "-",
                       "-", "-", row.problem});
      continue;
    }
    std::string at = "-";
    if (row.force_time)
      at = seconds_in_words(row.force_time);
    else if (row.force_frame)
      at = "frame " + std::to_string(*row.force_frame);
    const std::string wrong = worst_in_words(row, scene);
    cells.push_back({printable(row.name), standing_in_words(row.standing()),
                     std::to_string(row.faultless) + " of " + std::to_string(row.frames),
                     std::to_string(row.findings.size()),
                     row.force ? in_unit(units, load_dimension(scene), *row.force) : "-", at,
                     row.slip_margin ? percent(*row.slip_margin) : "-",
                     seconds_in_words(row.duration), wrong.empty() ? "-" : wrong});
  }
  return cells;
}

void print_recordings(std::ostream& out, RecordingRows rows, const AnyScene& scene) {
  for (const Answer& answer : answers(rows)) out << answer.value << ' ' << answer.meaning << '\n';
  out << '\n';
  print_cells(out, recording_cells(rows, scene));
}

}  // namespace tactile_net::report
