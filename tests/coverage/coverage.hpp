/// @file
/// How often the truth lies within the bands: random contacts on coarse and on dense arrays, their
/// readings integrated exactly, noise added, reconstructed as a scene of that array is. Lengths are
/// in depths.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net::coverage {

enum class Place {
  inside,     ///< middles of the contacts in the middle 60 % of the array
  overhangs,  ///< middles over the array, up to half of each contact beyond its end
};

/// One array on one pad, one size of noise.
struct Setting {
  double pitch = 1.0;         ///< of the taxels: a number of quarters
  double noise = 0.01;        ///< rms over the frame's largest reading
  std::size_t unknowns = 1;   ///< 1: stress_x; 2: stress_x and shear_xy, friction up to 0.6
  bool layer = false;         ///< three depths thick, bonded; else a half plane
  bool grid = false;          ///< tractions lie on a grid; else where a scene's do by default
  bool stated = true;         ///< by the scene: how large the noise is
  double offset = 0.0;        ///< of every reading, over the frame's largest one
  std::string reconstruct{};  ///< more lines of the scene's section of that name
};

/// Where the setting's tractions lie.
[[nodiscard]] SurfaceBasis basis(const Setting& setting);

/// Of contacts: anywhere between, each as often as another.
struct HalfWidths {
  double least = 0.4;
  double most = 2.0;
};

/// Hertz strips, with their readings at taxels a quarter of the depth apart: every setting's are
/// among them.
class Contacts {
 public:
  /// Takes seconds for some hundred in a layer.
  Contacts(std::size_t count, Place place, bool layer, const HalfWidths& half_widths = {});

  [[nodiscard]] std::size_t count() const noexcept { return contacts_.size(); }
  /// Contact i as the setting has it, of a force that makes the largest reading 1.
  struct Frame {
    RigidContact contact{};
    std::vector<double> readings{};  ///< of the setting's array
  };
  [[nodiscard]] Frame frame(std::size_t i, const Setting& setting) const;

 private:
  std::vector<RigidContact> contacts_;
  std::vector<std::vector<double>> pressed_;  // stress_x, shear_xy without friction
  std::vector<std::vector<double>> dragged_;  // what friction 1 adds
};

/// Of the forces: errors over the normal force.
struct Score {
  std::size_t frames = 0;
  std::vector<double> force_errors{};      ///< ascending
  std::vector<double> force_deviations{};  ///< likewise
  std::vector<double> field_errors{};      ///< relative 2-norms, ascending
  double force_within = 0.0;               ///< share of frames within two deviations
  double tangential_within = 0.0;          ///< likewise; with one unknown 0
  double centre_within = 0.0;              ///< likewise
  double field_within = 0.0;               ///< share of values within two bands
};

/// Value of a share of ascending values: 0.5 is the median.
[[nodiscard]] double at_share(const std::vector<double>& ascending, double share);

/// @pre  contacts are of the setting's pad
[[nodiscard]] Score score(const Setting& setting, const Contacts& contacts);

}  // namespace tactile_net::coverage
