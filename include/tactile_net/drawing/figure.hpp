/// @file
/// The figures of a page: a plot, what to see in it, and the file with its numbers.
#pragma once

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
  Plot plot;            ///< what is drawn, and the numbers in any case
  /// HTML of the picture where it is not the plot's: an <svg>, or what says the same.
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
  Files files{};
};

/// Every figure of a page.
class Figures {
 public:
  /// Curves without a finite value are left out, and figures without a curve.
  explicit Figures(std::vector<Figure> figures);

  /// The section's figures in a .figures, each with its caption and the link to its data; empty if
  /// it has none.
  [[nodiscard]] std::string html(std::string_view section) const;

  [[nodiscard]] Files data() const;  ///< NAME.csv of each

 private:
  std::vector<Figure> figures_;
};

/// A figure of a page; picture and caption are HTML, `data` is the file that holds its numbers.
/// @param name  its id; empty: none. @param type  its class; empty: none
[[nodiscard]] std::string figure_html(std::string_view name, std::string_view picture,
                                      std::string_view caption, std::string_view data,
                                      std::string_view type = {});

/// A plot's numbers: a column per curve, and two for the ends of its band; where curves have an x
/// of their own a row per point instead, the curve's name first. Empty: not finite.
[[nodiscard]] std::string csv_of(const Plot& plot);

}  // namespace tactile_net::drawing
