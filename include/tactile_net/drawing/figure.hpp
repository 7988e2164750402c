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
  Plot plot;            ///< what gnuplot draws, and the numbers in any case
  /// HTML of the picture where gnuplot is not to draw it: an <svg>, or what says the same.
  std::string picture{};
  std::string
      data{};  ///< a file beside the page that holds the numbers; empty: NAME.csv, of `plot`
  std::string type{};  ///< of the <figure>, for the style
};

/// Name and content of files that stand beside a page.
using Files = std::vector<std::pair<std::string, std::string>>;

/// A page, and what it links to.
struct Page {
  std::string html{};
  std::string missing{};  ///< what could not be drawn and why; empty: nothing is missing
  Files files{};
};

/// Every figure of a page, what gnuplot draws of them by one run of it.
class Figures {
 public:
  /// Curves without a finite value are left out, and figures without a curve. Without gnuplot those
  /// are that it draws, and `missing` says so; their data is there all the same.
  explicit Figures(std::vector<Figure> figures);

  /// The section's figures, each with its caption and the link to its data; empty if it has none.
  /// In classes for a style: .figures around all, .plot around what gnuplot drew, and where a plot
  /// is wide .wide-plot around it and .narrow-plot around the same for a telephone.
  [[nodiscard]] std::string html(std::string_view section) const;

  [[nodiscard]] const std::string& missing() const noexcept { return missing_; }
  [[nodiscard]] Files data() const;  ///< NAME.csv of each
  /// NAME.svg of each that gnuplot drew.
  [[nodiscard]] const Files& pictures() const noexcept { return svg_; }

 private:
  std::vector<Figure> figures_;
  std::vector<std::string> pictures_;  // HTML, one per figure; empty: not drawn
  Files svg_;
  std::string missing_;
};

/// A figure of a page; picture and caption are HTML, `data` is the file that holds its numbers.
/// @param name  its id; empty: none. @param type  its class; empty: none
[[nodiscard]] std::string figure_html(std::string_view name, std::string_view picture,
                                      std::string_view caption, std::string_view data,
                                      std::string_view type = {});

/// A plot's numbers: a column per curve, and one for the half width of its band; where curves have
/// an x of their own a row per point instead, the curve's name first. Empty: not finite.
[[nodiscard]] std::string csv_of(const Plot& plot);

}  // namespace tactile_net::drawing
