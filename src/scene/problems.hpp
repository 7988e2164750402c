/// @file
/// Collects what is wrong with one file, to be reported all at once.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net {

/// A place in the text: line and column in code points, from 1; line 0 is the file as a whole.
struct Place {
  std::size_t line = 0;
  std::size_t column = 0;
};

/// What a file is, for messages.
struct FileKind {
  std::string_view name;      ///< "scene"
  std::string_view smallest;  ///< what the smallest one holds
};

inline constexpr FileKind scene_file{
    "scene",
    "the smallest scene is [sensor] with count, pitch, depth and reads, and [material] with "
    "youngs_modulus and poisson_ratio"};

/// A key that nobody asked for.
struct UnknownKey {
  std::string path{};   ///< "sensor.deth"
  std::string meant{};  ///< "did you mean depth?"; empty: no other is near
};

class Problems {
 public:
  /// `text` must outlive the object.
  Problems(std::string file, std::string_view text, const FileKind& kind = scene_file);

  [[nodiscard]] const FileKind& kind() const noexcept { return kind_; }

  void add(Place place, std::string message, std::string hint = {});

  /// A key that nobody asked for: a problem that is remembered by its path too.
  void add_unknown(Place place, std::string message, std::string hint, UnknownKey key);
  [[nodiscard]] const std::vector<UnknownKey>& unknown_keys() const noexcept { return unknown_; }

  /// The unit that a number stands in, for who asks what a key is measured in.
  void note_unit(std::string_view path, std::string_view unit);
  /// As they were noted: paths, units; "" for what has none.
  [[nodiscard]] const std::vector<std::pair<std::string, std::string_view>>& units()
      const noexcept {
    return units_;
  }

  /// What the file says from `from` up to `to`, if that is one line; a long text is cut.
  [[nodiscard]] std::string written(Place from, Place to) const;

  [[nodiscard]] bool none() const noexcept { return diagnostics_.empty(); }

  /// @throw InputError  if there is a problem: in the file's order, none twice, at most 100
  void throw_if_any();

 private:
  [[nodiscard]] std::string_view line(std::size_t number) const;

  std::string file_;
  std::string_view text_;
  FileKind kind_;
  std::vector<std::size_t> line_starts_;
  std::vector<Diagnostic> diagnostics_;
  std::vector<UnknownKey> unknown_{};
  std::vector<std::pair<std::string, std::string_view>> units_{};
  std::size_t left_off_ = 0;
};

/// `text` in double quotes, for messages; a long text is cut.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// The names in double quotes, with commas: for hints.
[[nodiscard]] std::string listed(const std::vector<std::string_view>& names);

}  // namespace tactile_net
