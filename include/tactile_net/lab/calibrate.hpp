/// @file
/// A scene and a log of presses: what the scene should have said.
///
///     const CalibrationOptions stated = parse_calibration_options(text, file);
///     const lab::SceneCalibration found = lab::calibrate(scene, log, stated);
///     report::print_calibration(std::cout, found);
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/calibration/next_press.hpp"
#include "tactile_net/calibration/press_fit.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::lab {

struct SceneCalibration {
  AnyScene scene{};  ///< the nominal one
  CalibrationOptions options{};
  PressLog log{};
  PressFit fit{};
  NextPresses next{};                    ///< none where not asked for
  std::optional<PadParameter> target{};  ///< that they are to tell; none: readings
  /// How much less the sum of squares, priors included, would be were the layer on the other base:
  /// slipping where the scene says bonded. None without a layer, of robust fits, or where either
  /// did not converge.
  std::optional<double> other_base_gain{};
  double spread = 0.0;  ///< of the presses' centres, the farthest two along y or z [m]
  bool forced = false;  ///< the fit failed, and its scene is written all the same
  std::vector<std::string> readings{};  ///< of each reading its column's name
  std::vector<Site> sites{};            ///< of each reading
  std::vector<Channel> channels{};

  [[nodiscard]] bool is_skin() const noexcept { return std::holds_alternative<SkinScene>(scene); }
  [[nodiscard]] const std::string& file() const;
  [[nodiscard]] const std::string& title() const;
  [[nodiscard]] const std::optional<Units>& units() const;
  [[nodiscard]] const Material& material() const;
};

/// The scene's own [crosstalk] is part of the model, its dead taxels are left out.
///
/// @param watch  as `fit_presses` has it
/// @throw std::invalid_argument  as `fit_presses`
[[nodiscard]] SceneCalibration calibrate(const AnyScene& scene, PressLog log,
                                         const CalibrationOptions& options,
                                         const std::function<void(std::size_t)>& watch = {});

/// Fills `next`.
/// @param watch  as `next_presses` has it
/// @throw std::invalid_argument  as `next_presses`
void plan_presses(SceneCalibration& found, std::size_t count,
                  std::optional<PadParameter> target = {},
                  const std::function<void(std::size_t)>& watch = {});

}  // namespace tactile_net::lab
