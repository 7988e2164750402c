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
  const auto alpha = group.alpha ? std::optional(group.alpha->value) : std::nullopt;
  if (!group.bands) {
    const auto tangential =
        overview.tangential() ? std::optional(group.resultant.tangential) : std::nullopt;
    return {alpha, group.resultant.normal, {}, tangential, {}, group.resultant.centre(), {}, {}};
  }
  const UncertainResultant& contact = group.bands->resultant;
  return {alpha,
          contact.normal.value,
          contact.normal.deviation,
          value(contact.tangential),
          deviation(contact.tangential),
          value(contact.centre),
          deviation(contact.centre),
          group.bands->noise.residual_rms};
}

}  // namespace tactile_net::report
