#include <algorithm>
#include <variant>
#include <vector>

#include "tactile_net/lab/readings_check.hpp"

namespace tactile_net::lab {
namespace {

/// A pad of rubber has 10 kPa to 100 MPa, an array is between a millimetre and
/// a metre long: where the modulus can only be in Pa the length must be in m,
/// and the other way round.
bool looks_mixed(double modulus, double length) {
  const bool modulus_in_pa = modulus >= 1e4;
  const bool modulus_in_mpa = modulus <= 1e3;
  return (modulus_in_pa && length > 2.0) || (modulus_in_mpa && length < 0.2);
}

}  // namespace

namespace {

/// @param length  of the array, its longer side
/// @param pitch   the larger one
Findings findings_of(double modulus, double length, double pitch,
                     const std::vector<double>& depths) {
  Findings findings;
  const auto [least, largest] = std::minmax_element(depths.begin(), depths.end());
  if (looks_mixed(modulus, length)) findings.emplace_back(finding::MixedUnits{modulus, length});
  if (*largest > length) findings.emplace_back(finding::DepthBeyondArray{*largest, length});
  if (pitch > 2.0 * *least) findings.emplace_back(finding::PitchCoarse{pitch, *least});
  return findings;
}

}  // namespace

Findings scene_findings(const Scene& scene) {
  const SensorArray& sensor = scene.sensor;
  return findings_of(scene.material.youngs_modulus,
                     static_cast<double>(sensor.count) * sensor.pitch, sensor.pitch, sensor.depths);
}

Findings scene_findings(const SkinScene& scene) {
  const SkinArray& skin = scene.sensor;
  std::vector<double> depths;
  double low[2] = {}, high[2] = {};  // of the places, along y and z
  for (const Site& site : sites(skin)) {
    const double place[2] = {site.y, site.z};
    for (const std::size_t k : {0U, 1U}) {
      low[k] = depths.empty() ? place[k] : std::min(low[k], place[k]);
      high[k] = depths.empty() ? place[k] : std::max(high[k], place[k]);
    }
    depths.push_back(site.depth);
  }
  const bool even = is_even(skin);
  const double pitch_y = !even || skin.rows > 1 ? skin.pitch_y : 0.0;
  const double pitch_z = !even || skin.columns > 1 ? skin.pitch_z : 0.0;
  const double length = std::max(high[0] - low[0] + pitch_y, high[1] - low[1] + pitch_z);
  return findings_of(scene.material.youngs_modulus, length, std::max(pitch_y, pitch_z), depths);
}

Findings scene_findings(const AnyScene& scene) {
  return std::visit([](const auto& one) { return scene_findings(one); }, scene);
}

}  // namespace tactile_net::lab
