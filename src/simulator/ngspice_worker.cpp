#include "simulator/ngspice_worker.hpp"

#include <fcntl.h>
#include <ngspice/sharedspice.h>
#include <stdio_ext.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cfenv>
#include <climits>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/cell.hpp"
#include "simulator/ngspice_log.hpp"

namespace tactile_net {
namespace {

using End = ProcessResult::End;

constexpr int channel_to_parent = 3;  // after standard input, output and error

struct Deck {
  std::size_t output_limit = 0;
  std::size_t printed = 0;  ///< [bytes]
  bool complained = false;
};

void reply(End end, int code) noexcept {
  const WorkerReply message{end, code};
  if (::send(channel_to_parent, &message, sizeof message, MSG_NOSIGNAL) < 0) ::_exit(1);
}

/// After any failure: what the library still holds is not to be trusted.
[[noreturn]] void finish(End end, int code) noexcept {
  reply(end, code);
  ::_exit(0);
}

int on_line(char* text, int, void* user) noexcept {
  Deck& deck = *static_cast<Deck*>(user);
  std::string_view line(text);
  if (line.starts_with("stderr ") || line.starts_with("stdout ")) line.remove_prefix(7);
  deck.printed += line.size() + 1;
  if (deck.printed > deck.output_limit) finish(End::too_much_output, 0);
  deck.complained = deck.complained || is_complaint(line);
  (void)!::write(STDERR_FILENO, (std::string(line) + '\n').c_str(), line.size() + 1);
  return 0;
}

/// ngspice cannot go on, and would crash at the next call.
int on_exit_request(int status, bool, bool, int, void*) noexcept {
  finish(End::exited, status == 0 ? 1 : status);
}

int on_thread(bool, int, void*) noexcept { return 0; }

void command(std::string text) noexcept {
  if (::ngSpice_Command(text.data()) != 0) finish(End::exited, 1);
}

/// The deck without what batch mode would take as commands, and with exactly one `.end`: without
/// it, or with cards after it, the library would go on collecting in the next deck.
std::vector<std::string> circuit_lines(std::istream& deck) {
  std::vector<std::string> lines;
  bool commands = false;
  for (std::string line; std::getline(deck, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (lines.empty()) {  // the title, whatever it holds; a blank one would be skipped
      lines.push_back(line.starts_with('*') ? line : "* " + line);
      continue;
    }
    std::string word = line.substr(0, line.find_first_of(" \t", line.find_first_not_of(" \t")));
    word.erase(0, word.find_first_not_of(" \t"));
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (word == ".end") break;
    if (word == ".control") commands = true;
    if (!commands && !line.starts_with("*#")) lines.push_back(line);
    if (word == ".endc") commands = false;
  }
  if (lines.empty()) lines.emplace_back("*");
  lines.emplace_back(".end");
  return lines;
}

/// Solves deck.cir into result.raw; leaves no plot and no circuit behind.
void solve(const Deck& deck) noexcept {
  std::ifstream file("deck.cir", std::ios::binary);
  std::vector<std::string> lines = circuit_lines(file);
  std::vector<char*> cards;
  for (std::string& line : lines) cards.push_back(line.data());
  cards.push_back(nullptr);

  if (::ngSpice_Circ(cards.data()) != 0) finish(End::exited, 1);
  if (!deck.complained) command("run");
  // Of a run that made no plot, "const" is the current one.
  if (!deck.complained && std::string_view(::ngSpice_CurPlot()) != "const")
    command("write result.raw");
  if (deck.complained) finish(End::exited, 0);
  command("destroy all");  // each without the other leaks by the deck
  command("remcirc");
}

/// Of two places ngspice takes the first .spiceinit: an empty one here hides the user's.
void start_library(Deck& deck) noexcept {
  std::ofstream(".spiceinit").close();
  if (::ngSpice_Init(on_line, nullptr, on_exit_request, nullptr, nullptr, on_thread, &deck) != 0)
    finish(End::exited, 1);
  (void)::unlink(".spiceinit");
  command("set filetype=binary");
}

pid_t parent_of_worker = 0;

/// Every second of a long run. An idle worker sees its parent's end in the socket; the death signal
/// of prctl would also come at the end of the thread that forked.
void check_parent(int) noexcept {
  if (::getppid() != parent_of_worker) ::_exit(1);
}

void watch_parent(bool on) noexcept {
  const itimerval timer = on ? itimerval{{1, 0}, {1, 0}} : itimerval{};
  (void)::setitimer(ITIMER_REAL, &timer, nullptr);
}

/// So much time of the processors from now on, as `run_process` gives a program.
void limit_processors(std::chrono::milliseconds time_limit) noexcept {
  rusage used{};
  (void)::getrusage(RUSAGE_SELF, &used);
  const long processors = std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN));
  const auto seconds = std::chrono::ceil<std::chrono::seconds>(time_limit).count() + 2;
  const rlim_t until = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                       static_cast<rlim_t>(seconds) * static_cast<rlim_t>(processors);
  rlimit limit{};
  (void)::getrlimit(RLIMIT_CPU, &limit);
  limit.rlim_cur = std::min(until, limit.rlim_max);
  (void)::setrlimit(RLIMIT_CPU, &limit);
}

/// Nothing of the caller's is left: files, signal handlers, exit handlers, unwritten output,
/// locale, rounding mode.
void become_own_process(const WorkerOptions& options) noexcept {
  ::setpgid(0, 0);
  const int kept = ::fcntl(options.socket, F_DUPFD, channel_to_parent);
  const int null = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::dup2(null, stream) < 0) ::_exit(1);
  if (::dup2(kept, channel_to_parent) < 0) ::_exit(1);
  ::close_range(channel_to_parent + 1, ~0U, 0);
  ::__fpurge(stderr);  // would end in the first deck's log
  (void)::on_exit([](int status, void*) { ::_exit(status); }, nullptr);

  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
  parent_of_worker = options.parent;
  ::signal(SIGALRM, check_parent);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);

  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlimit file_limit{ProcessOptions{}.file_limit, ProcessOptions{}.file_limit};
  ::setrlimit(RLIMIT_FSIZE, &file_limit);
  for (const char* name : hidden_from_ngspice) ::unsetenv(name);
  ::setenv("HOME", options.folder, 0);  // only where there is none: ngspice crashes without
  std::setlocale(LC_ALL, "C");
  std::fesetenv(FE_DFL_ENV);
}

/// Makes the folder current and its log the standard error.
void enter(const char* folder) noexcept {
  const int log = ::chdir(folder) == 0
                      ? ::open("ngspice.log", O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600)
                      : -1;
  if (log < 0 || ::dup2(log, STDERR_FILENO) < 0) ::_exit(1);
  ::close(log);
}

}  // namespace

void serve_decks(const WorkerOptions& options) noexcept {
  become_own_process(options);
  if (confine({.folder = options.folder}) != 0) ::_exit(1);
  Deck deck;
  for (bool started = false;; started = true) {
    std::array<char, PATH_MAX> folder{};
    if (::recv(channel_to_parent, folder.data(), folder.size() - 1, 0) <= 0) ::_exit(0);
    watch_parent(true);
    limit_processors(options.time_limit);
    enter(folder.data());
    deck = {.output_limit = options.output_limit};
    if (!started) start_library(deck);
    solve(deck);
    watch_parent(false);
    reply(End::exited, 0);
  }
}

}  // namespace tactile_net
