#include "tactile_net/lab/recording_row.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace tactile_net::lab {
namespace {

double share_of_frames(std::size_t some, std::size_t all) noexcept {
  return all == 0 ? 0.0 : static_cast<double>(some) / static_cast<double>(all);
}

/// Deviation over size: how little is known of it; infinite where nothing is.
double uncertainty_of(const std::optional<Uncertain>& force) noexcept {
  if (!force || !(std::abs(force->value) > 0.0) || !std::isfinite(force->deviation))
    return std::numeric_limits<double>::infinity();
  return force->deviation / std::abs(force->value);
}

double amount_of(const std::optional<Uncertain>& force) noexcept {
  return force && std::isfinite(force->value) ? std::abs(force->value) : 0.0;
}

/// @param counts  of frames, by their verdict
void add_verdicts(RecordingRow& row, const std::map<Verdict, std::size_t>& counts) {
  row.verdict = Verdict::ok;
  std::size_t most = 0;
  for (const auto& [verdict, count] : counts) {
    if (is_faultless(verdict)) {
      row.faultless += count;
    } else if (count > most) {
      most = count;
      row.verdict = verdict;
    }
  }
}

/// What the times of frames span. @param times  NaN where a frame has none
std::optional<double> span_of(const std::vector<double>& times) {
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (const double time : times) {
    if (!std::isfinite(time)) continue;
    first = std::min(first, time);
    last = std::max(last, time);
  }
  return first <= last ? std::optional(last - first) : std::nullopt;
}

/// @param drag  over the force
void add_margin(RecordingRow& row, const std::optional<double>& limit, double drag) {
  if (!limit || !std::isfinite(drag)) return;
  const double margin = 1.0 - std::abs(drag) / *limit;
  row.slip_margin = std::min(row.slip_margin.value_or(margin), margin);
}

}  // namespace

Standing RecordingRow::standing() const noexcept {
  if (!problem.empty()) return Standing::no_answer;
  const double faults = 1.0 - share_faultless();
  return faults > share_to_look || !findings.empty() ? Standing::needs_a_look : Standing::fine;
}

double RecordingRow::share_faultless() const noexcept { return share_of_frames(faultless, frames); }

double RecordingRow::share_doubted() const noexcept { return share_of_frames(doubted, frames); }

RecordingRow row_of(const RecordingOverview& recording) {
  RecordingRow row{
      .frames = recording.frames, .doubted = recording.doubted, .findings = recording.findings};
  if (recording.groups.empty()) {
    row.problem = recording.frames == 0 ? "the recording holds no frame"
                                        : "every frame of the recording misses readings";
    return row;
  }
  add_verdicts(row, recording.verdicts);
  for (const auto& [taxel, frames] : recording.bad_taxels) {
    if (frames <= row.bad_taxel_frames) continue;
    row.bad_taxel = taxel;
    row.bad_taxel_frames = frames;
  }
  const auto take = [&](const Uncertain& force, std::size_t frame, double time) {
    if (row.force && !(force.value > row.force->value)) return;
    row.force = force;
    row.force_frame = frame;
    row.force_time = std::isfinite(time) ? std::optional(time) : std::nullopt;
  };
  std::vector<double> times;
  if (!recording.is_line()) {
    const std::optional<double>& limit = recording.skin().reconstruct.friction_limit;
    for (std::size_t i = 0; i < recording.rows.size(); ++i) {
      const FrameRow& frame = recording.rows[i];
      times.push_back(frame.time);
      if (frame.missing || frame.verdict != Verdict::ok) continue;
      take(frame.wrench.normal, i, frame.time);
      if (frame.friction) add_margin(row, limit, frame.friction->value);
    }
  } else {
    const std::optional<double>& limit = recording.line().reconstruct.friction_limit;
    for (const FrameGroup& group : recording.groups) {
      times.push_back(group.time);
      if (group.answer.verdict == Verdict::ok && recording.tangential() && recording.loaded(group))
        add_margin(row, limit, group.resultant.tangential / group.resultant.normal);
    }
    if (const FrameGroup& peak = recording.peak(); peak.answer.verdict == Verdict::ok)
      take(peak.answer.bands
               ? peak.answer.bands->resultant.normal
               : Uncertain{peak.resultant.normal, std::numeric_limits<double>::quiet_NaN()},
           peak.shown, peak.time);
  }
  row.duration = span_of(times);
  return row;
}

bool is_more_suspicious(const RecordingRow& one, const RecordingRow& other) {
  const auto key = [](const RecordingRow& row) {
    return std::tuple(row.standing(), row.share_faultless(), -std::ssize(row.findings),
                      -row.share_doubted(), -uncertainty_of(row.force), -amount_of(row.force),
                      std::string_view(row.name));
  };
  return key(one) < key(other);
}

void sort_by_suspicion(std::vector<RecordingRow>& rows) {
  std::stable_sort(rows.begin(), rows.end(), is_more_suspicious);
}

}  // namespace tactile_net::lab
