/// @file
/// Files of frames, as any scene reads them.
#pragma once

#include <nanobind/nanobind.h>

#include <istream>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "readable.hpp"
#include "tactile_net/frames/open.hpp"
#include "watcher.hpp"

namespace tactile_net::python {

/// What is said of times whose unit nothing tells.
inline constexpr const char* times_taken_as_seconds =
    "times are whole numbers of no stated unit, and are taken as seconds: where they are not, name "
    "their column t_ms, t_us or t_ns";

/// t or None, the readings of every frame, and what was taken for granted.
using ReadFrames = std::tuple<std::optional<Array>, Array, std::vector<nb::str>>;

/// @param shared  a `SharedScene` or a `SharedSkin`
template <class Any>
ReadFrames read_all(const Any& shared, const std::string& path, std::istream* standard_input,
                    const frames::ReadingsOptions& options) {
  std::vector<double> t;
  std::vector<double> readings;
  std::vector<std::string> notes;
  const std::size_t width = reading_count(shared.scene().sensor);
  std::size_t frames = 0;
  Watcher watcher;
  {
    const nb::gil_scoped_release released;
    frames::ReadingsFile file(path, shared.scene(), standard_input, options);
    frames::FrameSource& source = file.source();
    std::vector<double> frame(width);
    while (source.next(frame)) {
      watcher.frame();
      readings.insert(readings.end(), frame.begin(), frame.end());
      if (source.has_time()) t.push_back(source.seconds().value_or(unknown));
      ++frames;
    }
    notes.assign(source.opening_notes().begin(), source.opening_notes().end());
    for (std::string& note : source.closing_notes()) notes.push_back(std::move(note));
    if (!source.time_unit_known()) notes.emplace_back(times_taken_as_seconds);
  }
  std::optional<Array> times;
  if (!t.empty()) times = owned(std::move(t));
  std::vector<nb::str> said;  // a file's own names may be no UTF-8
  for (const std::string& note : notes) said.push_back(readable(note));
  return {std::move(times), owned(std::move(readings), {frames, width}), std::move(said)};
}

template <class Any>
ReadFrames read(const Any& self, const std::string& path, const std::string& columns,
                bool accept_missing) {
  return read_all(self, path, nullptr, {.columns = columns, .accept_missing = accept_missing});
}

/// The same of a .npy file in memory; messages call it <stdin>.
template <class Any>
ReadFrames take(const Any& self, const nb::bytes& npy) {
  std::istringstream in(std::string(npy.c_str(), npy.size()));
  return read_all(self, "-", &in, {.accept_missing = true});
}

template <class Any>
Array raw(const Any& self, const Rows& readings) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < readings.shape(0); ++i) {
    const std::vector<double> one = raw_numbers(self.scene(), row(readings, i));
    numbers.insert(numbers.end(), one.begin(), one.end());
  }
  return owned(std::move(numbers), {readings.shape(0), readings.shape(1)});
}

}  // namespace tactile_net::python
