#include "tactile_net/scene/diagnostic.hpp"

#include <algorithm>
#include <utility>

#include "scene/excerpt.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net {

namespace {

/// Blanks up to the column, as many as the printed characters take, tabs kept: so the caret stands
/// below its character whatever the terminal's tab width.
std::string caret(std::string_view line, std::size_t column) {
  std::string result;
  std::size_t at = 1;
  for (std::size_t byte = 0; at < column && byte < line.size(); ++at) {
    const std::size_t size = std::max<std::size_t>(1, code_point_size(line.substr(byte)));
    if (line[byte] == '\t')
      result += '\t';
    else
      result.append(code_points(printable(line.substr(byte, size))), ' ');
    byte += size;
  }
  return result + '^';
}

std::string all_texts(const std::vector<Diagnostic>& diagnostics) {
  std::string result;
  for (const Diagnostic& diagnostic : diagnostics) result += text(diagnostic);
  return result;
}

}  // namespace

std::string text(const Diagnostic& diagnostic) {
  std::string result = printable(diagnostic.file);
  if (diagnostic.line > 0) {
    result += ':' + std::to_string(diagnostic.line);
    if (diagnostic.column > 0) result += ':' + std::to_string(diagnostic.column);
  }
  result += ": error: " + printable(diagnostic.message) + '\n';

  if (!diagnostic.source.empty()) {
    const std::size_t offset = diagnostic.source_column - 1;
    const std::size_t column = diagnostic.column > offset ? diagnostic.column - offset : 0;
    const Excerpt part = excerpt(diagnostic.source, column);
    result += printable(part.text) + '\n';
    if (column > 0) result += caret(part.text, column - part.column + 1) + '\n';
  }
  if (!diagnostic.hint.empty()) result += "hint: " + printable(diagnostic.hint) + '\n';
  return result;
}

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error{all_texts(diagnostics)}, diagnostics_{std::move(diagnostics)} {}

}  // namespace tactile_net
