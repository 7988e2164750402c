/// @file
/// The figures of a page: a plot, what to see in it, and the file with its numbers.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/drawing/plot.hpp"

namespace tactile_net::drawing {

struct Figure {
  std::string name;     ///< of its files, without an extension: "normal-error"
  std::string section;  ///< where on the page it stands
  std::string caption;  ///< what to see, in a sentence or two
  Plot plot;
};

/// Name and content of files that stand beside a page.
using Files = std::vector<std::pair<std::string, std::string>>;

/// A page, and what it links to.
struct Page {
  std::string html{};
  std::string missing{};  ///< what could not be drawn and why; empty: nothing is missing
  Files files{};
};

/// Every figure of a page, drawn by one run of gnuplot.
class Figures {
 public:
  /// Curves without a finite value are left out, and figures without a curve. Without gnuplot all
  /// are, and `missing` says so; their data is there all the same.
  explicit Figures(std::vector<Figure> figures);

  /// The section's figures, each with its caption and the link to its data; empty if it has none.
  [[nodiscard]] std::string html(std::string_view section) const;

  [[nodiscard]] const std::string& missing() const noexcept { return missing_; }
  [[nodiscard]] Files data() const;      ///< NAME.csv of each
  [[nodiscard]] Files pictures() const;  ///< NAME.svg of each

 private:
  std::vector<Figure> figures_;
  std::vector<std::string> svg_;  // one per figure, or none
  std::string missing_;
};

/// A figure of a page; picture and caption are HTML, `data` is the file that holds its numbers.
[[nodiscard]] std::string figure_html(const std::string& name, const std::string& picture,
                                      const std::string& caption, const std::string& data);

/// A plot's numbers: a column per curve, and one for the half width of its band; where curves have
/// an x of their own a row per point instead, the curve's name first. Empty: not finite.
[[nodiscard]] std::string csv_of(const Plot& plot);

}  // namespace tactile_net::drawing
