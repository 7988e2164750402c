/// @file
/// Recordings of a pad's lattice of taxels, for tests of what a check finds in them.
#pragma once

#include <cstddef>
#include <string>
#include <variant>

#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/lab/checked_recording.hpp"

namespace tactile_net {

inline constexpr std::size_t taxel_columns = 6;

/// A silicone pad of 7 x 6 taxels in SI, pressed twice between idle times, or all the time.
inline std::string skin_pad(const std::string& reads, bool held) {
  return "[sensor]\nrows = 7\ncolumns = 6\npitch = 1e-3\ndepth = 1.5e-3\nreads = [" + reads +
         "]\n[material]\nyoungs_modulus = 0.2e6\npoisson_ratio = 0.45\n[noise]\nrms = 30.0\n"
         "[time]\nrate = 100.0\nframes = 300\n[[contact]]\nshape = \"sphere\"\n"
         "place = [0.4e-3, -0.3e-3]\nradius = 2e-3\n" +
         (reads.size() > 12 ? "friction = 0.2\n" : "") +
         (held ? "force = 0.3\n"
               : "trajectory = [{ t = 0.5, force = 1e-6 }, { t = 0.8, force = 0.4 }, "
                 "{ t = 1.2, force = 0.4 }, { t = 1.5, force = 1e-6 }, { t = 1.9, force = 1e-6 }, "
                 "{ t = 2.1, force = 0.3 }, { t = 2.3, force = 1e-6 }]\n");
}

inline RecordedSkin recorded_skin(const std::string& toml) {
  return record_with<lab::SkinRecording>(std::get<SkinScene>(parse_any_scene(toml, "skin.toml")));
}

}  // namespace tactile_net
