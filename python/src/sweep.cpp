// A scene at many values, on the processors of this machine or point by point, and files of rows.
#include "tactile_net/sweep/sweep.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <tuple>
#include <variant>

#include "arrays.hpp"
#include "page_folder.hpp"
#include "readable.hpp"
#include "rooms.hpp"
#include "simulated_frames.hpp"
#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/pages/sweep_page.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/report/json/sweep_json.hpp"
#include "tactile_net/report/words/sweep_words.hpp"
#include "tactile_net/scene/scene_template.hpp"
#include "watcher.hpp"

namespace tactile_net::python {
namespace {

/// Ctrl-C ends a sweep within a fifth of a second: what is done is kept.
class SweepWatcher final : public sweep::Observer {
 public:
  explicit SweepWatcher(const nb::object& progress) : progress_(progress) {}

  void progress(const sweep::Progress& progress) override {
    const nb::gil_scoped_acquire held;
    if (!progress_.is_none()) progress_(report::in_words(progress));
  }
  /// @throw nb::python_error  a signal's handler has raised
  [[nodiscard]] bool stop() const override {
    const nb::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    return false;
  }

 private:
  const nb::object& progress_;  // not counted: the GIL is not held where this ends
};

/// @param end  absent: up to the last point
sweep::PointRange range_of(std::size_t first, std::optional<std::size_t> end) {
  return {first, end.value_or(most_points)};
}

sweep::Progress run_sweep(const std::string& study, const std::string& file,
                          std::optional<std::size_t> jobs, std::size_t first,
                          std::optional<std::size_t> end, bool allow_outside,
                          const nb::object& progress) {
  SweepWatcher watcher(progress);
  const nb::gil_scoped_release released;
  return sweep::sweep(sweep::Study(read_study(study, {allow_outside})), file,
                      {.jobs = jobs.value_or(0), .points = range_of(first, end)}, watcher);
}

sweep::Table merge(const std::vector<std::string>& files, std::size_t first,
                   std::optional<std::size_t> end) {
  const nb::gil_scoped_release released;
  return sweep::merge(std::vector<std::filesystem::path>(files.begin(), files.end()),
                      range_of(first, end));
}

/// A study gone through point by point: what each point's sensor reads, or its rows.
class StudyPoints {
 public:
  StudyPoints(const std::string& path, bool allow_outside)
      : study_(read_study(path, {allow_outside})) {}

  [[nodiscard]] const sweep::Study& study() const noexcept { return study_; }

  /// The files beside the scene's own that the points depend on.
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names = study_.base().files();
    for (const sweep::Axis& axis : study_.axes())
      if (std::find(file_keys.begin(), file_keys.end(), axis.key) != file_keys.end())
        for (const AxisValue& value : axis.values) names.push_back(value.plain);
    for (std::string& name : names) name = (study_.base().file().parent_path() / name).string();
    return names;
  }

  /// The lines of these points in a file of rows.
  [[nodiscard]] std::string rows(const std::vector<std::size_t>& indices) const {
    const nb::gil_scoped_release released;
    const auto simulator = lab::make_simulator();
    std::string text;
    for (const std::size_t index : indices)
      text += sweep::lines(sweep::solve(study_, index, *simulator), study_.keep());
    return text;
  }

  /// @return  values of the axes, seed, readings, truth, and why there are none: a row for each
  /// frame
  [[nodiscard]] std::tuple<std::vector<nb::str>, std::uint64_t, Array, Array, nb::str> simulate(
      std::size_t index) const {
    const sweep::Point point = study_.point(index);
    SimulatedFrames all;
    std::string failure;
    {
      Watcher watcher;
      const nb::gil_scoped_release released;
      try {
        all = std::visit([&](const auto& scene) { return simulated_frames(scene, watcher); },
                         study_.scene(point));
      } catch (const InputError& error) {
        for (const Diagnostic& one : error.diagnostics())
          failure += (failure.empty() ? "" : "; ") + one.message;
      } catch (const std::invalid_argument& error) {
        failure = error.what();
      } catch (const std::runtime_error& error) {
        failure = error.what();
      }
    }
    std::vector<nb::str> values;
    for (const AxisValue& value : point.values) values.push_back(readable(value.plain));
    const std::size_t frames = all.count();
    const std::size_t readings = frames == 0 ? 0 : all.readings.size() / frames;
    const std::size_t tractions = frames == 0 ? 0 : all.truth.size() / frames;
    return {std::move(values), point.seed, owned(std::move(all.readings), {frames, readings}),
            owned(std::move(all.truth), {frames, tractions}), readable(failure)};
  }

 private:
  sweep::Study study_;
};

/// The points that a file of rows lacks.
std::vector<std::size_t> missing(const sweep::RowsFile& file, std::size_t first,
                                 std::optional<std::size_t> end) {
  std::vector<std::size_t> indices;
  const sweep::Rows& rows = file.rows();
  for (std::size_t i = first; i < range_of(first, end).end_in(rows.head().points); ++i)
    if (!rows.has(i)) indices.push_back(i);
  return indices;
}

void write_sweep_report(const sweep::Table& table, const std::string& json,
                        const std::string& folder, bool force) {
  const nb::gil_scoped_release released;
  drawing::Page page = pages::sweep_page(table, {.files = {"results.csv", "result.json"}});
  page.files.emplace_back("results.csv", table.csv);
  write_page({.path = folder, .force = force}, page, "result.json", json);
}

}  // namespace

void bind_sweep(nb::module_& module) {
  nb::class_<sweep::Progress>(module, "SweepProgress")
      .def_ro("points", &sweep::Progress::points)
      .def_ro("done", &sweep::Progress::done)
      .def_ro("earlier", &sweep::Progress::earlier);
  nb::class_<sweep::Table>(module, "SweepTable")
      .def_ro("title", &sweep::Table::title)
      .def_ro("axes", &sweep::Table::axes)
      .def_ro("points", &sweep::Table::points)
      .def_prop_ro("units", [](const sweep::Table& self) { return self.units.axes; })
      .def("json", &report::sweep_json, nb::arg("resumed").none())
      .def_ro("csv", &sweep::Table::csv)
      .def_ro("sha256", &sweep::Table::sha256)
      .def("cells", &report::method_cells)
      .def("report", &write_sweep_report);
  nb::class_<StudyPoints>(module, "StudyPoints")
      .def(nb::init<const std::string&, bool>(), nb::arg("path"), nb::arg("allow_outside"))
      .def_prop_ro("points", [](const StudyPoints& self) { return self.study().points(); })
      .def_prop_ro("title", [](const StudyPoints& self) { return self.study().title(); })
      .def_prop_ro("hash", [](const StudyPoints& self) { return self.study().hash(); })
      .def_prop_ro("axes",
                   [](const StudyPoints& self) {
                     std::vector<std::string> keys;
                     for (const sweep::Axis& axis : self.study().axes()) keys.push_back(axis.key);
                     return keys;
                   })
      .def_prop_ro("scene_text", [](const StudyPoints& self) { return self.study().base().text(); })
      .def_prop_ro("scene_file",
                   [](const StudyPoints& self) { return self.study().base().file().string(); })
      .def_prop_ro("values",
                   [](const StudyPoints& self) {
                     std::vector<std::vector<nb::str>> all;
                     for (const sweep::Axis& axis : self.study().axes()) {
                       all.emplace_back();
                       for (const AxisValue& value : axis.values)
                         all.back().push_back(readable(value.plain));
                     }
                     return all;
                   })
      .def_prop_ro("files", &StudyPoints::files)
      .def("rows", &StudyPoints::rows, nb::arg("indices"))
      .def("simulate", &StudyPoints::simulate, nb::arg("index"));
  nb::class_<sweep::RowsFile>(module, "RowsFile")
      .def(
          "__init__",
          [](sweep::RowsFile* self, const StudyPoints& study, const std::string& path) {
            new (self) sweep::RowsFile(study.study(), path);
          },
          nb::arg("study"), nb::arg("path"))
      .def("missing", &missing, nb::arg("first"), nb::arg("end").none())
      .def("append", &sweep::RowsFile::append, nb::arg("lines"))
      .def("close", &sweep::RowsFile::close);
  module.attr("instructions") = name(widest_instruction_set());
  module.def("sweep", &run_sweep, nb::arg("study"), nb::arg("file"), nb::arg("jobs").none(),
             nb::arg("first"), nb::arg("end").none(), nb::arg("allow_outside"),
             nb::arg("progress").none());
  module.def("merge", &merge, nb::arg("files"), nb::arg("first") = 0,
             nb::arg("end").none() = nb::none());
}

}  // namespace tactile_net::python
