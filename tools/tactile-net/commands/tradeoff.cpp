#include "commands/tradeoff.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "commands/deadline.hpp"
#include "commands/input.hpp"
#include "failure.hpp"
#include "tactile_net/frames/folder_lock.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/pages/tradeoff_page.hpp"
#include "tactile_net/report/folder.hpp"
#include "tactile_net/report/json/tradeoff_json.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"
#include "tactile_net/report/words/work_point_words.hpp"
#include "tactile_net/scene/bounded_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/study/processor.hpp"
#include "tactile_net/study/tradeoff.hpp"
#include "terminal/interruption.hpp"

namespace tactile_net::tool {
namespace {

constexpr std::uintmax_t largest_study = std::uintmax_t{256} << 20;

std::string content_of(const std::filesystem::path& path) {
  return bounded_text(path, largest_study, "is this the study's own file?");
}

/// Everything that a folder holds of a study, whole or a part. @return its files' names
std::set<std::string> write_all(const std::filesystem::path& folder, frames::Existing existing,
                                const study::Study& study, const std::string& scene_text,
                                const std::string& command) {
  drawing::Page report = pages::study_html(study, {.by = command});
  report.files.emplace_back("tradeoff.csv", report::study_csv(study));
  report.files.emplace_back("tradeoff.json", report::study_json(study, scene_text));
  report.files.emplace_back("report.html", report.html);
  for (const auto& [name, content] : report.files)
    frames::check_replaceable(folder / name, existing);
  std::set<std::string> written;
  for (const auto& [name, content] : report.files) {
    frames::write_file(folder / name, content);
    written.insert(name);
  }
  return written;
}

/// The folder of the results, made if it is not there.
void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw frames::CannotCreate(folder.string() +
                               ": error: cannot be created as a folder: " + error.message());
}

/// What the folder holds of an earlier study of this scene, with --resume.
std::vector<study::StudySection> earlier(const TradeoffOptions& options,
                                         const std::string& scene_text) {
  if (!options.resume) return {};
  const std::filesystem::path path =
      std::filesystem::path(options.results.folder) / "tradeoff.json";
  if (!std::filesystem::exists(path)) return {};
  const std::string text = content_of(path);
  try {
    return report::finished_jobs(text, scene_text, study::processor_name());
  } catch (const std::runtime_error& error) {
    throw InputError({{.file = path.string(),
                       .message = std::string("cannot be resumed: ") + error.what(),
                       .hint = "run without --resume, or into another folder"}});
  }
}

/// Says how far the study is, ends it at Ctrl-C, and writes the folder anew after each job.
class StudyWatcher final : public study::StudyObserver {
 public:
  StudyWatcher(std::filesystem::path folder, frames::Existing existing,
               const std::string& scene_text, const Streams& streams)
      : line_(streams),
        folder_(std::move(folder)),
        existing_(existing),
        scene_text_(scene_text),
        command_(streams.command) {}

  void progress(const study::StudyProgress& progress) override {
    if (line_.due()) line_.say(report::in_words(progress));
  }
  [[nodiscard]] bool stop() const override { return InterruptionAsWish::came(); }
  void save(const study::Study& study) override {
    if (folder_.empty()) return;
    written_ = write_all(folder_, existing_, study, scene_text_, command_);
    existing_ = frames::Existing::replaced;  // they are ours now
  }

  [[nodiscard]] const std::set<std::string>& written() const noexcept { return written_; }
  [[nodiscard]] Progress& line() noexcept { return line_; }

 private:
  const InterruptionAsWish interruption_;
  Progress line_;
  std::filesystem::path folder_;
  frames::Existing existing_;
  const std::string& scene_text_;
  std::string command_;
  std::set<std::string> written_;
};

study::Study study_of(const AnyScene& scene, const study::TradeoffOptions& options,
                      StudyWatcher& watcher) {
  try {
    return study::tradeoff(scene, options, watcher);
  } catch (const SimulatorError& error) {
    throw CheckFailed(std::string(error.what()) + "; --digital leaves the circuits out");
  }
}

void print(std::ostream& out, const study::Study& study, const study::Requirement& requirement) {
  out << "nothing beats these, of " << study.points().size() << " points:\n";
  report::print_cells(out, report::front_cells(study));
  out << '\n';
  if (const auto sizes = report::size_cells(study); sizes.size() > 1) {
    out << "a frame on arrays of other sizes:\n";
    report::print_cells(out, sizes);
    out << '\n';
  }
  if (const auto circuits = report::circuit_cells(study); circuits.size() > 1) {
    out << "circuits of op-amps of 10 MHz:\n";
    report::print_cells(out, circuits);
    out << '\n';
  }
  for (const std::string& sentence : report::in_words(study)) out << sentence << '\n';
  for (const std::string& failure : report::failures_in_words(study))
    out << "left out: " << failure << '\n';
  if (requirement.accuracy || requirement.deadline)
    out << "\nasked " << report::answer(study, requirement) << '\n';
}

/// @throw CheckFailed  the study was stopped, or no method meets the demand
void check(const study::Study& study, const study::Requirement& requirement, bool saved) {
  if (!study.complete)
    throw CheckFailed("stopped before the end" +
                      std::string(saved ? "; --resume continues from here" : ""));
  if ((requirement.accuracy || requirement.deadline) &&
      !study::choose(study.points(), &study::WorkPoint::error_to_solution, study::TimeOf::frame,
                     requirement)
           .point)
    throw CheckFailed("no method meets the demand");
}

}  // namespace

void run(const TradeoffOptions& options, const Streams& streams) {
  study::Requirement requirement{.accuracy = options.accuracy};
  if (options.deadline) requirement.deadline = deadline_of(*options.deadline);
  (void)study::choose({}, &study::WorkPoint::error_to_solution, study::TimeOf::frame,
                      requirement);  // checks it
  const std::filesystem::path folder = options.results.folder;
  if (options.resume && folder.empty())
    throw WrongUsage("--resume", "needs --out, the folder that holds the study's part");
  const InputText input = input_text(options.scene, streams.in);
  const std::string& scene_text = input.text;
  const AnyScene scene = parse_any_scene(scene_text, input.name);
  Results results({.json = options.results.json}, streams);  // the folder is written job by job
  study::TradeoffOptions study_options{.circuits = !options.digital,
                                       .simulator = options.simulator,
                                       .finished = earlier(options, scene_text)};
  study_options.simulator.ngspice.cancelled = InterruptionAsWish::came;
  std::optional<frames::FolderLock> lock;
  auto existing = frames::Existing::replaced;
  if (!folder.empty()) {
    existing = report::existing_in(folder, options.results.force || options.resume);
    lock.emplace(folder);
    make_folder(folder);
  }

  StudyWatcher watcher(folder, existing, scene_text, streams);
  const study::Study study = study_of(scene, study_options, watcher);
  watcher.line().clear();
  if (!folder.empty())
    say_others(streams.err, folder, frames::other_results(folder, watcher.written()));
  results.write({.print =
                     [&](std::ostream& out) {
                       print(out, study, requirement);
                       if (!folder.empty()) say_report(out, folder);
                     },
                 .json = [&] { return report::study_json(study, scene_text); }},
                watcher.line());
  check(study, requirement, !folder.empty());
}

}  // namespace tactile_net::tool
