/// @file
/// Many recordings side by side: what each amounts to, and which to look at first.
///
///     std::vector<lab::RecordingRow> rows = {lab::row_of(overview), lab::row_of(recording)};
///     lab::sort_by_suspicion(rows);
///
/// The order, the most suspicious first: files that have no answer; then recordings that need a
/// look; then those that are fine. Within each, what comes first is, in this order: the larger
/// share of frames that are not to be trusted, more findings about the readings, the larger share
/// of frames whose readings no contact explains, the largest force that is less certain (its
/// deviation over it), the larger of these forces, the name.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/lab/recording.hpp"

namespace tactile_net::lab {

/// Whether somebody should look at a recording.
enum class Standing {
  no_answer,     ///< its file cannot be read or solved, or no frame of it has an answer
  needs_a_look,  ///< more than `share_to_look` of its frames are not to be trusted, or its readings
                 ///< are suspicious
  fine,
};

inline constexpr double share_to_look = 0.1;

struct RecordingRow {
  std::string name{};     ///< of its file
  std::string page{};     ///< its own page, relative to that of all; empty: it has none
  std::string problem{};  ///< why there is no answer, and what to do; empty: there is one
  std::size_t frames = 0;
  std::size_t faultless = 0;  ///< frames with the verdict ok or no_contact
  std::size_t doubted = 0;    ///< frames whose readings no contact explains
  /// The commonest one of the frames that are not faultless; ok: all are.
  Verdict verdict = Verdict::failed;
  Findings findings{};
  /// The taxel that most frames' readings blame, and how many do; absent: none is blamed.
  std::optional<std::size_t> bad_taxel{};
  std::size_t bad_taxel_frames = 0;
  /// The largest normal one of the frames with the verdict ok [N/m], of a skin [N].
  std::optional<Uncertain> force{};
  std::optional<std::size_t> force_frame{};  ///< where that is
  std::optional<double> force_time{};        ///< the same [s]
  /// Share of friction's limit that the largest drag of a frame with the verdict ok leaves of it;
  /// below 0 it slips. Absent: no limit is stated, or nothing drags.
  std::optional<double> slip_margin{};
  std::optional<double> duration{};  ///< from the first frame to the last [s]
  double seconds = 0.0;              ///< that it took to read, solve and draw it

  [[nodiscard]] Standing standing() const noexcept;
  /// Of the frames; 0 where there is none.
  [[nodiscard]] double share_faultless() const noexcept;
  [[nodiscard]] double share_doubted() const noexcept;
};

/// Of a recording that was solved, with its findings; name, page and seconds are the caller's.
[[nodiscard]] RecordingRow row_of(const RecordingOverview& recording);

/// Whether `one` comes before `other`: a strict order, in which rows of different names are never
/// equal.
[[nodiscard]] bool is_more_suspicious(const RecordingRow& one, const RecordingRow& other);
void sort_by_suspicion(std::vector<RecordingRow>& rows);

}  // namespace tactile_net::lab
