#include "command_line/help.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "tactile_net/numeric/text.hpp"

namespace tactile_net::tool {
namespace {

constexpr std::size_t entry_indent = 2;

/// Puts the parts of the help below each other.
class Writer {
 public:
  explicit Writer(const TextStyle& style)
      : style_(style), text_column_(style.width >= 60 ? 24U : 6U) {}

  void paragraph(const std::string& text) { text_ += wrapped(text, style_.width, 0, 0) + "\n"; }

  void heading(const std::string& text) { text_ += "\n" + bold(text) + ":\n"; }

  void indented(const std::string& text) {
    text_ += std::string(entry_indent, ' ') +
             wrapped(text, style_.width, entry_indent, entry_indent) + "\n";
  }

  /// "  --out FOLDER   Folder for ...", the text on a line of its own where there is no room.
  void entry(const std::string& name, const std::string& value, const std::string& text) {
    std::string head = wrapped(name + (value.empty() ? "" : " " + value), style_.width,
                               2 * entry_indent + 2, entry_indent);
    const std::size_t length = entry_indent + head.size();
    const bool fits = length + 2 <= text_column_ && head.find('\n') == std::string::npos;
    head.replace(0, name.size(), bold(name));
    text_ +=
        std::string(entry_indent, ' ') + head +
        (fits ? std::string(text_column_ - length, ' ') : "\n" + std::string(text_column_, ' ')) +
        wrapped(text, style_.width, text_column_, text_column_) + "\n";
  }

  /// A command to be copied: its lines end as a shell wants them where it does not fit.
  void example(const std::string& line, const std::string& text) {
    std::string lines = wrapped(line, style_.width - 2, 2 * entry_indent + 2, entry_indent);
    for (std::size_t end = 0; (end = lines.find('\n', end)) != std::string::npos; end += 3)
      lines.insert(end, " \\");
    text_ += std::string(entry_indent, ' ') + lines + "\n";
    text_ += std::string(2 * entry_indent + 2, ' ') +
             wrapped(text, style_.width, 2 * entry_indent + 2, 2 * entry_indent + 2) + "\n";
  }

  [[nodiscard]] std::string text() && { return std::move(text_); }

 private:
  [[nodiscard]] std::string bold(const std::string& text) const {
    return style_.bold ? "\033[1m" + text + "\033[0m" : text;
  }

  TextStyle style_;
  std::size_t text_column_;
  std::string text_;
};

void add_entry(Writer& writer, const Argument& argument) {
  writer.entry(join(argument.names, ", "), argument.is_option() ? argument.value.shown() : "",
               sentence_of(argument));
}

}  // namespace

std::string sentence_of(const CommandTable& command) { return command.text + "."; }

std::string sentence_of(const Argument& argument) {
  return argument.text + (argument.standard.empty() || argument.required
                              ? ""
                              : " (default: " + argument.standard + ")");
}

std::string help_text(const CommandLine& line, const CommandTable* command,
                      const TextStyle& style) {
  Writer writer(style);
  const std::string usage =
      command != nullptr ? CommandLine::usage(*command) : "COMMAND [OPTIONS] ...";
  writer.paragraph("usage: " + line.program + " " + usage);
  writer.paragraph("");
  writer.paragraph(command != nullptr ? sentence_of(*command) : line.text + ".");
  if (command == nullptr) {
    writer.heading("commands");
    for (const CommandTable& one : line.commands) writer.entry(one.name, "", sentence_of(one));
  }
  const std::vector<const Argument*> arguments = line.arguments(command);
  const auto options = [](const Argument* argument) { return argument->is_option(); };
  if (!std::all_of(arguments.begin(), arguments.end(), options)) {
    writer.heading("arguments");
    for (const Argument* argument : arguments)
      if (!argument->is_option()) add_entry(writer, *argument);
  }
  writer.heading("options");
  for (const Argument* argument : arguments)
    if (argument->is_option()) add_entry(writer, *argument);
  if (command == nullptr) {
    for (const Section& section : line.sections) {
      writer.heading(section.heading);
      writer.indented(section.text);
    }
    return std::move(writer).text();
  }
  writer.heading("examples");
  for (const Example& example : command->examples)
    writer.example(line.program + " " + example.line, example.text);
  writer.heading("more");
  std::vector<std::string> pages;
  for (const std::string& page : command->pages) pages.push_back("docs/" + page);
  writer.indented(join(pages, ", "));
  return std::move(writer).text();
}

}  // namespace tactile_net::tool
