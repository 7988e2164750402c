/// @file
/// Scenes and hands by the name of their file, or from standard input.
#pragma once

#include <iosfwd>
#include <string>

#include "tactile_net/scene/reader.hpp"
#include "tactile_net/scene/space_hand.hpp"

namespace tactile_net::tool {

/// "-", and the names that the system has for it.
[[nodiscard]] bool is_standard_input(const std::string& path);

/// A file's text, and what messages call it: "<stdin>" where it is standard input.
struct InputText {
  std::string text{};
  std::string name{};
};

/// @param in  read to its end where the path is standard input's
/// @throw InputError  as `tactile_net::input_text`
[[nodiscard]] InputText input_text(const std::string& path, std::istream& in);

/// A scene from standard input names files relative to the current folder, and so does a hand.
/// @throw InputError  as `tactile_net::read_scene` and `tactile_net::read_any_hand`
[[nodiscard]] Scene read_scene(const std::string& path, std::istream& in);
[[nodiscard]] AnyScene read_any_scene(const std::string& path, std::istream& in);
[[nodiscard]] AnyHand read_any_hand(const std::string& path, std::istream& in,
                                    const HandOptions& options);

/// @throw WrongUsage  both are to come from standard input
void check_one_standard_input(const std::string& scene, const std::string& readings);

}  // namespace tactile_net::tool
