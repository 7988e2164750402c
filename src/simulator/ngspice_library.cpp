#include "tactile_net/simulator/ngspice_library.hpp"

#include <poll.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>

#include "simulator/descriptor.hpp"
#include "simulator/ngspice_log.hpp"
#include "simulator/ngspice_worker.hpp"
#include "simulator/private_folder.hpp"
#include "tactile_net/system/leftovers.hpp"

namespace tactile_net {
namespace {

using Clock = std::chrono::steady_clock;
using End = ProcessResult::End;

/// Waits for a message or the other side's end; false if neither has come by the deadline.
bool readable(const Descriptor& socket, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd polled{socket.get(), POLLIN, 0};
    const int ready = ::poll(&polled, 1, static_cast<int>(std::min<long long>(left, INT_MAX)));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) fail_with_errno("poll");
  }
}

/// The beginning of the log: of a deck that prints without end more than the limit may be there.
std::string read_log(const std::filesystem::path& folder, std::size_t limit) {
  std::ifstream file(folder / "ngspice.log", std::ios::binary);
  std::string text(limit, '\0');
  file.read(text.data(), static_cast<std::streamsize>(limit));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace

/// The parent's side of the worker, which ends with it.
class NgspiceLibrary::Worker {
 public:
  explicit Worker(const NgspiceLibraryOptions& options) : output_limit_(options.output_limit) {
    SocketPair pair = socket_pair(SOCK_SEQPACKET);
    const pid_t self = ::getpid();
    const std::string cell = folder_.path().string();
    id_ = ::fork();
    if (id_ < 0) fail_with_errno("fork");
    if (id_ == 0)
      serve_decks({.socket = pair.theirs.get(),
                   .parent = self,
                   .folder = cell.c_str(),
                   .time_limit = options.time_limit,
                   .output_limit = options.output_limit});
    socket_ = std::move(pair.ours);
    leftover_.emplace(id_);
  }
  ~Worker() { (void)stop(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// What each deck's folder must be in: the worker can write nowhere else.
  [[nodiscard]] const PrivateFolder& folder() const noexcept { return folder_; }

  /// Runs deck.cir in the folder. After another end than `exited` with code 0 there is no worker.
  ProcessResult run(const std::filesystem::path& folder, std::chrono::milliseconds time_limit) {
    const auto start = Clock::now();
    const std::string request = folder.string();
    // If there is nobody to receive it, there will be no reply either.
    (void)::send(socket_.get(), request.data(), request.size(), MSG_NOSIGNAL);
    ProcessResult result;
    WorkerReply reply;
    if (!readable(socket_, start + time_limit)) {
      result.end = End::timed_out;
      (void)stop();
    } else if (::recv(socket_.get(), &reply, sizeof reply, 0) ==
               static_cast<ssize_t>(sizeof reply)) {
      result.end = reply.end;
      result.code = reply.code;
    } else {
      const std::optional<int> status = stop();
      const bool exited = status && WIFEXITED(*status);
      result.end = exited ? End::exited : End::signalled;
      result.code = exited ? std::max(1, WEXITSTATUS(*status)) : status ? WTERMSIG(*status) : 0;
    }
    result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    result.output = read_log(folder, output_limit_ + 1);
    return result;
  }
  [[nodiscard]] pid_t id() const noexcept { return id_; }

 private:
  /// The status it ended with, unless another has collected it; killed if it has not ended.
  std::optional<int> stop() noexcept {
    if (id_ <= 0) return std::nullopt;
    leftover_.reset();
    ::kill(id_, SIGKILL);
    int status = 0;
    pid_t got = 0;
    do got = ::waitpid(id_, &status, 0);
    while (got < 0 && errno == EINTR);
    id_ = 0;
    return got < 0 ? std::nullopt : std::optional(status);
  }

  PrivateFolder folder_;
  std::size_t output_limit_;
  Descriptor socket_;
  pid_t id_ = 0;
  std::optional<LeftoverChild> leftover_;
};

NgspiceLibrary::NgspiceLibrary(NgspiceLibraryOptions options) : options_(options) {}

NgspiceLibrary::~NgspiceLibrary() = default;

Simulation NgspiceLibrary::run(const std::string& deck) {
  if (worker_ == nullptr) worker_ = std::make_unique<Worker>(options_);
  try {
    const PrivateFolder folder(worker_->folder().path());
    write_file(folder.path() / "deck.cir", deck);
    return accept_log(folder, worker_->run(folder.path(), options_.time_limit), options_.time_limit,
                      options_.output_limit);
  } catch (...) {
    worker_.reset();
    throw;
  }
}

int NgspiceLibrary::worker() const noexcept { return worker_ == nullptr ? 0 : worker_->id(); }

}  // namespace tactile_net
