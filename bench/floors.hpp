/// @file
/// Floors that a benchmark holds.
#pragma once

#include <cstdio>
#include <string>

namespace bench {

/// As printf.
std::string text(const char* format, auto... values) {
  char buffer[400];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

/// What lies between two floors: shown as it comes.
inline void progress(const std::string& line) {
  std::printf("  %s\n", line.c_str());
  std::fflush(stdout);
}

/// Prints each floor beside its limit and remembers whether all of them hold. Where one is missed
/// the reason is printed too, as far as it is known.
class Floors {
 public:
  void at_most(const std::string& what, double value, double limit,
               const std::string& reason = {}) {
    print(what, value, "at most", limit, value <= limit, reason);
  }
  void at_least(const std::string& what, double value, double limit,
                const std::string& reason = {}) {
    print(what, value, "at least", limit, value >= limit, reason);
  }
  void broken(const std::string& what) {
    std::printf("%s: MISS\n", what.c_str());
    all_hold_ = false;
  }
  [[nodiscard]] bool all_hold() const noexcept { return all_hold_; }

 private:
  void print(const std::string& what, double value, const char* sense, double limit, bool holds,
             const std::string& reason) {
    const std::string missed = reason.empty() ? "MISS" : "MISS: " + reason;
    std::printf("%s: %.3g (limit: %s %g) %s\n", what.c_str(), value, sense, limit,
                holds ? "pass" : missed.c_str());
    std::fflush(stdout);
    all_hold_ = all_hold_ && holds;
  }
  bool all_hold_ = true;
};

}  // namespace bench
