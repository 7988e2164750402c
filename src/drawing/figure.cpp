#include "tactile_net/drawing/figure.hpp"

#include <algorithm>
#include <cmath>

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net::drawing {
namespace {

/// A field of a CSV file, quoted where it must be.
std::string field(const std::string& text) {
  return text.find_first_of(",\"\n") == std::string::npos ? text : csv_quoted(text);
}

std::string value(double number) { return std::isfinite(number) ? shortest(number) : ""; }

}  // namespace

std::string figure_html(std::string_view name, std::string_view picture, std::string_view caption,
                        std::string_view data, std::string_view type) {
  const auto attribute = [](const std::string& key, std::string_view value) {
    return value.empty() ? "" : ' ' + key + "=\"" + escaped(value) + '"';
  };
  return "<figure" + attribute("id", name) + attribute("class", type) + ">" + std::string(picture) +
         "\n<figcaption>" + std::string(caption) + " <a" + attribute("href", data) +
         ">Numbers</a></figcaption></figure>\n";
}

std::string csv_of(const Plot& plot) {
  const bool shared = std::all_of(plot.curves.begin(), plot.curves.end(),
                                  [](const Curve& curve) { return curve.x.empty(); });
  std::string text;
  if (!shared) {
    text = "curve," + field(plot.x_label) + ',' + field(plot.y_label) + '\n';
    for (const Curve& curve : plot.curves) {
      const std::vector<double>& x = curve.x.empty() ? plot.x : curve.x;
      for (std::size_t i = 0; i < x.size(); ++i)
        text += field(curve.label) + ',' + value(x[i]) + ',' + value(curve.y[i]) + '\n';
    }
    return text;
  }
  text = field(plot.x_label);
  for (const Curve& curve : plot.curves) {
    text += ',' + field(curve.label);
    if (!curve.low.empty())
      text += ',' + field(curve.label + " low") + ',' + field(curve.label + " high");
  }
  text += '\n';
  for (std::size_t i = 0; i < plot.x.size(); ++i) {
    text += value(plot.x[i]);
    for (const Curve& curve : plot.curves) {
      text += ',' + value(curve.y[i]);
      if (!curve.low.empty()) text += ',' + value(curve.low[i]) + ',' + value(curve.high[i]);
    }
    text += '\n';
  }
  return text;
}

Figures::Figures(std::vector<Figure> figures) : figures_(std::move(figures)) {
  for (Figure& figure : figures_)
    std::erase_if(figure.plot.curves, [](const Curve& curve) {
      return std::none_of(curve.y.begin(), curve.y.end(),
                          [](double y) { return std::isfinite(y); });
    });
  std::erase_if(figures_, [](const Figure& figure) {
    return figure.plot.curves.empty() && figure.picture.empty();
  });
}

std::string Figures::html(std::string_view section) const {
  std::string html;
  for (const Figure& figure : figures_) {
    if (figure.section != section) continue;
    html += figure_html(
        figure.name,
        figure.picture.empty() ? chart_html(figure.plot, figure.caption) : figure.picture,
        words_html(figure.caption), figure.data.empty() ? figure.name + ".csv" : figure.data,
        figure.plot.wide ? "whole-row" : figure.type);
  }
  return html.empty() ? html : "<div class=\"figures\">\n" + html + "</div>\n";
}

Files Figures::data() const {
  Files files;
  for (const Figure& figure : figures_)
    if (figure.data.empty()) files.emplace_back(figure.name + ".csv", csv_of(figure.plot));
  return files;
}

}  // namespace tactile_net::drawing
