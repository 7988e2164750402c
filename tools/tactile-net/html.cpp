#include "html.hpp"

namespace tactile_net::tool {
namespace {

constexpr std::string_view style = R"(
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 70rem; margin: 2rem auto;
       padding: 0 1rem; }
h1 { font-size: 1.6rem; margin-bottom: 0; } h2 { font-size: 1.15rem; margin-top: 2rem; }
table { border-collapse: collapse; } .wide { overflow-x: auto; }
th, td { text-align: left; padding: .25rem .8rem .25rem 0; border-bottom: 1px solid #ddd;
         white-space: nowrap; font-variant-numeric: tabular-nums; }
.note { color: #7a4b00; background: #fff6e5; padding: .4rem .8rem; border-left: 4px solid #e69f00; }
.bad { color: #8a1c00; background: #fdecea; padding: .4rem .8rem; border-left: 4px solid #d55e00; }
figure { margin: 1rem 0; } figcaption { max-width: 46rem; }
svg { max-width: 100%; height: auto; } footer { color: #666; margin-top: 3rem; font-size: .9rem; }
@media (prefers-color-scheme: dark) {
  body { color: #ddd; background: #16181a; } th, td { border-color: #444; } footer { color: #999; }
  .note { color: #ffd9a0; background: #3a2c10; } .bad { color: #ffb9a6; background: #3d1710; }
  figure.plot { background: #fff; color: #222; } }
)";

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
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
         element("title", title) + "<style>" + std::string(style) + std::string(extra_style) +
         "</style></head>\n<body>\n" + std::string(body) +
         element("footer", "Written by tactile-net " TACTILE_NET_VERSION
                           ". Lengths, forces and tractions are in the input's units.") +
         "</body>\n</html>\n";
}

}  // namespace tactile_net::tool
