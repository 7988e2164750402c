#include "commands/calibrate.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "commands/input.hpp"
#include "failure.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/frames/press_log_file.hpp"
#include "tactile_net/lab/calibrate.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/pages/calibration_page.hpp"
#include "tactile_net/report/json/calibration_json.hpp"
#include "tactile_net/report/words/calibration_words.hpp"
#include "tactile_net/scene/calibrated_scene.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::tool {
namespace {

constexpr std::size_t most_planned = 100;

std::optional<PadParameter> parameter_named(const std::string& text) {
  for (std::size_t i = 0; i < pad_parameter_count; ++i)
    if (name(static_cast<PadParameter>(i)) == text) return static_cast<PadParameter>(i);
  return std::nullopt;
}

PadParameter parameter_of(const char* option, const std::string& text) {
  if (const auto parameter = parameter_named(text)) return *parameter;
  throw WrongUsage(option,
                   "knows depth, thickness, poisson_ratio, youngs_modulus, crosstalk, "
                   "shift, pitch and, of skins, shift_z, with commas between them");
}

void fix(const std::vector<std::string>& names, CalibrationOptions& options) {
  for (const std::string& text : names) options.set_sd(parameter_of("--fix", text), 0.0);
}

void print(std::ostream& out, const lab::SceneCalibration& found, const std::string& log) {
  out << found.file() << ", " << log << ": "
      << (found.title().empty() ? "" : found.title() + "\n  ") << report::calibrated_in_words(found)
      << "\n\n";
  report::print_calibration(out, found);
}

/// Why a fit is not to be written; empty: it may.
std::string failure_of(const lab::SceneCalibration& found) {
  if (found.fit.verdict == FitVerdict::poor_fit) return "the fit is poor";
  if (found.fit.verdict == FitVerdict::iteration_limit) return "the fit did not converge";
  return {};
}

}  // namespace

void run(const CalibrateOptions& options, const Streams& streams) {
  const InputText text = input_text(options.scene, streams.in);
  const AnyScene scene = parse_any_scene(text.text, text.name);
  CalibrationOptions how = parse_calibration_options(text.text, text.name);
  how.robust = options.robust;
  how.profile = !options.results.folder.empty() || !options.results.json.empty();
  fix(options.fixed, how);
  std::optional<PadParameter> target;
  if (!options.target.empty()) target = parameter_of("--target", options.target);
  if (options.next && (*options.next == 0 || *options.next > most_planned))
    throw WrongUsage("--next", "plans 1 to 100 presses");
  frames::PressLogFile file = frames::read_press_log(options.log, scene, how);
  for (const std::string& note : file.notes)
    streams.err << "note: " << options.log << ": " << note << '\n';
  Results results(options.results, streams);
  std::unique_ptr<frames::OutputFile> output;
  if (!options.output.empty())
    output = std::make_unique<frames::OutputFile>(options.output, &streams.out);
  Progress progress(streams);
  lab::SceneCalibration found =
      lab::calibrate(scene, std::move(file.log), how, [&](std::size_t step) {
        if (progress.due()) progress.say("fitting, step " + std::to_string(step) + " ...");
      });
  if (options.next || target)
    lab::plan_presses(found, options.next.value_or(1), target, [&](std::size_t search) {
      if (progress.due()) progress.say("planning, search " + std::to_string(search) + " ...");
    });
  const std::string log = std::filesystem::path(options.log).filename().string();
  const std::string failure = failure_of(found);
  std::string calibrated;
  found.forced = output && !failure.empty() && options.results.force;
  if (output && (failure.empty() || found.forced))
    calibrated = calibrated_scene(text.text, scene, found.log, found.fit, log);
  Result result{.json = [&] { return report::calibration_json(found, log); },
                .page =
                    [&] {
                      return pages::calibration_html(
                          found, log, {.by = streams.command, .files = {"result.json"}});
                    }};
  if (options.output != "-") result.print = [&](std::ostream& out) { print(out, found, log); };
  results.write(result, progress);
  if (!calibrated.empty()) {
    tool::write(output.get(), calibrated);
    if (options.output != "-" && options.results.json != "-")
      streams.out << "scene: " << printable(options.output) << '\n';
  }
  if (!failure.empty())
    throw CheckFailed(failure + (!output              ? ""
                                 : calibrated.empty() ? ": nothing is written"
                                                      : ": written by --force"));
}

}  // namespace tactile_net::tool
