/// @file
/// A scene as text for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::report {

/// "81 taxels, pitch 0.25, reading strain_x at depth 1.5"
[[nodiscard]] std::string sensor_in_words(const Scene& scene);
/// "1.5 mm", "1 and 1.5", of uneven taxels "1.2 mm to 1.5 mm".
/// @param channel  of its taxels; absent: of all
[[nodiscard]] std::string depths_in_words(const Scene& scene,
                                          const std::optional<Channel>& channel = {});
/// Where the tractions lie, if on a grid; else empty.
[[nodiscard]] std::string surface_in_words(const Scene& scene);
/// "the truth at the taxels"
[[nodiscard]] std::string truth_in_words(const Scene& scene);

/// "the last of 201 frames: frame 200 at t = 2": which frame of a scene with [time] is
/// reconstructed.
[[nodiscard]] std::string time_in_words(const Scene& scene);
[[nodiscard]] std::string time_in_words(const SkinScene& scene);

/// "half plane, E = 1, nu = 0.45"
[[nodiscard]] std::string material_in_words(const Scene& scene);

/// One sentence per contact: "cylinder at 0, half width 2, force 1"; empty for no contact.
[[nodiscard]] std::vector<std::string> contacts_in_words(const Scene& scene);

/// The names of the effects the scene calls for, or of those it does not, joined by commas; "none".
[[nodiscard]] std::string effects_in_words(const Scene& scene, bool simulated);

/// "saturation: 3 of 81 readings are cut off at the range's ends"
[[nodiscard]] std::string in_words(const CutOffNote& note);

}  // namespace tactile_net::report
