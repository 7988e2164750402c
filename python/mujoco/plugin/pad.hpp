/// @file
/// The taxels below a site of a MuJoCo model, as its plugin has them. What is computed is in lab.
#pragma once

#include <mujoco/mujoco.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/rigid_contacts.hpp"
#include "tactile_net/lab/simulated_pad.hpp"
#include "tactile_net/lab/simulated_skin_pad.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::mujoco {

/// What a model's XML says of an instance of the plugin.
struct PadSettings {
  std::string scene{};               ///< its file, from the process' folder
  std::optional<double> breadth{};   ///< of a line's pad [m]
  std::optional<double> edge{};      ///< least width of a contact of unknown curvature [m]
  std::vector<std::string> geoms{};  ///< that are the pad's; none: all of the site's body
};

/// @throw std::invalid_argument  a number is none, with the attribute's name
[[nodiscard]] PadSettings settings_of(const mjModel& model, int instance);

/// @throw std::invalid_argument  not one sensor on one site has this instance
[[nodiscard]] int sensor_of(const mjModel& model, int instance);

/// One sensor of one mjData, with its memory and noise. Not thread-safe.
class Pad {
 public:
  /// @throw InputError             the scene is bad
  /// @throw std::invalid_argument  settings and model or scene contradict each other
  Pad(const mjModel& model, int instance);

  /// How many readings these settings make, all of which are judged.
  /// @throw as the constructor
  [[nodiscard]] static std::size_t reading_count(const PadSettings& settings);

  /// Begins anew, as if it had been unloaded for ever.
  void reset();

  /// Fills the sensor's values from the contacts of this moment. A line's are channel after
  /// channel, an even skin's (rows, columns, channels).
  void read(const mjModel& model, mjData& data);

 private:
  struct Line {
    std::shared_ptr<const lab::PadModel> model;
    lab::ContactWidths widths;
    double greatest_depth;
    lab::SimulatedPad pad;
  };
  struct Skin {
    std::shared_ptr<const lab::SkinPadModel> model;
    double edge;
    lab::SimulatedSkinPad pad;
    std::vector<double> recorded;
  };

  [[nodiscard]] static std::variant<Line, Skin> made(const PadSettings& settings);
  void gather(const mjModel& model, const mjData& data);
  void read(Line& line, double time, std::span<double> readings);
  void read(Skin& skin, double time, std::span<double> readings);

  int sensor_;
  std::vector<bool> own_;          // of each geom
  std::vector<double> curvature_;  // of each geom [1/m]
  std::variant<Line, Skin> pad_;
  std::vector<lab::ContactPoint> points_{};
};

}  // namespace tactile_net::mujoco
