#include "command_line/man_page.hpp"

#include <algorithm>
#include <string_view>

#include "command_line/help.hpp"
#include "numeric/lower_case.hpp"
#include "tactile_net/numeric/version.hpp"

namespace tactile_net::tool {
namespace {

/// What roff would take for its own, or print as another character.
std::string escaped(std::string_view text) {
  std::string out;
  if (text.starts_with('.') || text.starts_with('\'')) out = "\\&";
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '\'')
      out += "\\(aq";
    else if (c == '`')
      out += "\\(ga";
    else if (c == '^')
      out += "\\(ha";
    else if (c == '~')
      out += "\\(ti";
    else if (c == '"')
      out += "\\(dq";
    else
      out += c;
  }
  return out;
}

std::string bold(std::string_view text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// "\fB\-o\fR, \fB\-\-output\fR \fIFILE\fR"
std::string head(const Argument& argument) {
  if (!argument.is_option()) return italic(argument.name());
  std::string text;
  for (const std::string& name : argument.names) text += (text.empty() ? "" : ", ") + bold(name);
  return argument.is_flag() ? text : text + " " + italic(argument.value.shown());
}

void add_entry(std::string& page, const std::string& head, const std::string& text) {
  page += ".TP\n" + head + "\n" + escaped(text) + "\n";
}

void add_command(std::string& page, const CommandLine& line, const CommandTable& command) {
  page += ".SS \"" + escaped(CommandLine::usage(command)) + "\"\n";
  page += escaped(sentence_of(command)) + "\n";
  for (const Argument& argument : command.arguments)
    add_entry(page, head(argument), sentence_of(argument));
  for (const Example& example : command.examples)
    page += ".PP\n" + escaped(example.text) + ":\n.PP\n.nf\n.RS\n" +
            escaped(line.program + " " + example.line) + "\n.RE\n.fi\n";
  page += ".PP\nSee";
  for (const std::string& one : command.pages)
    page += (&one == &command.pages.front() ? " " : ", ") + escaped("docs/" + one);
  page += ".\n";
}

}  // namespace

std::string man_page(const CommandLine& line) {
  std::string page = ".\\\" Made by: " + line.program + " help --man\n";
  page += ".TH " + escaped(upper(line.program)) + " 1 \"\" \"" +
          escaped(line.program + " " + std::string(version())) + "\" \"User Commands\"\n";
  std::string summary = line.text;
  summary.front() = lower_case(summary.front());
  page += ".SH NAME\n" + escaped(line.program) + " \\- " + escaped(summary) + "\n";
  page += ".SH SYNOPSIS\n" + bold(line.program) + " " + italic("COMMAND") + " [" +
          italic("OPTIONS") + "] ...\n";
  page += ".SH OPTIONS\n";
  for (const Argument* argument : line.arguments(nullptr))
    add_entry(page, head(*argument), sentence_of(*argument));
  page += ".SH COMMANDS\n";
  for (const CommandTable& command : line.commands) add_command(page, line, command);
  for (const Section& section : line.sections)
    page += ".SH " + escaped(upper(section.heading)) + "\n" + escaped(section.text) + "\n";
  return page;
}

}  // namespace tactile_net::tool
