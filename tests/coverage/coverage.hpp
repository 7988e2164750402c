/// @file
/// How often the truth lies within the bands: random contacts on coarse and on dense arrays, their
/// readings integrated exactly, noise added, reconstructed as a scene of that array is. Lengths are
/// in depths.
#pragma once

#include <cstddef>
#include <cstdint>
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
  double pitch = 1.0;               ///< of the taxels: a number of quarters
  double noise = 0.01;              ///< rms over the frame's largest reading
  std::size_t unknowns = 1;         ///< 1: stress_x; 2: stress_x and shear_xy, friction up to 0.6
  bool layer = false;               ///< three depths thick, bonded; else a half plane
  bool grid = false;                ///< tractions lie on a grid; else where a scene's do by default
  bool stated = true;               ///< by the scene: how large the noise is
  double offset = 0.0;              ///< of every reading, over the frame's largest one
  std::string reconstruct{};        ///< more lines of the scene's section of that name
  std::string of_noise{};           ///< of its section [noise]
  std::vector<double> positions{};  ///< of taxels, quarters, in place of the pitch
  std::vector<std::size_t> dead{};  ///< taxels
  bool strain = false;              ///< strain_x is read in place of stress_x

  // What the scene says and is not so:
  double stated_noise = 1.0;      ///< over the noise that there is
  double stated_depth = 1.0;      ///< in true ones
  double stated_thickness = 3.0;  ///< of a layer
  double stated_modulus = 1.0;    ///< over the true one
};

/// From text, for the reader's defaults.
[[nodiscard]] Scene scene_of(const Setting& setting);

/// Where the setting's tractions lie.
[[nodiscard]] SurfaceBasis basis(const Setting& setting);

/// Of contacts: anywhere between, each as often as another.
struct HalfWidths {
  double least = 0.4;
  double most = 2.0;
};

/// What presses.
enum class Load {
  hertz,        ///< a strip, as a cylinder does
  even,         ///< the same pressure all over a strip
  rigid_punch,  ///< a flat one, whose pressure is infinite at both edges
  two_hertz,    ///< two strips, edges half a depth to four depths apart, and one from the ends
};

struct ContactOptions {
  Place place = Place::inside;
  Load load = Load::hertz;  ///< @pre  two of them are inside
  bool layer = false;       ///< the pad, as the setting's
  bool strain = false;      ///< what is read, as the setting's
  HalfWidths half_widths{};
  std::uint64_t seed = 0;
};

/// With their readings at taxels a quarter of the depth apart: every setting's are among them.
class Contacts {
 public:
  /// Takes seconds for some hundred in a layer.
  explicit Contacts(std::size_t count, const ContactOptions& options = {});

  [[nodiscard]] std::size_t count() const noexcept { return contacts_.size(); }
  /// Contact i as the setting has it, of a force that makes the largest reading 1.
  struct Frame {
    std::vector<Contact> contacts{};
    double force = 0.0;     ///< all of it, normal
    double friction = 0.0;  ///< of every contact
    double centre = 0.0;
    std::vector<double> readings{};  ///< of the setting's array, with its noise and offset
  };
  [[nodiscard]] Frame frame(std::size_t i, const Setting& setting) const;

 private:
  std::vector<std::vector<RigidContact>> contacts_;
  std::vector<double> frictions_{};
  std::vector<std::vector<double>> pressed_;  // the first quantity and shear_xy, without friction
  std::vector<std::vector<double>> dragged_;  // what friction 1 adds
  std::uint64_t seed_;
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
