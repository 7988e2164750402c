#include "tactile_net/calibration/calibration_options.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numeric/named.hpp"
#include "numeric/require.hpp"

namespace tactile_net {
namespace {

struct Row : Named<PadParameter> {
  double CalibrationOptions::*sd;
};

constexpr Row parameters[] = {
    {{PadParameter::depth, "depth"}, &CalibrationOptions::depth_sd},
    {{PadParameter::thickness, "thickness"}, &CalibrationOptions::thickness_sd},
    {{PadParameter::poisson_ratio, "poisson_ratio"}, &CalibrationOptions::poisson_ratio_sd},
    {{PadParameter::youngs_modulus, "youngs_modulus"}, &CalibrationOptions::youngs_modulus_sd},
    {{PadParameter::crosstalk, "crosstalk"}, &CalibrationOptions::crosstalk_sd},
    {{PadParameter::shift, "shift"}, &CalibrationOptions::shift_sd},
    {{PadParameter::pitch, "pitch"}, &CalibrationOptions::pitch_sd},
    {{PadParameter::shift_z, "shift_z"}, &CalibrationOptions::shift_z_sd}};

constexpr Named<GainSharing> sharings[] = {{GainSharing::reading, "reading"},
                                           {GainSharing::taxel, "taxel"},
                                           {GainSharing::channel, "channel"}};

void require_sd(std::string_view field, double sd) {
  require(sd >= 0.0, field, "be >= 0", sd);  // infinite: nothing is known
}

}  // namespace

std::string_view name(PadParameter parameter) noexcept { return name_in<parameters>(parameter); }
std::string_view name(GainSharing sharing) noexcept { return name_in<sharings>(sharing); }

double CalibrationOptions::sd(PadParameter parameter) const noexcept {
  return this->*row_in<parameters>(parameter).sd;
}
void CalibrationOptions::set_sd(PadParameter parameter, double sd) noexcept {
  this->*row_in<parameters>(parameter).sd = sd;
}

void check(const CalibrationOptions& options) {
  for (const Row& row : parameters) require_sd(std::string(row.name) + "_sd", options.*row.sd);
  require_sd("gain_sd", options.gain_sd);
  require_sd("mean_gain_sd", options.mean_gain_sd);
  require_sd("half_width_sd", options.half_width_sd);
  if (options.starts.empty()) throw std::invalid_argument("starts must hold one value at least");
  for (const double start : options.starts) require_positive("starts", start);
}

}  // namespace tactile_net
