#include "tactile_net/simulator/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "simulator/cell.hpp"
#include "simulator/descriptor.hpp"
#include "simulator/pass_descriptor.hpp"
#include "simulator/program.hpp"
#include "tactile_net/system/leftovers.hpp"

extern char** environ;

namespace tactile_net {
namespace {

using Clock = std::chrono::steady_clock;
using End = ProcessResult::End;

void set_limit(int resource, rlim_t value) noexcept {
  const rlimit limit{value, value};
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

std::string_view name_of(std::string_view variable) {
  return variable.substr(0, variable.find('='));
}

/// The caller's environment without the variables to hide, and with those that it lacks.
std::vector<char*> environment_of(const ProcessOptions& options) {
  std::vector<char*> variables;
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (std::find(options.unset.begin(), options.unset.end(), name_of(*entry)) ==
        options.unset.end())
      variables.push_back(*entry);
  for (const std::string& wanted : options.defaults)
    if (std::none_of(variables.begin(), variables.end(),
                     [&](const char* entry) { return name_of(entry) == name_of(wanted); }))
      variables.push_back(const_cast<char*>(wanted.c_str()));
  variables.push_back(nullptr);
  return variables;
}

/// What the child needs, made before fork: after it nothing may be allocated.
struct Start {
  std::vector<char*> arguments{};
  std::vector<char*> environment{};
  std::string program{};  ///< the file to run, if confined
  std::string folder{};   ///< to write in, if confined
  bool starts_nothing = false;
  rlim_t cpu_seconds = 0;
  pid_t parent = 0;
};

Start start_of(const std::vector<std::string>& command, const ProcessOptions& options) {
  Start start;
  for (const std::string& argument : command)
    start.arguments.push_back(const_cast<char*>(argument.c_str()));
  start.arguments.push_back(nullptr);
  start.environment = environment_of(options);
  if (options.confined) {
    start.program = program_file(command.front());
    start.folder = options.folder.string();
    start.starts_nothing = !is_script(start.program);
  }
  const long processors = std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN));
  const auto seconds = std::chrono::ceil<std::chrono::seconds>(options.time_limit).count();
  start.cpu_seconds = static_cast<rlim_t>(seconds + 1) * static_cast<rlim_t>(processors);
  start.parent = ::getpid();
  return start;
}

/// The kernel kills the child when its parent ends, whatever ends it. `fork` and this are not one
/// step: a parent that ended in between is seen by the child's having another.
bool dies_with(pid_t parent) noexcept {
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) return false;
  if (::getppid() == parent) return true;
  errno = ESRCH;
  return false;
}

/// Confines the child; sends the parent what it needs to serve it, if there is such.
bool enter_cell(const Start& start, int report) noexcept {
  int listener = -1;
  errno = confine({.folder = start.folder.empty() ? nullptr : start.folder.c_str(),
                   .starts_nothing = start.starts_nothing,
                   .only = {start.program.c_str(), start.arguments.data()},
                   .listener = &listener});
  if (errno != 0) return false;
  return listener < 0 || send_descriptor(report, listener);
}

/// Tells the parent why the program could not start, as errno says, and ends.
[[noreturn]] void give_up(int report) noexcept {
  const int reason = errno;
  (void)!::write(report, &reason, sizeof reason);
  ::_exit(127);
}

/// Whether a child's end may be collected by others than who waits for it: by the kernel where the
/// caller ignores SIGCHLD, by the caller's handler.
bool ends_are_collected() noexcept {
  struct sigaction action {};
  return ::sigaction(SIGCHLD, nullptr, &action) != 0 || action.sa_handler != SIG_DFL ||
         (action.sa_flags & SA_NOCLDWAIT) != 0;
}

/// In a child: forks the program, and returns in it. The child itself stays here: it is the keeper,
/// whose children nobody else collects. It sends how the program ended, as wait tells it, and is
/// then killed with the group that it leads.
void leave_to_keeper(Start& start, int report, int told) noexcept {
  sigset_t all;
  ::sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, nullptr);
  ::signal(SIGCHLD, SIG_DFL);
  if (!dies_with(start.parent)) give_up(report);
  start.parent = ::getpid();
  const pid_t program = ::fork();
  if (program == 0) return;
  if (program < 0 || ::dup2(told, STDIN_FILENO) < 0) give_up(report);
  ::close_range(STDIN_FILENO + 1, ~0U, 0);
  int status = 0;
  while (::waitpid(program, &status, 0) < 0 && errno == EINTR) {
  }
  (void)::send(STDIN_FILENO, &status, sizeof status, MSG_NOSIGNAL);
  for (;;) ::pause();
}

/// In the child, after fork: only calls that are safe there. Reports why it could not start.
[[noreturn]] void become(const Start& start, const ProcessOptions& options,
                         const std::array<int, 3>& streams, int report) noexcept {
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_FSIZE, options.file_limit);
  set_limit(RLIMIT_CPU, start.cpu_seconds);
  bool ready = dies_with(start.parent) &&
               (options.folder.empty() || ::chdir(options.folder.c_str()) == 0) &&
               ::dup2(streams[0], STDIN_FILENO) >= 0 && ::dup2(streams[1], STDOUT_FILENO) >= 0 &&
               ::dup2(streams[2], STDERR_FILENO) >= 0;
  // The caller's open files are its own: a half-written result could be written on through one.
  ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  if (ready && options.confined) {
    ready = enter_cell(start, report);
    if (ready) ::execve(start.program.c_str(), start.arguments.data(), start.environment.data());
  } else if (ready) {
    ::execvpe(start.arguments[0], start.arguments.data(), start.environment.data());
  }
  give_up(report);
}

/// The program as its parent sees it, with what it started: a process group.
class Group {
 public:
  /// @param keeper  tells how the program ended; closed: the leader is the program itself
  Group(pid_t leader, Descriptor keeper) noexcept
      : leader_(leader), keeper_(std::move(keeper)), leftover_(leader) {}
  ~Group() { kill(); }
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;

  /// Whether the program has ended. @throw std::runtime_error  another has collected its end
  [[nodiscard]] bool ended() {
    if (status_) return true;
    int status = 0;
    if (keeper_.open()) {
      const ssize_t got = ::recv(keeper_.get(), &status, sizeof status, MSG_DONTWAIT);
      if (got < 0 && (errno == EAGAIN || errno == EINTR)) return false;
      if (got != static_cast<ssize_t>(sizeof status)) status = SIGKILL;  // killed with its keeper
    } else {
      const pid_t got = ::waitpid(leader_, &status, WNOHANG);
      if (got == 0 || (got < 0 && errno == EINTR)) return false;
      if (got < 0)
        throw std::runtime_error(
            "how a program that was started ended is not known: another part of this process "
            "waits for all children (waitpid(-1) or wait); let it wait for its own alone");
    }
    status_ = status;
    return true;
  }
  /// Waits for the program's end; false if it still runs at the deadline.
  [[nodiscard]] bool ends_by(Clock::time_point deadline) {
    while (!ended()) {
      if (Clock::now() >= deadline) return false;
      ::usleep(500);
    }
    return true;
  }
  /// Kills what still runs of it, and what stayed behind after its end.
  void kill() noexcept {
    if (leader_ <= 0) return;
    ::kill(-leader_, SIGKILL);
    if (keeper_.open() || !status_)
      while (::waitpid(leader_, nullptr, 0) < 0 && errno == EINTR) {
      }
    leader_ = 0;
  }
  /// How it ended, as wait tells it. @pre  ended()
  [[nodiscard]] int status() const { return status_.value(); }

 private:
  pid_t leader_;
  Descriptor keeper_;
  LeftoverChild leftover_;
  std::optional<int> status_{};
};

/// Reads what is there; closes the descriptor at its end.
void drain(Descriptor& from, std::string& into) {
  std::array<char, 65536> buffer;
  const ssize_t got = ::read(from.get(), buffer.data(), buffer.size());
  if (got > 0)
    into.append(buffer.data(), static_cast<std::size_t>(got));
  else if (got == 0 || (errno != EINTR && errno != EAGAIN))
    from.reset();
}

/// Sends a piece of the input; closes the descriptor when all is sent or nobody reads.
void feed(Descriptor& to, std::string_view& input) {
  const ssize_t sent = ::send(to.get(), input.data(), input.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (sent >= 0) input.remove_prefix(static_cast<std::size_t>(sent));
  const bool waiting = sent < 0 && (errno == EINTR || errno == EAGAIN);
  if (input.empty() || (sent < 0 && !waiting)) to.reset();
}

/// Our ends of the child's.
struct Streams {
  Descriptor& input;
  Descriptor& output;
  Descriptor& errors;
  Descriptor& listener;  ///< its calls for temporary files
};

/// Moves bytes until the child has closed its streams or ended, or a limit is reached.
End converse(Group& group, const Streams& streams, const ProcessOptions& options,
             Clock::time_point deadline, ProcessResult& result) {
  const auto& [input, output, errors, listener] = streams;
  constexpr int heartbeat_ms = 50;
  std::string_view rest = options.input;
  if (rest.empty()) input.reset();
  while (output.open() || errors.open()) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return End::timed_out;
    if (options.cancelled != nullptr && options.cancelled()) return End::cancelled;
    std::array<pollfd, 4> polled = {
        pollfd{input.get(), POLLOUT, 0}, pollfd{output.get(), POLLIN, 0},
        pollfd{errors.get(), POLLIN, 0}, pollfd{listener.get(), POLLIN, 0}};
    const int ready = ::poll(polled.data(), polled.size(),
                             static_cast<int>(std::min<long long>(left, heartbeat_ms)));
    if (ready < 0 && errno != EINTR) fail_with_errno("poll");
    if (ready == 0) {
      // A grandchild may hold the streams open after the child's end: do not wait for it.
      if (group.ended()) return End::exited;
      continue;
    }
    if (ready < 0) continue;
    if ((polled[3].revents & POLLIN) != 0)
      serve_temporary_file(listener.get());
    else if (polled[3].revents != 0)
      listener.reset();  // nobody is left to ask
    if (polled[0].revents != 0) feed(input, rest);
    if (polled[1].revents != 0) drain(output, result.output);
    if (polled[2].revents != 0) drain(errors, result.errors);
    if (result.output.size() + result.errors.size() > options.output_limit)
      return End::too_much_output;
  }
  return End::exited;
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& command, const ProcessOptions& options) {
  const auto start = Clock::now();
  const auto deadline = start + options.time_limit;
  SocketPair input = socket_pair(SOCK_STREAM);
  SocketPair output = socket_pair(SOCK_STREAM);
  SocketPair errors = socket_pair(SOCK_STREAM);
  SocketPair report = socket_pair(SOCK_STREAM);

  const bool kept = ends_are_collected();
  SocketPair told = kept ? socket_pair(SOCK_STREAM) : SocketPair{Descriptor(), Descriptor()};

  Start what = start_of(command, options);
  const pid_t child = ::fork();
  if (child < 0) fail_with_errno("fork");
  if (child == 0) {
    ::setpgid(0, 0);
    if (kept) leave_to_keeper(what, report.theirs.get(), told.theirs.get());
    become(what, options, {input.theirs.get(), output.theirs.get(), errors.theirs.get()},
           report.theirs.get());
  }
  ::setpgid(child, child);  // in both, so that neither has to wait for the other
  Group group(child, std::move(told.ours));
  told.theirs.reset();
  input.theirs.reset();
  output.theirs.reset();
  errors.theirs.reset();
  report.theirs.reset();

  ProcessResult result;
  int reason = 0;
  Descriptor listener;
  ssize_t got = 0;
  do got = receive(report.ours.get(), reason, listener);
  while (got > 0 && reason == 0);
  const bool started = reason == 0;

  result.end =
      converse(group, {input.ours, output.ours, errors.ours, listener}, options, deadline, result);
  input.ours.reset();
  if (result.end == End::exited && !group.ends_by(deadline)) result.end = End::timed_out;
  group.kill();
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (!started) {
    if (reason != ENOENT && reason != EACCES && reason != ENOTDIR) {
      errno = reason;
      fail_with_errno(command.front().c_str());
    }
    result.end = End::not_found;
    result.code = reason;
  } else if (result.end == End::exited) {
    const int status = group.status();
    if (WIFSIGNALED(status)) result.end = End::signalled;
    result.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }
  return result;
}

}  // namespace tactile_net
