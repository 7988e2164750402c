#include "commands/report.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <ostream>
#include <set>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include "commands/input.hpp"
#include "commands/recording.hpp"
#include "failure.hpp"
#include "lab/in_order.hpp"
#include "numeric/lower_case.hpp"
#include "numeric/threads.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/broken_taxels.hpp"
#include "tactile_net/lab/recorded_noise.hpp"
#include "tactile_net/lab/recording_row.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/pages/recording_page.hpp"
#include "tactile_net/pages/report_page.hpp"
#include "tactile_net/report/csv/recording_csv.hpp"
#include "tactile_net/report/folder.hpp"
#include "tactile_net/report/json/solve_json.hpp"
#include "tactile_net/report/recordings.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::tool {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view table_file = "recordings.csv";
constexpr std::string_view table_json = "result.json";
constexpr std::string_view pages_folder = "recordings";
constexpr std::string_view page_files[] = {"report.html", "result.json", "shown.csv"};

/// In the results' folder, of the recording whose page's folder has that name.
std::string page_of(const std::string& name) {
  return std::string(pages_folder) + '/' + name + "/report.html";
}

// Which files there are.

bool is_recording(const fs::path& path) {
  const std::string ending = lower_case(path.extension().string());
  return ending == ".csv" || ending == ".npy";
}

bool are_one(const fs::path& one, const fs::path& other) {
  std::error_code none;
  return fs::equivalent(one, other, none);
}

/// The recordings in a folder, sorted; without what this command writes there.
std::vector<fs::path> recordings_in(const fs::path& folder, const ReportOptions& options) {
  const fs::path out = options.results.folder;
  std::vector<fs::path> found;
  const auto take = [&](const fs::directory_entry& entry) {
    std::error_code none;
    // A link that leads nowhere is a row that says so.
    if (!is_recording(entry.path()) || entry.is_directory(none)) return;
    if (entry.path().filename().string().starts_with('.')) return;  // the system's own, and hidden
    if (!out.empty() && are_one(entry.path(), out / table_file)) return;
    if (!options.csv.empty() && are_one(entry.path(), options.csv)) return;
    found.push_back(entry.path());
  };
  if (!options.recursive) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) take(entry);
  } else {
    const auto skipped = fs::directory_options::skip_permission_denied;
    for (auto at = fs::recursive_directory_iterator(folder, skipped);
         at != fs::recursive_directory_iterator(); ++at) {
      std::error_code none;
      if (at->is_directory(none)) {
        if (!out.empty() && (are_one(at->path(), out) || are_one(at->path(), out / pages_folder)))
          at.disable_recursion_pending();
        continue;
      }
      take(*at);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Each file once, by whatever names it is given.
std::vector<std::string> files_of(const ReportOptions& options) {
  std::vector<std::string> files;
  std::set<fs::path> known;
  const auto take = [&](const fs::path& path) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(path, error);
    if (known.insert(error ? path : whole).second) files.push_back(path.string());
  };
  for (const std::string& given : options.recordings) {
    if (is_standard_input(given))
      throw WrongUsage("RECORDING", "standard input is one recording: that is for solve");
    std::error_code none;
    const fs::file_type type = fs::status(given, none).type();
    if (type == fs::file_type::not_found)
      throw WrongUsage("RECORDING", given + " is not there: name a recording, or a folder of some");
    if (type != fs::file_type::directory) {
      take(given);
      continue;
    }
    const std::vector<fs::path> found = recordings_in(given, options);
    if (found.empty())
      throw WrongUsage("RECORDING",
                       given + " holds no file that ends in .csv or .npy" +
                           (options.recursive ? ": give the files themselves"
                                              : ": with --recursive folders inside are searched"));
    for (const fs::path& path : found) take(path);
  }
  return files;
}

/// A letter that needs no care in links.
bool is_plain(char letter) {
  const auto code = static_cast<unsigned char>(letter);
  return code < 128 && (std::isalnum(code) != 0 || letter == '-' || letter == '_');
}

/// A folder's name for each file, of plain letters; no two are alike, on file systems without
/// capitals too.
std::vector<std::string> folder_names(std::span<const std::string> files) {
  constexpr std::size_t longest = 80;
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const std::string& file : files) {
    std::string name = fs::path(file).stem().string().substr(0, longest);
    std::replace_if(name.begin(), name.end(), std::not_fn(is_plain), '_');
    if (name.empty()) name = "_";
    std::string own = name;
    for (std::size_t i = 2; !taken.insert(lower_case(own)).second; ++i)
      own = name + '-' + std::to_string(i);
    names.push_back(std::move(own));
  }
  return names;
}

// One recording.

/// What stands in its row, on its page and in its JSON.
struct SolvedFile {
  lab::RecordingRow row{};
  drawing::Page page{};  ///< empty: none is wanted, or there is no answer
  std::string json{};
};

/// How it is solved.
struct Asked {
  const ReportOptions& options;
  std::string command{};  ///< the line that was typed
  bool wants_page = false;
};

[[noreturn]] void refuse_overflow(frames::FrameSource& source) {
  throw source.refusal("the frame's tractions overflow a double", "scale the readings");
}

/// The scene's problem as the recording wants it: without broken taxels, of a line with the noise
/// of its still frames where none is stated. @return  what was found so
lab::Findings prepare(lab::AnyProblem& problem, const std::string& path,
                      const ReportOptions& options) {
  constexpr Method method = Method::tikhonov;
  if (!lab::can_leave_out(problem, method)) return {};
  const auto seen = first_look(lab::scene_of(problem), path, options.columns);
  if (!seen) return {};
  const lab::AnyProblem stated = problem;
  auto* line = std::get_if<lab::SceneProblem>(&problem);
  if (line != nullptr && lab::wants_noise(*line, method))
    *line = lab::with_recorded_noise(*line, *seen);
  lab::Findings found = lab::leave_out_broken(problem, *seen);
  if (line != nullptr)
    if (const auto taken = lab::noise_taken(std::get<lab::SceneProblem>(stated), *line))
      found.emplace_back(*taken);
  return found;
}

SolvedFile solved_file(lab::AnyProblem problem, const std::string& path, const Asked& asked) {
  const double start = lab::monotonic_time();
  const lab::Findings found = prepare(problem, path, asked.options);
  lab::RecordingSolver solver(problem, Method::tikhonov, {.missing = asked.options.missing});
  lab::Recording recording(problem);
  frames::ReadingsFile file = std::visit(
      [&](const auto& one) {
        return frames::ReadingsFile(
            path, one.scene(), nullptr,
            {.columns = asked.options.columns,
             .accept_missing = asked.options.missing != lab::Missing::fail});
      },
      problem);
  frames::FrameSource& source = file.source();
  std::vector<double> readings(source.columns().size());
  while (source.next(readings)) {
    const bool incomplete = std::any_of(readings.begin(), readings.end(),
                                        [](double reading) { return std::isnan(reading); });
    try {
      if (const auto answer = solver.solve(readings, source.seconds()))
        recording.add(source.seconds(), solver.problem(), readings, *answer, incomplete);
      else
        recording.skip(source.seconds());
    } catch (const lab::FrameOverflow&) {
      refuse_overflow(source);
    }
  }
  if (!source.time_unit_known()) recording.times_without_unit();
  lab::RecordingOverview overview = recording.overview();
  overview.findings = solver.findings();
  overview.findings.insert(overview.findings.begin(), found.begin(), found.end());
  SolvedFile all{.row = lab::row_of(overview)};
  if (!asked.wants_page || !all.row.problem.empty()) return all;
  pages::Made made{.by = asked.command, .files = {"result.json"}};
  if (overview.is_line()) made.files.emplace_back("shown.csv");
  all.page = pages::recording_page(overview, path, report::in_words(solver.remarks()), made);
  if (overview.is_line()) all.page.files.emplace_back("shown.csv", report::recording_csv(overview));
  all.json = report::solve_json(overview, solver.solved(),
                                {.readings = path,
                                 .columns_ignored = source.ignored(),
                                 .missing = asked.options.missing,
                                 .remarks = solver.solved().last.remarks,
                                 .seconds = lab::monotonic_time() - start});
  return all;
}

/// The same of a file that cannot be read or solved: its row says why.
SolvedFile solved_or_not(const lab::AnyProblem& problem, const std::string& path,
                         const Asked& asked) {
  const double start = lab::monotonic_time();
  SolvedFile all;
  try {
    all = solved_file(problem, path, asked);
  } catch (const InputError& error) {
    all.row.problem = report::problem_in_words(error.diagnostics().front());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    all.row.problem = error.what();
  }
  all.row.name = path;
  all.row.seconds = lab::monotonic_time() - start;
  return all;
}

// All of them.

void write_page(const SolvedFile& file, const fs::path& folder, bool force) {
  frames::OutputFolder place(folder, report::existing_in(folder, force));
  place.write("report.html", file.page.html);
  place.write("result.json", file.json);
  for (const auto& [name, content] : file.page.files) place.write(name, content);
  (void)place.commit();
}

/// The folders of pages that an earlier run of this command left: those that its table links to.
std::set<std::string> earlier_pages(const fs::path& out) {
  std::set<std::string> names;
  std::ifstream table(out / table_json, std::ios::binary);
  const std::string json{std::istreambuf_iterator<char>(table), {}};
  for (const std::string& page : report::linked_pages(json)) {
    const std::string name = fs::path(page).parent_path().filename().string();
    const bool is_own = std::all_of(name.begin(), name.end(), is_plain) && page == page_of(name);
    if (is_own) names.insert(name);
  }
  return names;
}

/// Removes those pages. What else is in their folders stays, and so do pages that somebody else
/// put into their places. @return  how many
std::size_t remove_pages(const fs::path& out, const std::set<std::string>& names) {
  std::size_t removed = 0;
  for (const std::string& name : names) {
    const fs::path folder = out / pages_folder / name;
    if (fs::is_symlink(folder) || !report::is_own_report(folder / "report.html")) continue;
    for (const std::string_view file : page_files) fs::remove(folder / file);
    if (fs::is_empty(folder)) fs::remove(folder);
    ++removed;
  }
  return removed;
}

/// @param problem  of one recording; of lines one of its own, as what they share is not made by two
///                 threads at once
/// @param threads  that solve a recording each
std::vector<lab::RecordingRow> rows_of(const std::function<lab::AnyProblem()>& problem,
                                       std::span<const std::string> files, std::size_t threads,
                                       const Asked& asked, const Streams& streams) {
  struct Job {
    std::size_t index = 0;
    SolvedFile solved{};
  };
  const ResultOptions& results = asked.options.results;
  const fs::path pages = fs::path(results.folder) / pages_folder;
  const std::vector<std::string> names = folder_names(files);
  std::vector<lab::RecordingRow> rows;
  Progress progress(streams);
  const auto say = [&] {
    progress.say(std::to_string(rows.size()) + " of " + counted(files.size(), "recording"));
  };
  say();
  std::size_t next = 0;
  lab::in_order<Job>(
      std::min(threads, files.size()),
      [&](Job& job) {
        job.index = next;
        return next++ < files.size();
      },
      [&](Job& job) { job.solved = solved_or_not(problem(), files[job.index], asked); },
      [&](Job& job) {
        if (!job.solved.page.html.empty()) {
          const std::string& name = names[job.index];
          fs::create_directories(pages);
          write_page(job.solved, pages / name, results.force);
          job.solved.row.page = page_of(name);
        }
        rows.push_back(std::move(job.solved.row));
        if (progress.due()) say();
      });
  lab::sort_by_suspicion(rows);
  return rows;
}

}  // namespace

void run(const ReportOptions& options, const Streams& streams) {
  const std::vector<std::string> files = files_of(options);
  Results results(options.results, streams);
  const auto csv = output_if(options.csv, streams);
  const AnyScene scene = read_any_scene(options.scene, streams.in);
  const Asked asked{.options = options,
                    .command = streams.command,
                    .wants_page = !options.results.folder.empty() && !options.no_pages};
  std::vector<lab::RecordingRow> rows;
  if (const auto* skin = std::get_if<SkinScene>(&scene)) {
    const lab::SkinSceneProblem problem(*skin);
    problem.prepare();
    rows = rows_of([&] { return lab::AnyProblem(problem); }, files,
                   problem.is_large() ? 1 : processors(), asked, streams);
  } else {
    rows = rows_of([&] { return lab::any_problem(scene); }, files, processors(), asked, streams);
  }

  Progress progress(streams);
  Result result{.json = [&] { return report::recordings_json(rows, scene); },
                .page =
                    [&] {
                      return pages::report_page(rows, scene,
                                                {.by = streams.command, .files = {"result.json"}});
                    }};
  if (options.csv != "-")
    result.print = [&](std::ostream& out) { report::print_recordings(out, rows, scene); };
  if (const fs::path out = options.results.folder; !out.empty()) {
    std::set<std::string> stale = earlier_pages(out);
    for (const lab::RecordingRow& row : rows)
      stale.erase(fs::path(row.page).parent_path().filename().string());
    if (const std::size_t removed = remove_pages(out, stale); removed > 0)
      streams.err << "note: " << counted(removed, "page")
                  << " of an earlier run, of recordings that have none now, removed\n";
  }
  results.write(result, progress);
  if (csv) write(csv.get(), report::recordings_csv(rows, scene));
  const auto failed = static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(),
      [](const lab::RecordingRow& row) { return row.standing() == lab::Standing::no_answer; }));
  if (failed > 0)
    throw CheckFailed(std::to_string(failed) + " of " + counted(rows.size(), "recording") +
                      " could not be read or solved");
}

}  // namespace tactile_net::tool
