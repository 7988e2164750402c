/// @file
/// What a program may be like that calls a simulator. Each is undone where it ends.
#pragma once

#include <csignal>
#include <cstdlib>
#include <optional>
#include <string>

namespace tactile_net {

/// What a caller does with the ends of its children, while this lives.
class Ends {
 public:
  explicit Ends(void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    ::sigaction(SIGCHLD, &action, &before_);
  }
  ~Ends() { ::sigaction(SIGCHLD, &before_, nullptr); }
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;

 private:
  struct sigaction before_ {};
};

/// The process without an environment variable, while this lives.
class Without {
 public:
  explicit Without(const char* name) : name_(name) {
    if (const char* value = std::getenv(name)) value_ = value;
    ::unsetenv(name);
  }
  ~Without() {
    if (value_) ::setenv(name_, value_->c_str(), 1);
  }
  Without(const Without&) = delete;
  Without& operator=(const Without&) = delete;

 private:
  const char* name_;
  std::optional<std::string> value_{};
};

}  // namespace tactile_net
