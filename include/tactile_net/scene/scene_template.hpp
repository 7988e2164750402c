/// @file
/// A scene whose values are still open: its text, and what stands in it in place of some of them.
///
///     const SceneTemplate pad(input_text("pad.toml"), "pad.toml");
///     const AnyScene deeper = pad.with(std::vector<Setting>{{"sensor.depth", "2e-3"}});
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/scene/reader.hpp"

namespace tactile_net {

/// One value of a scene.
struct Setting {
  /// Its dotted path: "sensor.depth", or "contact.0.force", since contacts are counted from 0.
  std::string_view key;
  std::string_view value;  ///< TOML, as it stands behind the `=`
};

/// Keys of a scene whose values are files beside it.
inline constexpr std::array<std::string_view, 2> file_keys{"sensor.taxels", "calibration.file"};

class SceneTemplate {
 public:
  /// @param file  its path: files that it names are relative to its folder
  /// @throw InputError  it is not TOML
  SceneTemplate(std::string text, std::filesystem::path file);

  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

  /// The scene with these values in place of its own; tables that are missing are made.
  ///
  /// @throw InputError  as `read_any_scene`; a setting has no place in it, or is not TOML
  [[nodiscard]] AnyScene with(std::span<const Setting> settings) const;

  /// What the text itself names of `file_keys`, as it names it.
  [[nodiscard]] std::vector<std::string> files() const;

  /// What numbers are measured in.
  struct NumberUnits {
    /// Of the settings' keys, as the scene states it: "mm"; "" where it states none, or there is
    /// none, or the key holds more than one.
    std::vector<std::string> settings{};
    /// SI's of a load, "N/m" or on a skin "N", where the scene has [units]: answers are in SI
    /// then. Else "".
    std::string force{};
  };
  [[nodiscard]] NumberUnits units(std::span<const Setting> settings) const;

  /// Why no scene has that key.
  struct Objection {
    std::string message{};
    std::string hint{};
  };
  /// Nothing: a scene may have it, whatever the value.
  /// @param settings  the key's, and those of others
  [[nodiscard]] std::optional<Objection> objection(std::string_view key,
                                                   std::span<const Setting> settings) const;
  /// @throw InputError  the file itself has keys that no scene has
  void check_keys(std::span<const Setting> settings) const;

 private:
  std::string text_;
  std::filesystem::path file_;
};

}  // namespace tactile_net
