#include "pages/parts.hpp"

#include <algorithm>
#include <array>

#include "pages/web_files.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/report/words/check_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/verdict_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::enclosed;
using drawing::escaped;
using drawing::words_html;

struct Judgement {
  std::string_view word;
  std::string_view type;
  std::string_view sign;
  std::string_view meaning;
};

/// Of a finger's contact; lab::Verdict has its own sentences.
constexpr std::array<Judgement, 5> of_fingers = {{
    {"holds", "good", "✓", "its force stays inside the cone of friction"},
    {"pushes", "good", "✓", "it pushes; without a friction nothing tells whether it slips"},
    {"idle", "doubtful", "!", "it carries nothing"},
    {"slips", "failed", "✗", "its force lies outside the cone of friction"},
    {"pulls", "failed", "✗", "it would have to pull, which no fingertip can"},
}};

Judgement judgement(const std::string& word) {
  for (const Judgement& one : of_fingers)
    if (one.word == word) return one;
  const auto verdict = lab::verdict_named(word);
  if (!verdict) return {word, "", "", ""};
  const std::string_view meaning = report::in_words(*verdict);
  if (lab::is_faultless(*verdict)) return {word, "good", "✓", meaning};
  if (*verdict == lab::Verdict::failed) return {word, "failed", "✗", meaning};
  return {word, "doubtful", "!", meaning};
}

}  // namespace

std::string heading(const std::string& title, const std::string& file, const std::string& words) {
  return enclosed("h1", escaped(title.empty() ? file : title)) +
         enclosed("p", (title.empty() ? "" : escaped(file + ": ")) + words_html(words), "quiet");
}

std::string answer_box(const std::vector<report::Answer>& answers) {
  std::string html = "<div class=\"answers\">\n";
  for (const report::Answer& answer : answers)
    html += std::string("<div") + (answer.doubtful ? " class=\"doubtful\">" : ">") +
            element("b", answer.value) + element("span", answer.meaning) + "</div>\n";
  return html + "</div>\n";
}

std::string mark_of(const std::string& word, std::string_view type, std::string_view sign,
                    std::string_view meaning) {
  return "<span class=\"verdict " + std::string(type) + "\" title=\"" + escaped(meaning) + "\">" +
         std::string(sign) + ' ' + escaped(word) + "</span>";
}

std::string verdict_mark(const std::string& word) {
  const Judgement one = judgement(word);
  return one.sign.empty() ? escaped(word) : mark_of(word, one.type, one.sign, one.meaning);
}

std::string verdict_table(std::vector<std::vector<std::string>> rows) {
  const auto& head = rows.front();
  const auto column = std::find(head.begin(), head.end(), "verdict") - head.begin();
  for (auto& row : rows)
    std::rotate(row.begin() + 1, row.begin() + column, row.begin() + column + 1);
  std::string html = drawing::html_table(rows, [](std::size_t k, const std::string& text) {
    return k == 1 ? verdict_mark(text) : words_html(text);
  });
  std::vector<std::string> said;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const Judgement one = judgement(rows[i][1]);
    if (one.type == "good" || one.meaning.empty() ||
        std::find(said.begin(), said.end(), rows[i][1]) != said.end())
      continue;
    said.push_back(rows[i][1]);
    html +=
        "<p class=\"quiet\">" + verdict_mark(rows[i][1]) + ": " + escaped(one.meaning) + ".</p>\n";
  }
  return html;
}

std::string paragraphs(const std::vector<std::string>& texts, std::string_view type) {
  std::string html;
  for (const std::string& text : texts) html += element("p", text, type);
  return html;
}

std::string remarks_html(const report::Sentences& said, const std::string& before) {
  std::string html;
  for (const std::string& warning : said.warnings) html += element("p", before + warning, "note");
  for (const std::string& note : said.notes) html += element("p", before + note);
  return html;
}

std::string suspicions(const lab::Findings& findings, const AnyScene& scene) {
  std::string html;
  for (const lab::Finding& one : findings)
    html += "<details class=\"note\">" + element("summary", report::in_words(one, scene)) +
            element("p", report::advice(one, scene)) + "</details>\n";
  return html;
}

std::string scene_html(const Scene& scene) {
  std::string html = element("p", "Sensor: " + report::sensor_in_words(scene) +
                                      ". Material: " + report::material_in_words(scene) +
                                      ". Forward model: " + std::string(name(scene.forward)) + ".");
  if (scene.time) html += element("p", "This is " + report::time_in_words(scene) + ".");
  const std::vector<std::string> contacts = report::contacts_in_words(scene);
  html += contacts.empty() ? element("p", "No contact: an unloaded sensor.")
                           : drawing::html_list(contacts);
  return html + element("p", "Effects simulated: " + report::effects_in_words(scene, true) +
                                 ". Absent, and free of cost: " +
                                 report::effects_in_words(scene, false) + ".");
}

std::string colophon(std::string_view summary, const std::string& body, const drawing::Files& own,
                     const Made& made) {
  std::string html = "<details>" + element("summary", summary) + body;
  if (!made.by.empty()) html += "<p>Made by <code>" + escaped(made.by) + "</code></p>\n";
  std::string links;
  const auto link = [&](const std::string& file) {
    links += (links.empty() ? "" : ", ") + ("<a href=\"" + escaped(file) + "\">") + escaped(file) +
             "</a>";
  };
  for (const std::string& file : made.files) link(file);
  for (const auto& [file, content] : own) link(file);
  if (!links.empty()) html += "<p>Files: " + links + ".</p>\n";
  return html + "</details>\n";
}

std::string page_html(const std::string& title, const std::string& body) {
  const bool data = body.find(drawing::data_element) != std::string::npos;
  return drawing::html_page(title, data ? body + drawing_scripts() : body, style_sheet());
}

}  // namespace tactile_net::pages
