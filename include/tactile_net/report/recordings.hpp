/// @file
/// Many recordings side by side: as JSON, as CSV, and as a table for people.
///
///     lab::sort_by_suspicion(rows);
///     puts(report::recordings_csv(rows, scene).c_str());
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/lab/recording_row.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/scene/any_scene.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::report {

using RecordingRows = std::span<const lab::RecordingRow>;

/// The document kind `report`, the rows in their order.
/// @param scene  that all were solved with
[[nodiscard]] std::string recordings_json(RecordingRows rows, const AnyScene& scene);

/// The pages that such a document links to, each relative to it; none of another text.
[[nodiscard]] std::vector<std::string> linked_pages(std::string_view json);

/// The same rows: a header, then one for each.
[[nodiscard]] std::string recordings_csv(RecordingRows rows, const AnyScene& scene);

/// What is wrong with a file and what to do, for a row's `problem`.
[[nodiscard]] std::string problem_in_words(const Diagnostic& first);

/// How many are fine, how many need a look, how many have no answer.
[[nodiscard]] std::vector<Answer> answers(RecordingRows rows);

/// The rule by which rows are sorted, and what needs a look: two sentences.
[[nodiscard]] std::string order_in_words();

/// What that means, a sentence.
[[nodiscard]] std::string_view standing_meaning(lab::Standing standing) noexcept;

/// What a row says first: the problem, else the first finding, else the taxel that most frames
/// blame or the commonest verdict, and of how many frames; empty: the recording is fine.
[[nodiscard]] std::string worst_in_words(const lab::RecordingRow& row, const AnyScene& scene);

/// Header and rows as cells: name, standing, frames, findings, force, slip margin, duration, and
/// what is worst.
[[nodiscard]] std::vector<std::vector<std::string>> recording_cells(RecordingRows rows,
                                                                    const AnyScene& scene);

/// A list for each row with what its cells are sorted by, as JSON: numbers, texts or null.
[[nodiscard]] std::string recording_keys_json(RecordingRows rows, const AnyScene& scene);

/// For a terminal: `answers`, then the cells.
void print_recordings(std::ostream& out, RecordingRows rows, const AnyScene& scene);

}  // namespace tactile_net::report
