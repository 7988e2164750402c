#include "tests/cli/in_process.hpp"

#include <sstream>

#include "tools/tactile-net/run_command.hpp"

namespace tactile_net::test {

ProcessResult run_in_process(const std::vector<std::string>& arguments, const std::string& input,
                             bool somebody) {
  std::istringstream in(input);
  std::ostringstream out;
  std::ostringstream err;
  ProcessResult result;
  result.code =
      tool::run_command(arguments, {.in = in, .out = out, .err = err, .somebody = somebody});
  result.output = out.str();
  result.errors = err.str();
  return result;
}

}  // namespace tactile_net::test
