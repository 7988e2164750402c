/// @file
/// What is wrong with an input file, and where.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace tactile_net {

struct Diagnostic {
  std::string file{};
  std::size_t line = 0;           ///< from 1; 0: the file as a whole
  std::size_t column = 0;         ///< in code points, from 1; 0: the line as a whole
  std::string message{};          ///< "sensor.depth must be > 0 (got -1.5)"
  std::string hint{};             ///< what to do; may be empty
  std::string source{};           ///< the line itself, or a part of it; empty: not shown
  std::size_t source_column = 1;  ///< where `source` begins in the line, from 1
};

/// `file:line:column: error: message`, the source line with a caret, `hint: ...`; ends with a
/// newline. A long line is cut around the column; control characters are written as numbers,
/// `\x1b`.
[[nodiscard]] std::string text(const Diagnostic& diagnostic);

/// Bad input; holds every problem that was found, in the file's order. what() is all their texts.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Diagnostic> diagnostics);
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const noexcept { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace tactile_net
