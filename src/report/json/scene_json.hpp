/// @file
/// How the JSON documents of a scene begin, and numbers with a deviation in all of them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "report/json/described.hpp"
#include "tactile_net/scene/any_scene.hpp"

namespace tactile_net::report {

struct EffectsTold {
  std::vector<std::string_view> simulated{};
  std::vector<std::string_view> absent{};

  static constexpr auto described =
      std::tuple{field("simulated", &EffectsTold::simulated, "Those that the scene has."),
                 field("absent", &EffectsTold::absent, "Those that it does not have.")};
};

/// The units of a document's numbers, and those of the scene's file.
struct UnitsTold {
  struct Stated {
    std::string_view length{}, modulus{}, stress{}, force{};

    static constexpr auto described =
        std::tuple{field("length", &Stated::length, "Of lengths."),
                   field("modulus", &Stated::modulus, "Of Young's modulus."),
                   field("stress", &Stated::stress, "Of readings that are stresses."),
                   field("force", &Stated::force, "Of loads.")};
  };
  std::string_view length{}, stress{}, force{};
  Stated stated{};

  static constexpr auto described =
      std::tuple{field("length", &UnitsTold::length, "Of lengths."),
                 field("stress", &UnitsTold::stress, "Of stresses, tractions and moduli."),
                 field("force", &UnitsTold::force, "Of loads."),
                 field("stated", &UnitsTold::stated, "What the scene's file is in.")};
};

/// Which frame of a scene over time a document is of.
struct FrameTold {
  std::size_t index = 0;
  std::size_t of = 1;
  double t = 0.0;

  static constexpr auto described =
      std::tuple{field("index", &FrameTold::index, "Its number, from 0."),
                 field("of", &FrameTold::of, "How many frames the scene has."),
                 field("t", &FrameTold::t, Measure::time, "Its time.")};
};

/// How a document of a scene begins.
struct SceneTold {
  std::string scene{};
  EffectsTold effects{};
  IfAny<UnitsTold> units{};

  static constexpr auto described =
      std::tuple{field("scene", &SceneTold::scene,
                       "The scene's file; <stdin> where it came from standard input."),
                 field("effects", &SceneTold::effects,
                       "What a sensor's readings may suffer, in the order of the signal path."),
                 field("units", &SceneTold::units,
                       "The units of these numbers; only of a scene with [units].")};
};

/// The same of a document of one frame.
struct SceneFrameTold : SceneTold {
  IfAny<FrameTold> frame{};

  static constexpr auto described = std::tuple_cat(
      SceneTold::described,
      std::tuple{field("frame", &SceneFrameTold::frame,
                       "The frame that was reconstructed; only of a scene with [time].")});
};

[[nodiscard]] SceneFrameTold scene_told(const Scene& scene);
[[nodiscard]] SceneFrameTold scene_told(const SkinScene& scene);
[[nodiscard]] SceneFrameTold scene_told(const AnyScene& scene);

/// Those that a scene states; absent: it states none.
/// @param load  what a load is: `load_dimension`
[[nodiscard]] IfAny<UnitsTold> units_told(const std::optional<Units>& units, Dimension load);

}  // namespace tactile_net::report
