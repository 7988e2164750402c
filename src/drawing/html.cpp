#include "tactile_net/drawing/html.hpp"

#include "tactile_net/numeric/version.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::drawing {
namespace {

/// Light and dark, from a telephone's width on. Plots are drawn on white: in the dark they are
/// turned to light lines on black, hues kept. Two of them stand in a row where there is room.
constexpr std::string_view style = R"(
:root { color-scheme: light dark; --ink: #222; --paper: #fff; --rule: #ddd; --quiet: #595959;
        --note: #fff6e5; --note-ink: #7a4b00; --bad: #fdecea; --bad-ink: #8a1c00; --link: #0059a3; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #e6e6e6; --paper: #191919; --rule: #444; --quiet: #aaa;
          --note: #33270f; --note-ink: #ffd58a; --bad: #3a1712; --bad-ink: #ffb4a3; --link: #8ab4f8; }
  .plot svg { filter: invert(.93) hue-rotate(180deg) brightness(1.4); }
}
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
       max-width: 70rem; margin: 2rem auto; padding: 0 1rem; overflow-wrap: break-word; }
h1 { font-size: 1.6rem; line-height: 1.25; margin-bottom: 0; }
h2 { font-size: 1.15rem; margin-top: 2rem; } a { color: var(--link); }
p, ul { max-width: 50rem; }
table { border-collapse: collapse; } .wide { overflow-x: auto; margin: 1rem 0; }
th, td { text-align: left; padding: .25rem .8rem .25rem 0; border-bottom: 1px solid var(--rule);
         white-space: nowrap; font-variant-numeric: tabular-nums; }
.note { color: var(--note-ink); background: var(--note); padding: .4rem .8rem;
        border-left: 4px solid #e69f00; }
.bad { color: var(--bad-ink); background: var(--bad); padding: .4rem .8rem;
       border-left: 4px solid #d55e00; }
.answer { font-size: 1.1rem; border-left: 4px solid #0072b2; padding: .2rem .8rem; }
.figures { display: grid; gap: 1.5rem 2rem; margin: 1.5rem 0;
           grid-template-columns: repeat(auto-fill, minmax(min(100%, 32rem), 1fr)); }
figure { margin: 0; min-width: 0; max-width: 40rem; } .plot svg { display: block; width: 100%; height: auto; }
figcaption { color: var(--quiet); font-size: .95rem; margin-top: .3rem; }
footer { color: var(--quiet); margin-top: 3rem; font-size: .9rem; }
@media print {
  body { font-size: 10pt; max-width: none; margin: 0; padding: 0; } h2 { break-after: avoid; }
  .figures { grid-template-columns: 1fr 1fr; gap: 1rem; } figure, tr { break-inside: avoid; }
  figcaption { font-size: 9pt; } table { font-size: 8.5pt; } th, td { padding-right: .5rem; white-space: normal; }
  .wide { overflow: visible; }
}
)";

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : printable_lines(text)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string element(std::string_view tag, std::string_view content, std::string_view type) {
  std::string out = "<" + std::string(tag);
  if (!type.empty()) out += " class=\"" + std::string(type) + "\"";
  return out + ">" + escaped(content) + "</" + std::string(tag) + ">\n";
}

std::string html_list(const std::vector<std::string>& items) {
  std::string out = "<ul>\n";
  for (const std::string& item : items) out += element("li", item);
  return out + "</ul>\n";
}

std::string html_table(const std::vector<std::vector<std::string>>& rows) {
  std::string out = "<div class=\"wide\"><table>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out += "<tr>";
    for (const std::string& cell : rows[i]) out += element(i == 0 ? "th" : "td", cell);
    out += "</tr>\n";
  }
  return out + "</table></div>\n";
}

std::string html_page(std::string_view title, std::string_view body, std::string_view extra_style) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width\">\n" +
         std::string(written_by) + " " + std::string(version()) + "\">\n" +
         element("title", title) + "<style>" + std::string(style) + std::string(extra_style) +
         "</style></head>\n<body>\n" + std::string(body) +
         element("footer", "Written by tactile-net " + std::string(version()) +
                               ". Lengths, forces and tractions are in the input's units.") +
         "</body>\n</html>\n";
}

}  // namespace tactile_net::drawing
