#include "tactile_net/calibration/calibration_options.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numeric/named.hpp"
#include "numeric/require.hpp"

namespace tactile_net {
namespace {

/// Of each parameter, in the order of `PadParameter`.
constexpr double CalibrationOptions::*deviations[] = {
    &CalibrationOptions::depth_sd,         &CalibrationOptions::thickness_sd,
    &CalibrationOptions::poisson_ratio_sd, &CalibrationOptions::youngs_modulus_sd,
    &CalibrationOptions::crosstalk_sd,     &CalibrationOptions::shift_sd,
    &CalibrationOptions::pitch_sd,         &CalibrationOptions::shift_z_sd};
static_assert(std::size(deviations) == pad_parameter_count);

constexpr Named<GainSharing> sharings[] = {{GainSharing::reading, "reading"},
                                           {GainSharing::taxel, "taxel"},
                                           {GainSharing::channel, "channel"}};

void require_sd(std::string_view field, double sd) {
  require(sd >= 0.0, field, "be >= 0", sd);  // infinite: nothing is known
}

}  // namespace

std::string_view name(PadParameter parameter) noexcept {
  return name_in<Enumerators<PadParameter>::all>(parameter);
}
std::string_view name(GainSharing sharing) noexcept { return name_in<sharings>(sharing); }

double CalibrationOptions::sd(PadParameter parameter) const noexcept {
  return this->*deviations[static_cast<std::size_t>(parameter)];
}
void CalibrationOptions::set_sd(PadParameter parameter, double sd) noexcept {
  this->*deviations[static_cast<std::size_t>(parameter)] = sd;
}

void check(const CalibrationOptions& options) {
  for (const auto& [parameter, name, text] : Enumerators<PadParameter>::all)
    require_sd(std::string(name) + "_sd", options.sd(parameter));
  require_sd("gain_sd", options.gain_sd);
  require_sd("mean_gain_sd", options.mean_gain_sd);
  require_sd("half_width_sd", options.half_width_sd);
  if (options.starts.empty()) throw std::invalid_argument("starts must hold one value at least");
  for (const double start : options.starts) require_positive("starts", start);
}

}  // namespace tactile_net
