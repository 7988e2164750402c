#include "tactile_net/lab/tradeoff.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "commands/commands.hpp"
#include "tactile_net/frames/failure.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/json/tradeoff_json.hpp"
#include "tactile_net/report/pages/tradeoff_page.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"
#include "terminal/interruption.hpp"
#include "terminal/progress.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string out;
  std::string json;
  std::optional<std::string> deadline;
  std::optional<double> accuracy;
  bool digital = false;
  bool resume = false;
  lab::SimulatorChoice simulator{.time_limit = 60.0};
};

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What is done, and how long the rest takes at that pace.
class Pace {
 public:
  explicit Pace(const std::vector<lab::StudyJob>& jobs) {
    for (const lab::StudyJob& job : jobs) total_ += job.weight;
  }
  void done(const lab::StudyJob& job) { done_ += job.weight; }
  [[nodiscard]] std::string text(const std::string& what) const {
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    std::string line = brief(100.0 * done_ / total_) + " %, " + what;
    if (done_ > 0.0)
      line += ", about " + duration(std::ceil(elapsed / done_ * (total_ - done_))) + " left";
    return line;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  double total_ = 0.0;
  double done_ = 0.0;
};

/// What failed is tried again: ngspice may be there by now, or have more time.
bool whole(const lab::StudySection& section) {
  return std::all_of(section.points.begin(), section.points.end(),
                     [](const lab::WorkPoint& point) { return point.measured(); });
}

/// Runs the jobs that are left; `save` after each, by the thread that has done it. Circuits run two
/// at a time, arithmetic alone: it is timed, and nothing is drawn meanwhile.
class Runner {
 public:
  Runner(lab::Study& study, const std::vector<lab::StudyJob>& jobs,
         std::vector<lab::StudySection> finished, std::function<void()> save)
      : study_(study), jobs_(jobs), sections_(jobs.size()), save_(std::move(save)), pace_(jobs) {
    for (std::size_t i = 0; i < jobs.size(); ++i)
      for (lab::StudySection& section : finished)
        if (section.job == jobs[i].name && whole(section)) {
          sections_[i] = std::move(section);
          pace_.done(jobs[i]);
        }
  }

  /// Jobs first ... last - 1, `workers` at a time.
  void run(std::size_t first, std::size_t last, std::size_t workers) {
    next_ = first;
    std::vector<std::jthread> threads;  // joined however this ends
    running_ = workers;
    for (std::size_t k = 0; k < workers; ++k)
      threads.emplace_back([&, last] {
        for (;;) {
          const std::size_t i = next_++;
          if (i >= last || Interruption::came()) break;
          if (sections_[i]) continue;
          lab::StudySection section = jobs_[i].run();
          const std::lock_guard lock(mutex_);
          // Ctrl-C ends ngspice too: what it left is no result.
          if (!Interruption::came()) sections_[i] = std::move(section);
          pace_.done(jobs_[i]);
          try {
            publish();
          } catch (...) {
            failure_ = std::current_exception();
            next_ = last;  // the others finish what they have begun, no more
          }
        }
        const std::lock_guard lock(mutex_);
        --running_;
        changed_.notify_one();
      });
    Progress progress;
    std::unique_lock lock(mutex_);
    while (running_ > 0) {
      changed_.wait_for(lock, std::chrono::milliseconds(200));
      if (progress.due())
        progress.say(Interruption::came()
                         ? "stopping, after what has begun ..."
                         : pace_.text(jobs_[std::min<std::size_t>(next_, last) - 1].name));
    }
    if (failure_) std::rethrow_exception(failure_);
  }

  void publish() {
    study_.sections.clear();
    study_.complete = true;
    for (const auto& section : sections_)
      if (section)
        study_.sections.push_back(*section);
      else
        study_.complete = false;
    save_();
  }

 private:
  lab::Study& study_;
  const std::vector<lab::StudyJob>& jobs_;
  std::vector<std::optional<lab::StudySection>> sections_;
  std::function<void()> save_;
  Pace pace_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::exception_ptr failure_;  // of saving
  std::size_t running_ = 0;
};

void write(const std::filesystem::path& path, const std::string& content) {
  frames::OutputFile file(path);
  file.stream() << content;
  file.commit();
}

struct Written {
  std::set<std::string> files;
  std::string missing;  // what could not be drawn
};

/// Everything that a folder holds of a study, whole or a part.
Written write_all(const std::filesystem::path& folder, const lab::Study& study,
                  const std::string& scene_text) {
  report::Report report = report::study_html(study);
  report.files.emplace_back("tradeoff.csv", report::study_csv(study));
  report.files.emplace_back("tradeoff.json", report::study_json(study, scene_text));
  report.files.emplace_back("report.html", report.html);
  Written written{.files = {}, .missing = report.missing};
  for (const auto& [name, content] : report.files) {
    write(folder / name, content);
    written.files.insert(name);
  }
  return written;
}

/// So that a study of minutes is not without its circuits for want of a program.
void check(Simulator& simulator) {
  try {
    const std::vector<std::string> node = {"a"};
    (void)operating_point(simulator, "a resistor\nI1 0 a 1\nR1 a 0 1\n.op\n.end\n", node);
  } catch (const SimulatorError& error) {
    throw frames::CheckFailed(std::string(error.what()) + "; --digital leaves the circuits out");
  }
}

std::vector<lab::StudySection> earlier(const Options& options, const std::string& scene_text,
                                       const std::string& processor) {
  if (!options.resume) return {};
  const std::filesystem::path path = std::filesystem::path(options.out) / "tradeoff.json";
  if (!std::filesystem::exists(path)) return {};
  try {
    return report::finished_jobs(content_of(path), scene_text, processor);
  } catch (const std::runtime_error& error) {
    throw InputError({{.file = path.string(),
                       .message = std::string("cannot be resumed: ") + error.what(),
                       .hint = "run without --resume, or into another folder"}});
  }
}

void run(const Options& options) {
  lab::Requirement requirement{.accuracy = options.accuracy};
  if (options.deadline) requirement.deadline = deadline_of(*options.deadline);
  (void)lab::choose({}, &lab::WorkPoint::error_to_solution, lab::TimeOf::frame,
                    requirement);  // checks it
  if (options.resume && options.out.empty())
    throw CLI::ValidationError("--resume", "needs --out, the folder that holds the study's part");
  const Scene scene = read_scene(options.scene);
  const std::string scene_text = content_of(options.scene);
  std::optional<frames::OutputFile> json;
  if (!options.json.empty()) json.emplace(options.json);
  const std::unique_ptr<Simulator> simulator = lab::make_simulator(options.simulator);
  if (!options.digital) check(*simulator);

  lab::Study study;
  study.processor = lab::processor_name();
  std::vector<lab::StudySection> finished = earlier(options, scene_text, study.processor);
  if (!options.out.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (error || !std::filesystem::is_directory(options.out))
      throw frames::CannotCreate(options.out +
                                 ": error: cannot be created as a folder: " + error.message());
  }
  study.clock = lab::processor_clock();
  study.input = lab::study_input(scene);

  struct Stop final : lab::Observer {
    [[nodiscard]] bool stop() const override { return Interruption::came(); }
  } const stop;
  lab::SimulatorChoice interruptible = options.simulator;
  interruptible.ngspice.cancelled = Interruption::came;
  std::vector<lab::StudyJob> jobs = lab::digital_jobs(study.input);
  const std::size_t arithmetic = jobs.size();
  if (!options.digital)
    for (lab::StudyJob& job : lab::circuit_jobs(study.input, interruptible, stop))
      jobs.push_back(std::move(job));
  const std::filesystem::path folder = options.out;
  const Interruption interruption;
  Written written;
  Runner runner(study, jobs, std::move(finished), [&] {
    if (!options.out.empty()) written = write_all(folder, study, scene_text);
  });
  runner.run(0, arithmetic, 1);
  runner.run(arithmetic, jobs.size(), 2);
  runner.publish();

  if (!written.missing.empty()) std::cerr << "note: " << written.missing << '\n';
  if (!options.out.empty()) frames::note_others(folder, written.files);
  if (json) {
    json->stream() << report::study_json(study, scene_text);
    json->commit();
  }
  if (options.json != "-") {
    std::cout << "nothing beats these, of " << study.points().size() << " points:\n";
    report::print_cells(std::cout, report::front_cells(study));
    std::cout << '\n';
    if (const auto circuits = report::circuit_cells(study); circuits.size() > 1) {
      std::cout << "circuits of op-amps of 10 MHz:\n";
      report::print_cells(std::cout, circuits);
      std::cout << '\n';
    }
    for (const std::string& sentence : report::in_words(study)) std::cout << sentence << '\n';
    for (const std::string& failure : report::failures_in_words(study))
      std::cout << "left out: " << failure << '\n';
    if (requirement.accuracy || requirement.deadline)
      std::cout << "\nasked " << report::answer(study, requirement) << '\n';
    if (!options.out.empty()) std::cout << "report: " << (folder / "report.html").string() << '\n';
  }
  if (!study.complete)
    throw frames::CheckFailed(
        "stopped before the end" +
        std::string(options.out.empty() ? "" : "; --resume goes on from here"));
  if ((requirement.accuracy || requirement.deadline) &&
      !lab::choose(study.points(), &lab::WorkPoint::error_to_solution, lab::TimeOf::frame,
                   requirement)
           .point)
    throw frames::CheckFailed("no method meets the demand");
}

}  // namespace

void add_tradeoff(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "tradeoff",
      "What accuracy costs in time: every method and every circuit, timed on this "
      "machine, and which to choose");
  command->add_option("SCENE", options->scene, "Scene file (TOML)")->required();
  command->add_option(
      "--out", options->out,
      "Folder for report.html, tradeoff.csv, tradeoff.json and the plots (SVG, CSV)");
  command->add_option("--json", options->json, "Write the study as JSON (- = standard output)");
  command->add_option("--deadline", options->deadline,
                      "A frame must be done within this: 100us, 1ms, ...");
  command->add_option("--accuracy", options->accuracy,
                      "Largest error against the exact solution of the same problem, relative");
  command->add_flag("--digital", options->digital, "Arithmetic only: no circuits, no ngspice");
  command->add_flag("--resume", options->resume,
                    "Go on with the study that was interrupted, in the folder --out");
  add_simulator_options(*command, options->simulator);
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
