/// @file
/// A log of known presses: what a sensor is calibrated with.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/elasticity/space/disc.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net {

/// What somebody states of a value: nothing, the value exactly, or the value give or take `sd`.
struct Stated {
  std::optional<double> value{};  ///< absent: unknown
  double sd = 0.0;                ///< one standard deviation, >= 0; 0: exact

  [[nodiscard]] bool is_exact() const noexcept { return value && sd == 0.0; }
};

/// "sphere", "punch", "cone", as logs and JSON spell them.
[[nodiscard]] std::string_view name(DiscProfile profile) noexcept;

/// A rigid indenter held against the pad while the readings were taken.
struct Press {
  std::size_t number = 0;           ///< as the log counts, from 1
  Shape shape = Shape::cylinder;    ///< on a line
  Stated force{};                   ///< [N/m], on a skin [N], > 0
  Stated position{};                ///< y of the middle; 0 is the middle of the array [m]
  Stated half_width{};              ///< of the contact [m], > 0
  std::optional<double> radius{};   ///< of a rod or a ball [m]: ties the half width to the force
  Stated friction{.value = 0.0};    ///< tangential over normal traction, along y
  std::vector<double> readings{};   ///< mean of its steady frames, in the array's order
  Stated position_z{.value = 0.0};  ///< z of the middle [m]; on a line exactly 0
  DiscProfile disc = DiscProfile::sphere;  ///< on a skin
  Stated friction_z{.value = 0.0};         ///< along z; on a line exactly 0
};

/// What the sensor says when nothing touches it.
struct UnloadedFrames {
  std::size_t frames = 0;
  std::vector<double> mean{};          ///< of each reading
  std::vector<double> reading_rms{};   ///< of each reading about its mean
  std::vector<double> rms{};           ///< of each channel, its readings pooled
  double common_mode = 0.0;            ///< mean correlation of different readings
  double neighbour_correlation = 0.0;  ///< mean correlation of neighbours of one channel
};

/// Mean and noise of unloaded frames, each as long as the sensor's frames.
///
/// @throw std::invalid_argument  fewer than two frames, or one of another length
[[nodiscard]] UnloadedFrames unloaded_frames(const SignalLayout& sensor,
                                             const std::vector<std::vector<double>>& frames);

struct PressLog {
  UnloadedFrames unloaded{};
  std::vector<Press> presses{};
};

}  // namespace tactile_net
