/// @file
/// Line plots as data: curves in axes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net::drawing {

struct Curve {
  std::string label;
  std::vector<double> y;   ///< one value per x; not finite: a gap
  std::size_t colour = 0;  ///< 0: black; the same number is the same colour in every plot
  bool dots = false;       ///< points instead of a line
  std::vector<double> low{}, high{};  ///< ends of a band around the line, one per x; empty: none
  std::vector<double> x{};            ///< the curve's own; empty: the plot's
  bool marks = false;                 ///< points on the line, of a shape of their own
  bool dashed = false;
  double width = 0.0;  ///< of the line; 0: as the others'
  bool quiet = false;  ///< grey, for comparison; see `Plot::quiet_label`
  /// Words beside its points, one per x; empty ones: none.
  std::vector<std::string> names{};
};

/// How a plot's curves are rows of a map: colours over x and another axis, the first curve lowest.
struct HeatMap {
  std::string label{};  ///< of the other axis
  double low = 0.0;     ///< its ends
  double high = 0.0;
  double most = 0.0;  ///< the size of full colour, > 0
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<double> x;
  std::vector<Curve> curves;
  bool logarithmic_x = false;
  bool logarithmic_y = false;  ///< values <= 0: a gap
  bool from_zero = false;      ///< the y axis begins at 0
  double y_end = 0.0;          ///< > 0: the y axis is 0 ... this
  double y_at_least = 0.0;     ///< > 0: the y axis reaches from minus this to this, or further
  /// > 0: both axes are linear up to about this, and logarithmic beyond it on both sides of zero.
  double linear_within = 0.0;
  std::string band_label{};      ///< what the bands are; empty: they are not in the key
  std::string quiet_label{};     ///< of all quiet curves together; empty: they are not in the key
  std::optional<HeatMap> map{};  ///< the plot is one; its `y_label` is that of the values
  bool wide = false;             ///< twice as wide as others
};

/// The plot as data of a page, which a script draws (pages/web/chart.js).
/// @param name  what the picture shows, for whoever hears a page
[[nodiscard]] std::string chart_html(const Plot& plot, std::string_view name);

}  // namespace tactile_net::drawing
