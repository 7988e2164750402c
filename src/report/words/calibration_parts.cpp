#include "report/words/calibration_parts.hpp"

#include <algorithm>

namespace tactile_net::report {

std::string spoken_name(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string spoken_parameter(PadParameter parameter, bool is_skin) {
  switch (parameter) {
    case PadParameter::depth:
      return "depth";
    case PadParameter::thickness:
      return "thickness";
    case PadParameter::poisson_ratio:
      return "Poisson's ratio";
    case PadParameter::youngs_modulus:
      return "Young's modulus";
    case PadParameter::crosstalk:
      return "crosstalk";
    case PadParameter::shift:
      return is_skin ? "shift of the skin along y" : "shift of the array";
    case PadParameter::shift_z:
      return "shift of the skin along z";
    case PadParameter::pitch:
      return "pitch";
  }
  return {};
}

}  // namespace tactile_net::report
