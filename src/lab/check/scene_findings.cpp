#include <algorithm>

#include "tactile_net/lab/readings_check.hpp"

namespace tactile_net::lab {
namespace {

/// A pad of rubber has 10 kPa to 100 MPa, an array is between a millimetre and a metre long: where
/// the modulus can only be in Pa the length must be in m, and the other way round.
bool looks_mixed(double modulus, double length) {
  const bool modulus_in_pa = modulus >= 1e4;
  const bool modulus_in_mpa = modulus <= 1e3;
  return (modulus_in_pa && length > 2.0) || (modulus_in_mpa && length < 0.2);
}

}  // namespace

Findings scene_findings(const Scene& scene) {
  Findings findings;
  const SensorArray& sensor = scene.sensor;
  const double length = static_cast<double>(sensor.count) * sensor.pitch;
  const auto [least, largest] = std::minmax_element(sensor.depths.begin(), sensor.depths.end());
  if (looks_mixed(scene.material.youngs_modulus, length))
    findings.emplace_back(finding::MixedUnits{scene.material.youngs_modulus, length});
  if (*largest > length) findings.emplace_back(finding::DepthBeyondArray{*largest, length});
  if (sensor.pitch > 2.0 * *least)
    findings.emplace_back(finding::PitchCoarse{sensor.pitch, *least});
  return findings;
}

}  // namespace tactile_net::lab
