#include "run_command.hpp"

#include <ostream>
#include <stdexcept>

#include "failure.hpp"
#include "option_words.hpp"
#include "options.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "terminal/interruption.hpp"
#include "terminal/printable_stream.hpp"

namespace tactile_net::tool {
namespace {

enum ExitStatus { done = 0, failed = 1, wrong_usage = 2 };

/// The command line, quoted where a shell would need it.
std::string typed(std::span<const std::string> arguments) {
  std::string line = "tactile-net";
  for (const std::string& argument : arguments) line += ' ' + shell_word(argument);
  return line;
}

/// Which help would have told.
std::string hint_of(std::span<const std::string> arguments) {
  for (const std::string& one : arguments)
    if (command_line().find(one) != nullptr) return "help " + one;
  return "help";
}

}  // namespace

int run_command(std::span<const std::string> arguments, const Streams& given) {
  const Interruption interruption;
  spell_options(spelled);
  PrintableStream err(given.err);
  std::ostream nowhere(nullptr);
  const auto tell = [&](const std::exception& error) -> std::ostream& {
    return err << "tactile-net: error: " << error.what() << '\n';
  };
  try {
    const Invocation invocation = parse(arguments);
    const Streams streams{.in = given.in,
                          .out = given.out,
                          .err = invocation.quiet ? nowhere : err,
                          .terminal = given.terminal && !invocation.quiet,
                          .somebody = given.somebody && !invocation.quiet,
                          .screen = &given.err,
                          .command = typed(arguments),
                          .style = given.style};
    std::visit([&](const auto& options) { run(options, streams); }, invocation.command);
    if (!given.out.flush()) throw std::runtime_error("standard output could not be written");
    return done;
  } catch (const WrongUsage& error) {
    tell(error) << "hint: tactile-net " << hint_of(arguments) << '\n';
    return wrong_usage;
  } catch (const InputError& error) {
    err << error.what();
    return wrong_usage;
  } catch (const frames::CannotCreate& error) {
    err << error.what() << '\n';
    return wrong_usage;
  } catch (const std::invalid_argument& error) {
    tell(error);
    return wrong_usage;
  } catch (const std::exception& error) {
    tell(error);
    return failed;
  }
}

}  // namespace tactile_net::tool
