/// @file
/// Faults of recordings, each with what the check calls it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/lab/checked_recording.hpp"

namespace tactile_net {

template <class Recording>
struct RecordingDefect {
  std::string name;
  std::function<void(Recording&, std::mt19937&)> plant;
  std::string expected;
  std::set<std::string> also{};  ///< what it may be taken for besides
};

/// Of a pad in SI that is pressed twice; frames are 100 a second, at least 300 of them.
///
/// @tparam Recording  `RecordedLine` or `RecordedSkin`
/// @param middle  a taxel in the middle of the pad, which feels what presses
template <class Recording>
std::vector<RecordingDefect<Recording>> recording_defects(std::size_t middle) {
  /// Another value for each reading: `to(value, frame, reading)`.
  const auto each = [](auto to) {
    return [to](Recording& r, std::mt19937&) {
      for (std::size_t k = 0; k < r.frames.size(); ++k)
        for (std::size_t i = 0; i < r.frames[k].size(); ++i)
          r.frames[k][i] = to(r.frames[k][i], static_cast<double>(k), i);
    };
  };
  /// Another value for one reading in some frames.
  const auto one = [](std::size_t taxel, auto to) {
    return [taxel, to](Recording& r, std::mt19937&) {
      for (std::size_t k = 0; k < r.frames.size(); ++k)
        r.frames[k][taxel] = to(r.frames[k][taxel], k);
    };
  };
  /// Added to each reading: white noise that is drawn once, times what a frame makes of it.
  const auto drawn_once = [](double rms, auto times) {
    return [rms, times](Recording& r, std::mt19937& random) {
      std::normal_distribution<double> white(0.0, rms);
      std::vector<double> sizes(r.frames[0].size());
      for (double& value : sizes) value = white(random);
      for (std::size_t k = 0; k < r.frames.size(); ++k)
        for (std::size_t i = 0; i < sizes.size(); ++i)
          r.frames[k][i] += sizes[i] * times(static_cast<double>(k));
    };
  };
  std::vector<RecordingDefect<Recording>> all{
      {"kPa for Pa", each([](double g, auto, auto) { return 1e-3 * g; }), "scale_by_1000"},
      {"mPa for Pa", each([](double g, auto, auto) { return 1e3 * g; }), "scale_by_1000"},
      {"sign", each([](double g, auto, auto) { return -g; }), "whole_pad_pulled"},
      {"dead", one(middle, [](double, auto) { return 0.0; }), "dead_taxels"},
      {"cut wire: noise and no signal",
       [middle](Recording& r, std::mt19937& random) {
         std::normal_distribution<double> white(0.0, pad_noise);
         for (auto& frame : r.frames) frame[middle] = white(random);
       },
       "dead_taxels"},
      {"noisy",
       [](Recording& r, std::mt19937& random) {
         std::normal_distribution<double> white(0.0, 8.0 * pad_noise);
         for (auto& frame : r.frames) frame[3] += white(random);
       },
       "noisy_taxels"},
      {"single frames of one taxel",
       one(4,
           [](double g, std::size_t k) {
             if (k == 30 || k == 110 || k == 222) return g + 60.0 * pad_noise;
             return k == 280 ? g - 80.0 * pad_noise : g;
           }),
       "single_frame_spikes"},
      {"stuck from the start", one(4, [](double, auto) { return 123.0; }), "stuck_taxels"},
      {"stuck from frame 200 on",
       one(4, [](double g, std::size_t k) { return k < 200 ? g : 77.0; }), "stuck_taxels"},
      {"stuck at rest, before anything presses",
       [middle](Recording& r, std::mt19937&) {
         for (std::size_t k = 40; k < r.frames.size(); ++k)
           r.frames[k][middle] = r.frames[40][middle];
       },
       "stuck_taxels"},
      {"saturated", each([](double g, auto, auto) { return std::min(g, 3000.0); }),
       "saturated_taxels"},
      {"baseline of each taxel", drawn_once(15.0 * pad_noise, [](double) { return 1.0; }),
       "baseline"},
      {"baseline of all taxels", each([](double g, auto, auto) { return g + 10.0 * pad_noise; }),
       "baseline"},
      {"drift of each taxel", drawn_once(30.0 * pad_noise, [](double k) { return k / 400.0; }),
       "drift"},
      {"drift of all taxels",
       each([](double g, double k, auto) { return g + 30.0 * pad_noise * k / 400.0; }), "drift"},
      {"noise of 3 times",
       [](Recording& r, std::mt19937& random) {
         std::normal_distribution<double> white(0.0, std::sqrt(8.0) * pad_noise);
         for (auto& frame : r.frames)
           for (double& value : frame) value += white(random);
       },
       "noise_differs"},
      {"noise that remembers",
       [](Recording& r, std::mt19937& random) {
         std::normal_distribution<double> white(0.0, pad_noise);
         std::vector<double> state(r.frames[0].size());
         for (auto& frame : r.frames)
           for (std::size_t i = 0; i < frame.size(); ++i)
             frame[i] += state[i] = 0.8 * state[i] + white(random);
       },
       "noise_coloured"},
      {"missing",
       [](Recording& r, std::mt19937&) {
         r.frames[5][2] = r.frames[200][3] = std::numeric_limits<double>::quiet_NaN();
       },
       "values_missing"},
      {"rows twice", [](Recording& r, std::mt19937&) { r.frames[17] = r.frames[16]; },
       "frames_repeat"},
  };
  if constexpr (std::is_same_v<Recording, RecordedLine>) {
    const auto scene = [](auto change) {
      return [change](Recording& r, std::mt19937&) { change(r.scene); };
    };
    all.push_back({"pitch in mm, E in Pa", scene([](Scene& s) {
                     s.sensor.pitch *= 1e3;
                     for (double& depth : s.sensor.depths) depth *= 1e3;
                     s.reconstruct.smoothing_length *= 1e3;
                   }),
                   "mixed_units"});
    all.push_back({"E in MPa, readings in Pa",
                   scene([](Scene& s) { s.material.youngs_modulus = 0.2; }),
                   "mixed_units",
                   {"traction_exceeds_modulus"}});
    all.push_back({"depth in mm",
                   scene([](Scene& s) { s.sensor.depths = {1.5}; }),
                   "depth_beyond_array",
                   {"traction_exceeds_modulus"}});
    all.push_back({"pitch in mm",
                   scene([](Scene& s) { s.sensor.pitch = 0.5; }),
                   "pitch_coarse",
                   {"mixed_units", "deformation_tiny"}});
  }
  return all;
}

}  // namespace tactile_net
