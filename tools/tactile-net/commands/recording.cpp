#include "commands/recording.hpp"

#include <filesystem>
#include <ostream>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "commands/input.hpp"
#include "scene/excerpt.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/broken_taxels.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/report/words/check_words.hpp"

namespace tactile_net::tool {

void say_opening(std::ostream& err, const std::string& name, const frames::FrameSource& source) {
  for (const std::string& note : source.opening_notes())
    err << name << ": note: " << printable(note) << '\n';
  const auto ignored = source.ignored();
  if (!ignored.empty())
    err << name << ": note: " << counted(ignored.size(), "column")
        << (ignored.size() == 1 ? " is" : " are") << " not read by this scene, '"
        << printable(ignored.front()) << (ignored.size() == 1 ? "'\n" : "' first\n");
}

void say_closing(std::ostream& err, const std::string& name, const frames::FrameSource& source) {
  for (const std::string& note : source.closing_notes())
    err << name << ": note: " << printable(note) << '\n';
}

void say_times_without_unit(std::ostream& err, const std::string& name) {
  err << name << ": note: times are whole numbers of no stated unit: the page and JSON count "
      << "frames in their place\nhint: name the column t_s, t_ms, t_us or t_ns\n";
}

void say_findings(std::ostream& err, Method method, const lab::Findings& findings,
                  const AnyScene& scene) {
  for (const lab::Finding& one : findings)
    err << name(method) << ": note: " << report::in_words(one, scene)
        << "\nhint: " << report::advice(one, scene) << "; tactile-net check says more\n";
}

bool come_once(const std::string& readings) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(readings, none);
  return is_standard_input(readings) ||
         (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status));
}

std::optional<lab::ReadingsCheck> first_look(const AnyScene& scene, const std::string& readings,
                                             const std::string& columns) {
  if (come_once(readings)) return std::nullopt;
  try {
    const frames::ReadingsOptions options{.columns = columns, .accept_missing = true};
    frames::ReadingsFile file = std::visit(
        [&](const auto& one) { return frames::ReadingsFile(readings, one, nullptr, options); },
        scene);
    return lab::first_look(scene,
                           [&](std::span<double> frame) { return file.source().next(frame); });
  } catch (const InputError&) {
    return std::nullopt;
  }
}

InputError with_frames_before(const InputError& error, std::size_t frames,
                              const std::string& partial) {
  std::vector<Diagnostic> diagnostics = error.diagnostics();
  std::string& hint = diagnostics.back().hint;
  if (!hint.empty()) hint += "; ";
  hint += std::to_string(frames) +
          (frames == 1 ? " frame before it was" : " frames before it were") + " written" +
          (partial.empty() ? "" : " to " + partial);
  return InputError(std::move(diagnostics));
}

}  // namespace tactile_net::tool
