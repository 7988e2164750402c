#include <iostream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "commands/commands.hpp"
#include "tactile_net/frames/failure.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/nearest.hpp"

namespace {

enum ExitStatus { done = 0, failed = 1, wrong_usage = 2 };

/// CLI11 only says that a sub-command is required; say which one was meant.
void check_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  for (const std::string& name : names)
    if (name == argv[1]) return;
  const std::vector<std::string_view> known(names.begin(), names.end());
  std::string text = "there is no command '" + std::string(argv[1]) + "'";
  const std::string near(tactile_net::nearest(argv[1], known));
  if (!near.empty()) text += "; did you mean '" + near + "'?";
  throw CLI::ParseError(text, wrong_usage);
}

int run(int argc, char** argv) {
  CLI::App app(
      "Surface tractions from buried tactile sensors, in software and as a circuit.\n"
      "Any consistent set of units; results on standard output, messages on standard error.\n"
      "Exit status: 0 done, 1 a computation or a check failed, 2 wrong usage or bad input.",
      "tactile-net");
  app.set_version_flag("--version", "tactile-net " + std::string(tactile_net::version()));
  app.require_subcommand(1);
  tactile_net::tool::add_run(app);
  tactile_net::tool::add_gen(app);
  tactile_net::tool::add_relax(app);
  tactile_net::tool::add_certify(app);
  tactile_net::tool::add_simulate(app);
  tactile_net::tool::add_solve(app);
  tactile_net::tool::add_identify(app);
  tactile_net::tool::add_plan(app);
  tactile_net::tool::add_tradeoff(app);
  tactile_net::tool::add_grasp(app);
  try {
    check_command(app, argc, argv);
    app.parse(argc, argv);
    if (!std::cout.flush()) throw std::runtime_error("standard output could not be written");
    return done;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    std::cerr << "tactile-net: error: " << error.what()
              << "\nhint: tactile-net --help, or tactile-net COMMAND --help\n";
    return wrong_usage;
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  try {
    return run(argc, argv);
  } catch (const tactile_net::InputError& error) {
    std::cerr << error.what();
    return wrong_usage;
  } catch (const tactile_net::frames::CannotCreate& error) {
    std::cerr << error.what() << '\n';
    return wrong_usage;
  } catch (const std::invalid_argument& error) {
    std::cerr << "tactile-net: error: " << error.what() << '\n';
    return wrong_usage;
  } catch (const std::exception& error) {
    std::cerr << "tactile-net: error: " << error.what() << '\n';
    return failed;
  }
}
