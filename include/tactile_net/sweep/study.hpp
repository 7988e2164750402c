/// @file
/// The points of a study in their one order, each with a seed that depends on it alone.
///
///     const sweep::Study study(read_study("depth.toml"));
///     for (std::size_t i = 0; i < study.points(); ++i) use(study.scene(study.point(i)));
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/scene/study_file.hpp"

namespace tactile_net::sweep {

/// The axis that only makes a point again with another seed.
inline constexpr std::string_view repeat_key = "repeat";

struct Axis {
  std::string key{};                ///< as `Setting::key`, or `repeat_key`
  std::vector<AxisValue> values{};  ///< of those that are drawn one for each draw
  bool drawn = false;
};

struct Point {
  std::size_t index = 0;            ///< from 0, in the study's order
  std::vector<AxisValue> values{};  ///< one for each axis
  /// Of the study's seed, the axes' keys and these values as text: of nothing else. < 2^53, so that
  /// every program keeps it.
  std::uint64_t seed = 0;
};

/// What a sweep's numbers are measured in.
struct SweepUnits {
  std::vector<std::string> axes{};  ///< one for each, as `SceneTemplate::NumberUnits`
  /// Of forces, "N/m" or of skins "N": all answers are in SI. "": the scene states no units.
  std::string force{};

  bool operator==(const SweepUnits&) const = default;
};

/// Ranges are written out, rounded to twelve digits, and draws are made. The axes of the file vary
/// from the last to the first, then all that are drawn together, fastest of all the repeats.
class Study {
 public:
  explicit Study(StudyFile file);

  [[nodiscard]] const std::string& file() const noexcept { return file_.file; }
  [[nodiscard]] const std::string& title() const noexcept { return file_.title; }
  /// What every point begins with.
  [[nodiscard]] const SceneTemplate& base() const noexcept { return file_.scene; }
  /// In the file's order; `repeat_key` is the last, where points are repeated.
  [[nodiscard]] const std::vector<Axis>& axes() const noexcept { return axes_; }
  [[nodiscard]] std::size_t points() const noexcept { return points_; }
  /// @pre  index < points()
  [[nodiscard]] Point point(std::size_t index) const;

  /// What its rows have beside the columns that all have.
  [[nodiscard]] const std::vector<Kept>& keep() const noexcept { return file_.keep; }

  /// Units of the axes' values and of the answers.
  [[nodiscard]] const SweepUnits& units() const noexcept { return units_; }

  /// The scene at a point. Its seeds, of noise and of all else that is drawn, are the point's; one
  /// that is an axis keeps the axis' value.
  /// @throw InputError  the reader refuses it
  [[nodiscard]] AnyScene scene(const Point& point) const;

  /// SHA-256 of all that its rows depend on: the base scene with the files that it names, and
  /// those of axes, the axes, the seed, and what is kept.
  [[nodiscard]] const std::string& hash() const noexcept { return hash_; }

 private:
  StudyFile file_;
  std::vector<Axis> axes_;
  std::size_t points_ = 1;
  SweepUnits units_;
  std::string hash_;
};

}  // namespace tactile_net::sweep
