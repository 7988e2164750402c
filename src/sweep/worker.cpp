#include "sweep/worker.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/sweep/journal.hpp"

namespace tactile_net::sweep {
namespace {

/// Nothing of the driver's is left but memory and messages: not its lock, nor its signal handlers,
/// nor the sockets of other workers, whose ends would not be seen then.
///
/// @return whether the driver is still there
bool become_own_process(int socket, pid_t driver) noexcept {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != driver) return false;
  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
  ::signal(SIGXFSZ, SIG_IGN);  // a journal that may not grow is an error as a full disk is
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int null = ::open("/dev/null", O_WRONLY);
  if (::dup2(socket, STDIN_FILENO) < 0 || ::dup2(null, STDOUT_FILENO) < 0) return false;
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  return true;
}

bool send(const Report& report) noexcept {
  return ::send(STDIN_FILENO, &report, sizeof report, MSG_NOSIGNAL) == sizeof report;
}

/// Until standard input ends, which it does with the driver.
void serve(const Study& study, const std::filesystem::path& journal,
           const lab::SimulatorChoice& choice) {
  const int file = open_journal(journal, study);
  const int no_file = file < 0 ? errno : 0;
  const std::unique_ptr<Simulator> simulator = lab::make_simulator(choice);
  std::array<std::uint64_t, Worker::most_points_at_once> points{};
  for (;;) {
    const ssize_t got = ::recv(STDIN_FILENO, points.data(), sizeof points, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(got) / sizeof points[0]; ++i) {
      Report report{points[i], no_file};
      if (report.error == 0)
        report.error = append(file, lines(solve(study, points[i], *simulator), study.keep()));
      if (!send(report) || report.error != 0) return;
    }
  }
}

}  // namespace

int append(int file, const std::string& text) noexcept {
  ssize_t written = 0;
  do written = ::write(file, text.data(), text.size());
  while (written < 0 && errno == EINTR);
  if (written == static_cast<ssize_t>(text.size())) return 0;
  return written < 0 ? errno : ENOSPC;
}

int open_journal(const std::filesystem::path& journal, const Study& study) noexcept {
  const int file =
      ::open(journal.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0644);
  struct stat state {};
  if (file < 0 || ::fstat(file, &state) != 0) return -1;
  if (state.st_size == 0)
    if (const int error = append(file, text(head_of(study))); error != 0) {
      ::close(file);
      errno = error;
      return -1;
    }
  return file;
}

Worker::Worker(const Study& study, const std::filesystem::path& journal,
               const lab::SimulatorChoice& simulator)
    : pair_(socket_pair(SOCK_SEQPACKET)) {
  const pid_t driver = ::getpid();
  child_ = ::fork();
  if (child_ < 0) fail_with_errno("fork");
  if (child_ == 0) {
    int status = 1;
    try {
      if (become_own_process(pair_.theirs.get(), driver)) serve(study, journal, simulator);
      status = 0;
    } catch (...) {
      // Its death is all that the driver learns.
    }
    ::_exit(status);
  }
  ::setpgid(child_, child_);  // in both, so that neither has to wait for the other
  leftover_.emplace(child_);
  pair_.theirs.reset();
}

Worker::~Worker() {
  ::kill(child_, SIGKILL);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Worker::give(std::deque<std::size_t> points) {
  const std::vector<std::uint64_t> message(points.begin(), points.end());
  points_ = std::move(points);
  (void)::send(socket(), message.data(), message.size() * sizeof message[0], MSG_NOSIGNAL);
}

std::optional<Report> Worker::report() {
  Report report;
  const ssize_t got = ::recv(socket(), &report, sizeof report, MSG_DONTWAIT);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  dead_ = got != sizeof report;
  if (dead_) return std::nullopt;
  if (!points_.empty()) points_.pop_front();
  return report;
}

}  // namespace tactile_net::sweep
