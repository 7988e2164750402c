/// @file
/// Recordings of a pad's line of taxels, for tests of what a check finds in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/lab/checked_recording.hpp"

namespace tactile_net {

/// A silicone pad in SI; what touches it is somebody's `contact`.
inline std::string line_pad(std::size_t count, const std::string& reads, const std::string& contact,
                            std::uint64_t seed) {
  const bool strains = reads.find("strain") != reads.npos;
  return "[sensor]\ncount = " + std::to_string(count) +
         "\npitch = 0.5e-3\ndepth = 1.5e-3\nreads = [" + reads +
         "]\n[material]\nyoungs_modulus = 0.2e6\npoisson_ratio = 0.45\n[noise]\nrms = " +
         (strains ? "150e-6" : "30.0") + "\nseed = " + std::to_string(seed) +
         "\n[time]\nrate = 100.0\nframes = 400\n" + contact;
}

inline const std::string cylinder = "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.5e-3\n";
/// Two presses between idle times.
inline const std::string presses =
    cylinder +
    "trajectory = [{ t = 0.5, force = 0.0 }, { t = 0.8, force = 40.0 }, { t = 1.2, force = 40.0 }, "
    "{ t = 1.5, force = 0.0 }, { t = 2.4, force = 0.0 }, { t = 2.6, force = 25.0 }, "
    "{ t = 2.8, force = 0.0 }]\n";
/// Never let go, never at rest.
inline const std::string slides =
    cylinder +
    "force = 30.0\ntrajectory = [{ t = 0.0, center = -0.8e-3 }, { t = 2.0, center = 0.8e-3 }, "
    "{ t = 4.0, center = -0.8e-3 }]\n";
inline const std::string holds = cylinder + "force = 30.0\n";
inline const std::string idles;

inline RecordedLine recorded_line(const std::string& toml) {
  return record_with<lab::SensorRecording>(parse_scene(toml, "pad.toml"));
}

}  // namespace tactile_net
