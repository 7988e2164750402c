/// @file
/// What a log of presses must know of its scene, a line's or a skin's. Private.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/calibration/press_log.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/sensing/calibration.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net::frames {

/// Where a press is in the sensor's axes, of a curved skin.
inline constexpr std::array place_columns = {"place_x", "place_y", "place_z"};

struct LogSensor {
  explicit LogSensor(const AnyScene& scene);

  bool is_skin = false;
  std::shared_ptr<const CurvedSkin> curved{};  ///< of a curved skin
  bool by_place = false;  ///< a curved skin's presses are stated in the sensor's axes
  Units units{};
  Unit force{};  ///< of a rod's force per length, or of a ball's force
  SignalLayout layout{};
  std::vector<std::string> readings{};  ///< their columns
  std::vector<std::string> channels{};
  std::vector<bool> dead{};  ///< of each reading
  struct End {
    double low = 0.0, high = 0.0;
  };
  End y{}, z{};        ///< where taxels lie [m]
  double depth = 0.0;  ///< of the deepest taxel [m]
  std::optional<Calibration> calibration{};
  Material material{};
  bool has_contacts = false;

  /// Columns that a press is described by, besides those that may be left out.
  [[nodiscard]] std::vector<std::string> described() const;
  [[nodiscard]] std::vector<std::string> optional_columns() const;
  /// "press,shape,..." as a header begins.
  [[nodiscard]] std::string header() const;

  /// Sets the press' shape. @return  false: there is none of that name here
  bool set_shape(std::string_view text, Press& press) const;
  [[nodiscard]] std::string_view shapes() const noexcept;       ///< a list, and what else is said
  [[nodiscard]] std::string_view round_shape() const noexcept;  ///< that which has a radius
  [[nodiscard]] bool is_round(const Press& press) const noexcept;
  /// Of the contact of a rod or a ball [m]. @pre  its force and its radius are stated
  [[nodiscard]] double half_width(const Press& press) const;
};

}  // namespace tactile_net::frames
