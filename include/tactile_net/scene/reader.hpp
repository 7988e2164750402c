/// @file
/// Reads a scene from TOML (format: docs/scene.md).
///
///     try {
///       const Scene scene = read_scene("scenes/thesis/cylinder.toml");  // examples/09_run.cpp
///     } catch (const InputError& error) {
///       std::fputs(error.what(), stderr);  // every problem, with its line and column
///     }
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

#include "tactile_net/scene/any_scene.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net {

/// @throw InputError  every problem of the file at once: not a readable regular file, larger than
///                    16 MiB, not TOML, unknown keys (with the nearest known one), wrong types,
///                    values out of range, what this version cannot simulate, a skin
[[nodiscard]] Scene read_scene(const std::filesystem::path& path);

/// As `read_scene`, from text already in memory; `file` is the name in messages.
[[nodiscard]] Scene parse_scene(std::string_view toml, const std::string& file);

/// As `read_scene`, of either kind. Which it is the table [sensor] tells: a skin has rows and
/// columns, or a file of taxels with a column z.
[[nodiscard]] AnyScene read_any_scene(const std::filesystem::path& path);
[[nodiscard]] AnyScene parse_any_scene(std::string_view toml, const std::string& file);

}  // namespace tactile_net
