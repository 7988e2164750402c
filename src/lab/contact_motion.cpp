#include "tactile_net/lab/contact_motion.hpp"

#include <numbers>

#include "tactile_net/network/motion.hpp"

namespace tactile_net::lab {

std::optional<ContactMotion> contact_motion(const SceneCircuit& circuit) {
  const Certificate& certificate = circuit.certificate();
  if (!certificate.dynamics || !(certificate.dynamics->slowest < 0.0) || !circuit.loaded())
    return std::nullopt;
  const std::vector<double> rate = circuit.readings_per_length();
  if (rate.empty()) return std::nullopt;
  const MotionLag behind = motion_lag(circuit.network(), rate);
  if (!(behind.seconds > 0.0) || !(behind.relative > 0.0)) return std::nullopt;
  const double change = behind.relative / behind.seconds;  // of the answer, a metre
  return ContactMotion{
      .delay = behind.seconds,
      .speed = ContactMotion::lag / behind.relative,
      .slowest_hertz = -certificate.dynamics->slowest / (2.0 * std::numbers::pi),
      .sampled_speed = ContactMotion::lag * ContactMotion::sampling_hertz / change};
}

}  // namespace tactile_net::lab
