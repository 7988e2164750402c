#include <unistd.h>

#include <iostream>
#include <string>
#include <vector>

#include "run_command.hpp"

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  const std::vector<std::string> arguments(argv + (argc > 0), argv + argc);
  return tactile_net::tool::run_command(
      arguments, {.in = std::cin,
                  .out = std::cout,
                  .err = std::cerr,
                  .terminal = ::isatty(STDERR_FILENO) == 1,
                  .somebody = ::isatty(STDERR_FILENO) == 1 && ::isatty(STDIN_FILENO) == 1,
                  .style = tactile_net::tool::style_of(STDOUT_FILENO)});
}
