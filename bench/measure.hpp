/// @file
/// Whole processes and in-process rivals, timed in turn. Absolute numbers depend on the machine and
/// its other work: the ratio of medians is what a benchmark here stands for.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace bench {

struct Cost {
  double seconds = 0.0;
  double megabytes = 0.0;  // largest resident set
};

/// Runs a command with its output thrown away. @throw std::runtime_error  it failed
inline Cost run(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) {
    const int nothing = ::open("/dev/null", O_RDWR);
    ::dup2(nothing, STDOUT_FILENO);
    ::dup2(nothing, STDERR_FILENO);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(command.front() + " failed");
  return {elapsed.count(), static_cast<double>(usage.ru_maxrss) / 1024.0};
}

inline Cost in_process(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 0.0};
}

inline Cost median(std::vector<Cost> costs) {
  std::sort(costs.begin(), costs.end(),
            [](const Cost& a, const Cost& b) { return a.seconds < b.seconds; });
  return costs[costs.size() / 2];
}

/// Medians of `runs` runs of ours and of the rival, in turn, after one of each to warm up.
inline std::pair<Cost, Cost> compare(int runs, const std::function<Cost()>& ours,
                                     const std::function<Cost()>& rival) {
  std::vector<Cost> a;
  std::vector<Cost> b;
  (void)ours();
  (void)rival();
  for (int i = 0; i < runs; ++i) {
    a.push_back(ours());
    b.push_back(rival());
  }
  return {median(a), median(b)};
}

/// A file that is removed at the end.
class TemporaryFile {
 public:
  TemporaryFile() {
    const int file = ::mkstemp(name_);
    if (file < 0) throw std::runtime_error("no temporary file can be made");
    ::close(file);
  }
  ~TemporaryFile() { ::unlink(name_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] std::string name() const { return name_; }

 private:
  char name_[32] = "/tmp/tactile-net-bench-XXXXXX";
};

}  // namespace bench
