/// @file
/// Private. What every page is made of: the answer first, verdicts with a sign, and at the end what
/// a reader rarely needs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/finding.hpp"
#include "tactile_net/pages/made.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::pages {

/// The title, or else the file's name, and below it what the page is about in a line.
[[nodiscard]] std::string heading(const std::string& title, const std::string& file,
                                  const std::string& words);

/// The boxes that a page begins with.
[[nodiscard]] std::string answer_box(const std::vector<report::Answer>& answers);

/// A verdict's word, "ok", "rules_disagree" or "slips": with a sign and a colour, and what it means
/// as its tooltip.
[[nodiscard]] std::string verdict_mark(const std::string& word);
/// Any word like that. @param type  "good", "doubtful" or "failed"
[[nodiscard]] std::string mark_of(const std::string& word, std::string_view type,
                                  std::string_view sign, std::string_view meaning);

/// A table whose column "verdict" stands second and is marked; below it what each verdict means
/// that is not good.
[[nodiscard]] std::string verdict_table(std::vector<std::vector<std::string>> rows);

/// Paragraphs, each in its class.
[[nodiscard]] std::string paragraphs(const std::vector<std::string>& texts, std::string_view type);

/// Warnings in their boxes, notes without, each behind what stands before.
[[nodiscard]] std::string remarks_html(const report::Sentences& said,
                                       const std::string& before = {});

/// What is suspicious about readings; a click says what to do about it.
[[nodiscard]] std::string suspicions(const lab::Findings& findings, const AnyScene& scene);

/// A scene in words: sensor, material, contacts, effects.
[[nodiscard]] std::string scene_html(const Scene& scene);

/// Folded, at the end: `body`, the command, and links to every file beside the page.
[[nodiscard]] std::string colophon(std::string_view summary, const std::string& body,
                                   const drawing::Files& own, const Made& made);

/// The whole page in the one style of all; one that holds data (drawing::data_html) has the scripts
/// that draw them. @param title  of the window
[[nodiscard]] std::string page_html(const std::string& title, const std::string& body);

}  // namespace tactile_net::pages
