/// @file
/// Private. What is known of a frame and its deviations, as columns of numbers.
#pragma once

#include <limits>
#include <optional>
#include <tuple>

#include "tactile_net/inverse/contact_patch.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/lab/answer_fields.hpp"

namespace tactile_net::report {

/// What a frame's tractions amount to. Of a line the drag and the centre along y are the only ones.
struct ResultantRow : UncertainWrench {
  std::optional<Uncertain> friction{};
  std::optional<Uncertain> angle{};
  std::optional<Uncertain> slip_margin{};
  double residual = 0.0;
  double model = 0.0;

  using R = ResultantRow;
  static constexpr auto described = std::tuple_cat(
      Fields<UncertainWrench>::all,
      std::tuple{
          field("friction", &R::friction, "Drag over force.", Of::skins),
          field("angle", &R::angle, Measure::angle, "The angle between the force and the normal."),
          field("slip_margin", &R::slip_margin,
                "The share of the friction limit that drag and torsion leave; below 0 it slips.",
                Of::skins),
          field("residual_rms", &R::residual, Measure::reading,
                "The noise of the weighted readings as the residual shows it.", Of::lines),
          field("model_rms", &R::model, Measure::reading,
                "The part of the residual beyond the noise stated.", Of::lines)});
};

/// How far a frame's answer is to be trusted, in numbers.
struct TrustRow {
  double data = 0.0;
  double alpha = 0.0;

  static constexpr auto described = std::tuple{
      field("data", &TrustRow::data,
            "The worst doubt about the readings: 0 none, else 1 + its place among them."),
      field("alpha", &TrustRow::alpha, "How much is smoothed.")};
};

/// @param data  absent: not judged, which is no number
[[nodiscard]] inline TrustRow trust_row(const std::optional<DataVerdict>& data, double alpha) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {.data = !data                ? none
                  : data->consistent() ? 0.0
                                       : 1.0 + static_cast<double>(data->doubts.front()),
          .alpha = alpha};
}

}  // namespace tactile_net::report
