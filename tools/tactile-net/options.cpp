#include "options.hpp"

#include <utility>
#include <vector>

#include "command_line/all_commands.hpp"
#include "command_line/parser.hpp"
#include "tactile_net/numeric/fft.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/report/json/schema.hpp"
#include "tactile_net/report/words/confinement_words.hpp"

namespace tactile_net::tool {

void add_schema(AllCommands& all) {
  auto [command, options] = all.add<SchemaOptions>(
      {.name = "schema",
       .text = "Print the JSON Schema of a document that another command writes: its keys, their "
               "meanings and their units",
       .pages = {"results.md"},
       .examples = {{"schema", "the kinds of documents, a line each"},
                    {"schema check", "the schema of the document that check --json writes"}}});
  const auto kinds = report::schema_kinds();
  command.add_option("KIND", options.kind, choice({kinds.begin(), kinds.end()}),
                     "The document's kind (default: list all kinds, a line each)");
}

void add_completion(AllCommands& all) {
  auto [command, options] = all.add<CompletionOptions>(
      {.name = "completion",
       .text = "Print the script with which a shell completes commands, options, their values and "
               "files; an installed tactile-net has it installed too",
       .pages = {"terminal.md"},
       .examples = {{"completion bash > ~/.tactile-net.bash",
                     "for bash, with source ~/.tactile-net.bash in ~/.bashrc"},
                    {"completion zsh > ~/.zfunc/_tactile-net",
                     "for zsh, with fpath+=(~/.zfunc) before compinit in ~/.zshrc"}}});
  command.add_choice("SHELL", options.shell, shells, "Which shell").required = true;
}

void add_help(AllCommands& all) {
  auto [command, options] = all.add<HelpOptions>(
      {.name = "help",
       .text = "Print what a command does and which options it takes, with examples",
       .pages = {"terminal.md"},
       .examples = {{"help solve", "the same as solve --help"},
                    {"help --man > tactile-net.1", "the manual page; man -l tactile-net.1"}}});
  std::vector<std::string> names;
  for (const CommandTable& one : all.line.commands) names.push_back(one.name);
  command.add_option("COMMAND", options.command, choice(std::move(names)),
                     "The command (default: list all commands, a line each)");
  command.add_flag("--man", options.man, "Print the manual page, in roff");
}

AllCommands::AllCommands() {
  line.program = "tactile-net";
  line.text = "Surface tractions from buried tactile sensors, in software and as a circuit";
  line.version = "tactile-net " + std::string(version()) +
                 "\nFFT: " + std::string(name(fft_library())) + "\n" +
                 report::in_words(confinement());
  line.help = {.names = {"-h", "--help"}, .text = "Print this help"};
  line.release = {.names = {"-V", "--version"},
                  .text = "Print the version, the FFT, and what confines ngspice"};
  line.quiet = {.names = {"-q", "--quiet"},
                .text = "Print no notes, warnings or progress: only errors go to standard error",
                .set = [this](const std::string&) { quiet = true; }};
  line.sections = {
      {"units",
       "Use any consistent set: lengths in the unit of the pitch, stresses and tractions in that "
       "of Young's modulus E. Results go to standard output, messages to standard "
       "error."},
      {"exit status", "0: done. 1: a computation or a check failed. 2: wrong usage or bad input."},
      {"environment",
       "NO_COLOR: no bold text. COLUMNS: the width of help when it does not go to a terminal. "
       "TMPDIR: the place of ngspice's private folders."},
      {"more", "help COMMAND, with examples; docs/terminal.md, docs/scene.md, docs/results.md"}};
  for (const auto add_to :
       {add_init,  add_check,   add_solve,    add_report,   add_identify,   add_calibrate, add_plan,
        add_grasp, add_run,     add_simulate, add_tradeoff, add_sweep,      add_merge,     add_gen,
        add_relax, add_certify, add_bench,    add_schema,   add_completion, add_help})
    add_to(*this);
}

Invocation parse(std::span<const std::string> arguments) {
  AllCommands all;
  const Parsed parsed = parse(all.line, arguments);
  Command command = ReleaseOptions{};
  if (parsed.help)
    command = HelpOptions{.command = parsed.command == nullptr ? "" : parsed.command->name};
  else if (!parsed.release)
    command = *all.command;
  return {std::move(command), all.quiet};
}

const CommandLine& command_line() {
  static const AllCommands all;
  return all.line;
}

}  // namespace tactile_net::tool
