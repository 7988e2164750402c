/// @file
/// A study: a scene, and the values that some of its keys take in turn (format: docs/sweeps.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/kept.hpp"
#include "tactile_net/scene/scene_template.hpp"

namespace tactile_net {

/// More points than these are a mistake in the file.
inline constexpr std::size_t most_points = 1'000'000;

/// How values lie between two ends: equal steps, or equal ratios.
enum class AxisScale { linear, log };
/// Where values that are drawn come from.
enum class DrawKind { random, sobol };

[[nodiscard]] std::string_view name(AxisScale scale) noexcept;
[[nodiscard]] std::string_view name(DrawKind kind) noexcept;

/// A value that stands in the file.
struct AxisValue {
  std::string toml{};   ///< on one line; numbers with as many digits as they need
  std::string plain{};  ///< the same, of a text without its quotes

  bool operator==(const AxisValue&) const = default;
};

/// Values between two ends, both included.
struct AxisRange {
  double from = 0.0;
  double to = 0.0;
  AxisScale scale = AxisScale::linear;
  bool whole = false;     ///< rounded to whole numbers
  std::size_t count = 0;  ///< 0: they are drawn, as many as the study says
};

struct StudyAxis {
  std::string key{};  ///< as `Setting::key`
  std::variant<std::vector<AxisValue>, AxisRange> values{};

  [[nodiscard]] bool drawn() const noexcept {
    const auto* range = std::get_if<AxisRange>(&values);
    return range != nullptr && range->count == 0;
  }
};

struct StudyFile {
  std::string file{};  ///< name of the file, without its folder
  std::string title{};
  SceneTemplate scene;
  std::uint64_t seed = 1;
  std::size_t repeats = 1;  ///< of every point, with seeds of their own
  DrawKind draw = DrawKind::sobol;
  std::size_t draws = 0;  ///< how many; 0: no axis is drawn
  std::vector<StudyAxis> axes{};
  std::vector<Kept> keep = kept_by_default();  ///< in the order of `Kept`, none twice
};

struct StudyOptions {
  /// Whether the study may name a scene elsewhere than beside its own file and below.
  bool allow_outside = false;
};

/// @throw InputError  every problem of the file at once, as `read_scene`; its scene is none, or has
///                    no such key as an axis; it makes no point, or more than `most_points`
[[nodiscard]] StudyFile read_study(const std::filesystem::path& path,
                                   const StudyOptions& options = {});

}  // namespace tactile_net
