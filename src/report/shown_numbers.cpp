#include "report/shown_numbers.hpp"

namespace tactile_net::report {

std::array<std::optional<double>, shown_names.size()> shown_numbers(
    const lab::RecordingOverview& overview, const lab::FrameGroup& group) {
  const auto value = [](const std::optional<Uncertain>& number) {
    return number ? std::optional(number->value) : std::nullopt;
  };
  const auto deviation = [](const std::optional<Uncertain>& number) {
    return number ? std::optional(number->deviation) : std::nullopt;
  };
  const double weight = group.answer.alpha.value;
  const auto alpha = weight > 0.0 ? std::optional(weight) : std::nullopt;
  if (!overview.is_line()) {
    const UncertainWrench& wrench = group.answer.wrench;
    if (!wrench.tangential_y)
      return {alpha, wrench.normal.value, wrench.normal.deviation, {}, {}, {}, {}, {}};
    const Uncertain drag = drag_of(wrench);
    return {alpha, wrench.normal.value, wrench.normal.deviation, drag.value, drag.deviation, {}, {},
            {}};
  }
  if (!group.answer.bands) {
    const auto tangential =
        overview.tangential() ? std::optional(group.resultant.tangential) : std::nullopt;
    return {alpha, group.resultant.normal, {}, tangential, {}, group.resultant.centre(), {}, {}};
  }
  const UncertainResultant& contact = group.answer.bands->resultant;
  return {alpha,
          contact.normal.value,
          contact.normal.deviation,
          value(contact.tangential),
          deviation(contact.tangential),
          value(contact.centre),
          deviation(contact.centre),
          group.answer.bands->noise.residual_rms};
}

}  // namespace tactile_net::report
