#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net {
namespace {

std::string all_texts(const std::vector<Diagnostic>& diagnostics) {
  std::string all;
  for (const Diagnostic& diagnostic : diagnostics) all += text(diagnostic);
  return all;
}

}  // namespace

std::string text(const Diagnostic& diagnostic) {
  constexpr std::size_t widest = 160;
  std::string out = diagnostic.file;
  if (diagnostic.line > 0) {
    out += ':' + std::to_string(diagnostic.line);
    if (diagnostic.column > 0) out += ':' + std::to_string(diagnostic.column);
  }
  out += ": error: " + diagnostic.message + '\n';
  if (!diagnostic.source.empty() && diagnostic.column > 0 && diagnostic.column <= widest) {
    const std::string shown = diagnostic.source.substr(0, widest);
    std::string caret;
    for (std::size_t i = 0; i + 1 < diagnostic.column && i < shown.size(); ++i)
      caret += shown[i] == '\t' ? '\t' : ' ';
    out += "  " + shown + "\n  " + caret + "^\n";
  }
  if (!diagnostic.hint.empty()) out += "  hint: " + diagnostic.hint + '\n';
  return out;
}

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(all_texts(diagnostics)), diagnostics_(std::move(diagnostics)) {}

}  // namespace tactile_net
