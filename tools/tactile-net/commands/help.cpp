#include "commands/help.hpp"

#include <ostream>

#include "command_line/help.hpp"
#include "command_line/man_page.hpp"
#include "failure.hpp"
#include "options.hpp"

namespace tactile_net::tool {

void run(const HelpOptions& options, const Streams& streams) {
  if (options.man && !options.command.empty())
    throw WrongUsage("--man", "is one page of all commands: leave out '" + options.command + "'");
  const CommandLine& line = command_line();
  streams.out << (options.man ? man_page(line)
                              : help_text(line, line.find(options.command), streams.style));
}

void run(const CompletionOptions& options, const Streams& streams) {
  streams.out << completion_script(command_line(), options.shell);
}

void run(const ReleaseOptions& /*options*/, const Streams& streams) {
  streams.out << command_line().version << '\n';
}

}  // namespace tactile_net::tool
