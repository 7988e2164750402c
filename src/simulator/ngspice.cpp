#include "tactile_net/simulator/ngspice.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include "tactile_net/simulator/child_process.hpp"
#include "tactile_net/simulator/raw_file.hpp"

namespace tactile_net {
namespace {

namespace fs = std::filesystem;
using Cause = SimulatorError::Cause;
using End = ProcessResult::End;

/// A temporary folder that only this user can read; removed unless it is kept.
class PrivateFolder {
 public:
  PrivateFolder() {
    std::string name = (fs::temp_directory_path() / "tactile-net-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("no temporary folder can be made in " +
                               fs::temp_directory_path().string() + ": " +
                               std::generic_category().message(errno));
    path_ = name;
  }
  ~PrivateFolder() {
    std::error_code ignored;
    if (!kept_) fs::remove_all(path_, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  void keep() noexcept { kept_ = true; }
  [[nodiscard]] const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
  bool kept_ = false;
};

void write_file(const fs::path& path, std::string_view content) {
  std::ofstream file(path, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": error: could not be written");
}

/// ngspice exits with 0 after most failures. A deck of linear elements that it solves draws no line
/// with any of these words.
bool is_complaint(std::string_view line) {
  if (line.substr(0, 8) == "Circuit:") return false;  // the deck's own title
  std::string lower(line);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* word :
       {"error", "warning", "singular", "aborted", "fatal", "timestep too small"})
    if (lower.find(word) != std::string::npos) return true;
  return false;
}

/// The first few complaints, indented; empty if there is none.
std::string complaints(const std::string& log) {
  constexpr int most = 4;
  std::istringstream lines(log);
  std::string text;
  int found = 0;
  for (std::string line; std::getline(lines, line) && found < most;)
    if (is_complaint(line)) {
      text += "\n  ngspice: " + line.substr(0, 200);
      ++found;
    }
  return text;
}

/// Keeps deck and log and throws.
[[noreturn]] void fail(PrivateFolder& folder, Cause cause, const std::string& what,
                       const ProcessResult& process) {
  write_file(folder.path() / "ngspice.log", process.errors + process.output);
  folder.keep();
  throw SimulatorError(cause,
                       what + complaints(process.errors + process.output) + "\n  deck and log: " +
                           (folder.path() / "deck.cir").string() + ", ngspice.log beside it",
                       folder.path());
}

/// How a failure that ngspice reported itself is called.
Cause cause_of(const ProcessResult& process) {
  const std::string log = process.errors + process.output;
  return log.find("imestep too small") != std::string::npos ? Cause::diverged : Cause::failed;
}

void check_finite(const RawFile& plot) {
  for (const auto* parts : {&plot.values, &plot.imaginary})
    for (std::size_t i = 0; i < parts->size(); ++i)
      for (const double value : (*parts)[i])
        if (!std::isfinite(value))
          throw std::runtime_error(plot.names[i] + " is not a finite number");
}

void check_end(PrivateFolder& folder, const ProcessResult& process, const NgspiceOptions& options) {
  switch (process.end) {
    case End::exited:
      break;
    case End::not_found:
      throw SimulatorError(Cause::not_installed,
                           "the simulator '" + options.program +
                               "' is not installed or not in PATH: apt install ngspice",
                           {});
    case End::timed_out:
      fail(folder, Cause::timed_out,
           "ngspice did not end within " +
               std::to_string(static_cast<double>(options.time_limit.count()) / 1e3) +
               " s and was stopped; raise the time limit",
           process);
    case End::too_much_output:
      fail(folder, Cause::too_much_output,
           "ngspice printed more than " + std::to_string(options.output_limit) +
               " bytes and was stopped",
           process);
    case End::signalled:
      fail(folder, Cause::crashed, "ngspice crashed: " + std::string(::strsignal(process.code)),
           process);
  }
  if (process.code != 0)
    fail(folder, cause_of(process),
         "ngspice failed with exit status " + std::to_string(process.code), process);
  if (!complaints(process.errors + process.output).empty())
    fail(folder, cause_of(process), "ngspice found the circuit at fault, though it exited with 0",
         process);
}

}  // namespace

Ngspice::Ngspice(NgspiceOptions options) : options_(std::move(options)) {}

Simulation Ngspice::run(const std::string& deck) {
  PrivateFolder folder;
  write_file(folder.path() / "deck.cir", deck);
  // -n: no .spiceinit of the user's; the variable would turn the raw file into text.
  const ProcessResult process =
      run_process({options_.program, "-n", "-b", "-r", "result.raw", "deck.cir"},
                  {.folder = folder.path(),
                   .unset = {"SPICE_ASCIIRAWFILE", "SPICE_SCRIPTS", "SPICE_NO_DATASEG_CHECK"},
                   .time_limit = options_.time_limit,
                   .output_limit = options_.output_limit});
  check_end(folder, process, options_);

  try {
    Simulation simulation{.plot = read_raw_file(folder.path() / "result.raw"),
                          .seconds = process.seconds};
    check_finite(simulation.plot);
    return simulation;
  } catch (const std::exception& error) {
    fail(folder, Cause::bad_result,
         std::string("ngspice exited with 0 without a usable answer: ") + error.what(), process);
  }
}

}  // namespace tactile_net
