// Files that are no scene's readings: tables of numbers, and what times of any file are in seconds.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <fstream>

#include "read_frames.hpp"
#include "rooms.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/frame_clock.hpp"

namespace tactile_net::python {
namespace {

/// The number of the first line that is no whole row, and why.
using CutOff = std::pair<std::size_t, nb::str>;

bool ends_with_newline(std::ifstream& file) {
  file.clear();
  file.seekg(-1, std::ios::end);
  return file.get() == '\n';
}

/// The names of all columns, the rows before the first that is not whole, and where that is. In the
/// last line a number may be cut where nothing shows it: without a newline it is not whole.
std::tuple<std::vector<nb::str>, Array, std::optional<CutOff>> read_table(const std::string& path) {
  std::vector<std::string> names;
  std::vector<double> rows;
  std::optional<InputError> why;
  Watcher watcher;
  {
    const nb::gil_scoped_release released;
    std::ifstream header = frames::open_frames(path);
    names = frames::csv_columns(header, path).names;
    std::ifstream file = frames::open_frames(path);
    frames::CsvFrames source(file, path,
                             {.names = names, .accept_missing = true, .keep_infinities = true});
    std::vector<double> values(names.size());
    try {
      while (source.next(values)) {
        watcher.frame();
        rows.insert(rows.end(), values.begin(), values.end());
      }
      if (!rows.empty() && !ends_with_newline(file)) {
        why = source.refusal("the line has no end", "");
        rows.resize(rows.size() - names.size());
      }
    } catch (const InputError& error) {
      why = error;
    }
  }
  std::vector<nb::str> said;
  for (const std::string& name : names) said.push_back(readable(name));
  std::optional<CutOff> cut;
  if (why) {
    const Diagnostic& first = why->diagnostics().front();
    cut.emplace(first.line, readable(first.message));
  }
  const std::size_t count = names.empty() ? 0 : rows.size() / names.size();
  return {std::move(said), owned(std::move(rows), {count, names.size()}), std::move(cut)};
}

/// What times are in seconds, NaN where there is none, and what was taken for granted.
std::pair<Array, std::vector<std::string>> seconds(const std::vector<double>& times) {
  frames::FrameClock clock;
  std::vector<double> found;
  for (const double time : times) {
    if (std::isfinite(time))
      clock.add(time);
    else
      clock.skip();
    found.push_back(clock.seconds().value_or(unknown));
  }
  std::vector<std::string> notes;
  if (!clock.unit_known()) notes.emplace_back(times_taken_as_seconds);
  return {owned(std::move(found)), std::move(notes)};
}

}  // namespace

void bind_files(nb::module_& module) {
  module.def("read_table", &read_table, nb::arg("path"));
  module.def("seconds", &seconds, nb::arg("times"));
}

}  // namespace tactile_net::python
