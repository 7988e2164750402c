#include "simulator/cell.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "tactile_net/simulator/confinement.hpp"

#if defined(__x86_64__)
#define TACTILE_NET_ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define TACTILE_NET_ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

namespace tactile_net {
namespace {

// Landlock's interface, as linux/landlock.h of a newer kernel than this may have been built on. The
// kernel tells its version and refuses what it does not know.
constexpr long create_ruleset = 444;
constexpr long add_rule = 445;
constexpr long restrict_self = 446;
constexpr unsigned ask_version = 1;
constexpr int path_beneath = 1;

struct Ruleset {
  std::uint64_t files;
  std::uint64_t ports;   // from version 4
  std::uint64_t scopes;  // from version 6
};
struct [[gnu::packed]] PathBeneath {
  std::uint64_t allowed;
  std::int32_t parent;
};

namespace access_right {
constexpr std::uint64_t write_file = 1U << 1;
constexpr std::uint64_t remove_and_make = 0x1FF0;  // directories, files, links, devices, sockets
constexpr std::uint64_t refer = 1U << 13;          // from version 2: to another folder
constexpr std::uint64_t truncate = 1U << 14;       // from version 3
}  // namespace access_right

constexpr std::uint64_t bind_and_connect = 3;
constexpr std::uint64_t abstract_sockets_and_signals = 3;

int version_of_landlock() noexcept {
  const long version = ::syscall(create_ruleset, nullptr, 0, ask_version);
  return version < 0 ? 0 : static_cast<int>(version);
}

/// Allows what is below a path; a path that is not there needs no permission.
bool allow(int ruleset, const char* path, std::uint64_t rights) noexcept {
  const int parent = ::open(path, O_PATH | O_CLOEXEC);
  if (parent < 0) return errno == ENOENT;
  const PathBeneath rule{rights, parent};
  const bool done = ::syscall(add_rule, ruleset, path_beneath, &rule, 0) == 0;
  const int reason = errno;
  ::close(parent);
  errno = reason;
  return done;
}

#ifdef TACTILE_NET_ARCHITECTURE

constexpr std::uint32_t permit = SECCOMP_RET_ALLOW;
constexpr std::uint32_t refuse = SECCOMP_RET_ERRNO | EPERM;
constexpr std::uint32_t not_there = SECCOMP_RET_ERRNO | ENOSYS;

/// What no simulation needs: other processes, sockets, and ways around the filter.
constexpr std::array refused_calls = {
#ifdef __x86_64__
    SYS_fork,
    SYS_vfork,
#endif
    SYS_execveat,
    SYS_socket,
    SYS_kill,
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_mount,
    SYS_unshare,
    SYS_setns,
    SYS_bpf,
    SYS_userfaultfd,
    SYS_perf_event_open,
    SYS_io_uring_setup,
    SYS_keyctl,
    SYS_add_key,
    SYS_request_key,
    SYS_setpgid,
    SYS_setsid,
};

/// A filter's instructions, in the order in which they are run.
class Filter {
 public:
  void load(std::size_t offset) noexcept {
    add(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
  }
  void end(std::uint32_t action) noexcept { add(BPF_STMT(BPF_RET | BPF_K, action)); }
  /// If what was loaded is `value`, goes over the next `over` instructions, otherwise over `other`.
  void equal(std::uint32_t value, std::uint8_t over, std::uint8_t other) noexcept {
    add(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, over, other));
  }
  void any_bit(std::uint32_t bits, std::uint8_t over, std::uint8_t other) noexcept {
    add(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, over, other));
  }
  void end_if_equal(std::uint32_t value, std::uint32_t action) noexcept {
    equal(value, 0, 1);
    end(action);
  }
  /// Refuses unless the call's argument is the pointer.
  void refuse_unless(int argument, const void* pointer) noexcept {
    const auto value = std::bit_cast<std::uint64_t>(pointer);
    const std::size_t low = offsetof(seccomp_data, args) + 8U * static_cast<std::size_t>(argument);
    load(low);
    equal(static_cast<std::uint32_t>(value), 1, 0);
    end(refuse);
    load(low + 4);
    equal(static_cast<std::uint32_t>(value >> 32U), 1, 0);
    end(refuse);
  }
  [[nodiscard]] sock_fprog program() noexcept { return {size_, code_.data()}; }

 private:
  void add(sock_filter instruction) noexcept { code_[size_++] = instruction; }

  std::array<sock_filter, 96> code_{};
  unsigned short size_ = 0;
};

/// Of what is loaded, the call's number: refuses what a simulation does not need.
void refuse_processes(Filter& filter, const OnlyProgram& only) noexcept {
  for (const long call : refused_calls)
    filter.end_if_equal(static_cast<std::uint32_t>(call), refuse);
  // The C library falls back to clone, whose flags a filter can read.
  filter.end_if_equal(SYS_clone3, not_there);
  // Threads stay: ngspice computes its larger device models with them.
  filter.equal(SYS_clone, 0, 4);
  filter.load(offsetof(seccomp_data, args));
  filter.any_bit(CLONE_THREAD, 1, 0);
  filter.end(refuse);
  filter.end(permit);
  if (only.path == nullptr) {
    filter.end_if_equal(SYS_execve, refuse);
  } else {
    filter.equal(SYS_execve, 0, 13);
    filter.refuse_unless(0, only.path);
    filter.refuse_unless(1, only.arguments);
    filter.end(permit);
  }
}

Filter filter_for(const Cell& cell) noexcept {
  Filter filter;
  filter.load(offsetof(seccomp_data, arch));
  filter.equal(TACTILE_NET_ARCHITECTURE, 1, 0);
  // The calls of another architecture have other numbers. A script may start such a program.
  filter.end(cell.starts_nothing ? refuse : permit);
  filter.load(offsetof(seccomp_data, nr));
#ifdef __x86_64__
  constexpr std::uint32_t x32 = 0x40000000;
  filter.any_bit(x32, 0, 1);
  filter.end(refuse);
#endif
  if (cell.starts_nothing) refuse_processes(filter, cell.only);
  if (cell.listener != nullptr) {
    constexpr std::uint32_t without_a_name = O_TMPFILE & ~O_DIRECTORY;
    constexpr std::size_t flags = offsetof(seccomp_data, args) + 16;
    filter.equal(SYS_openat, 0, 3);
    filter.load(flags);
    filter.any_bit(without_a_name, 0, 1);
    filter.end(SECCOMP_RET_USER_NOTIF);
  }
  filter.end(permit);
  return filter;
}

bool has_seccomp() noexcept {
  constexpr unsigned ask_action = 2;
  const std::uint32_t action = SECCOMP_RET_ERRNO;
  return ::syscall(SYS_seccomp, ask_action, 0, &action) == 0;
}

/// @return 0 or errno; where there can be no listener, there is a filter without
int confine_calls(const Cell& cell) noexcept {
  if (!has_seccomp() || (!cell.starts_nothing && cell.listener == nullptr)) return 0;
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return errno;
  if (cell.listener != nullptr) {
    Filter filter = filter_for(cell);
    const sock_fprog program = filter.program();
    *cell.listener = static_cast<int>(::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER,
                                                SECCOMP_FILTER_FLAG_NEW_LISTENER, &program));
    if (*cell.listener >= 0) return 0;
    Cell alone = cell;
    alone.listener = nullptr;
    return confine_calls(alone);
  }
  Filter filter = filter_for(cell);
  const sock_fprog program = filter.program();
  return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0 ? 0 : errno;
}

#endif

/// @param in_tmp  files without a name in /tmp must be allowed, for want of who would make them
int confine_files(const char* folder, bool in_tmp) noexcept {
  const int version = version_of_landlock();
  if (version < 1) return 0;
  std::uint64_t rights = access_right::write_file | access_right::remove_and_make;
  if (version >= 2) rights |= access_right::refer;
  if (version >= 3) rights |= access_right::truncate;
  const Ruleset rules{rights, version >= 4 ? bind_and_connect : 0,
                      version >= 6 ? abstract_sockets_and_signals : 0};
  const std::size_t size = version >= 6   ? sizeof rules
                           : version >= 4 ? offsetof(Ruleset, scopes)
                                          : offsetof(Ruleset, ports);
  const int ruleset = static_cast<int>(::syscall(create_ruleset, &rules, size, 0));
  if (ruleset < 0) return errno;
  constexpr std::uint64_t of_a_file = access_right::write_file | access_right::truncate;
  const bool done = (folder == nullptr || allow(ruleset, folder, rights)) &&
                    allow(ruleset, "/dev/null", rights & of_a_file) &&
                    (!in_tmp || allow(ruleset, P_tmpdir, access_right::write_file)) &&
                    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                    ::syscall(restrict_self, ruleset, 0) == 0;
  const int reason = errno;
  ::close(ruleset);
  return done ? 0 : reason;
}

}  // namespace

int confine(const Cell& cell) noexcept {
  if (cell.listener != nullptr) *cell.listener = -1;
#ifdef TACTILE_NET_ARCHITECTURE
  if (const int reason = confine_calls(cell); reason != 0) return reason;
#endif
  return confine_files(cell.folder, cell.listener != nullptr && *cell.listener < 0);
}

void serve_temporary_file(int listener) noexcept {
  // The kernel's structures may be longer than this header's.
  union Request {
    seccomp_notif call;
    std::array<char, 512> room;
  } request{.room = {}};
  union Answer {
    seccomp_notif_resp call;
    std::array<char, 512> room;
  } answer{.room = {}};
  if (::ioctl(listener, SECCOMP_IOCTL_NOTIF_RECV, &request) != 0) return;
  answer.call.id = request.call.id;
  const int file = ::memfd_create("tmpfile", MFD_CLOEXEC);
  if (file >= 0) {
    seccomp_notif_addfd given{};
    given.id = request.call.id;
    given.srcfd = static_cast<std::uint32_t>(file);
    answer.call.val = ::ioctl(listener, SECCOMP_IOCTL_NOTIF_ADDFD, &given);
  }
  if (file < 0 || answer.call.val < 0) {
    answer.call.val = 0;
    answer.call.error = -EACCES;
  }
  ::ioctl(listener, SECCOMP_IOCTL_NOTIF_SEND, &answer);
  if (file >= 0) ::close(file);
}

Confinement confinement() noexcept {
  static const Confinement offered = [] {
    Confinement all;
    all.files = version_of_landlock() >= 1;
#ifdef TACTILE_NET_ARCHITECTURE
    all.processes = has_seccomp();
#endif
    return all;
  }();
  return offered;
}

}  // namespace tactile_net
