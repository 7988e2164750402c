/// @file
/// How a command ends other than well, besides what the libraries throw.
#pragma once

#include <stdexcept>
#include <string>

namespace tactile_net::tool {

/// A check did not hold; everything that could be reported has been. Exit status 1.
class CheckFailed : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The command line asks for what there is not. Exit status 2, with a hint to --help.
class WrongUsage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  WrongUsage(const std::string& option, const std::string& message)
      : std::runtime_error(option + ": " + message) {}
};

}  // namespace tactile_net::tool
