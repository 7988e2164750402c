/// @file
/// A stream of text line by line, in constant memory. Private.
#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net::frames {

class TextLines {
 public:
  static constexpr std::size_t longest = std::size_t{1} << 20;  // bytes
  enum class Got { line, end, too_long, failure };

  explicit TextLines(std::istream& in) : in_(in), buffer_(longest) {}

  /// The next line that holds anything, without its end ("\n" or "\r\n") and, of the first one, the
  /// byte order mark of UTF-8.
  [[nodiscard]] Got next() {
    do {
      in_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
      const auto got = static_cast<std::size_t>(in_.gcount());
      line_ = {};
      if (got == 0 && in_.eof()) return Got::end;
      bytes_ += got;
      ++number_;
      if (in_.bad()) return Got::failure;
      const bool is_whole = !in_.fail() || in_.eof();
      line_ = {buffer_.data(), got - (in_.eof() || !is_whole || got == 0 ? 0 : 1)};
      if (number_ == 1) {
        start_ = line_.substr(0, 64);
        if (line_.starts_with(byte_order_mark)) line_.remove_prefix(byte_order_mark.size());
      }
      if (!is_whole) return Got::too_long;
      if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    } while (line_.empty());
    return Got::line;
  }

  /// Valid until the next call of `next`; of a line that is too long its beginning.
  [[nodiscard]] std::string_view line() const noexcept { return line_; }
  /// From 1; 0: nothing was read yet.
  [[nodiscard]] std::size_t number() const noexcept { return number_; }
  /// The first bytes of the first line.
  [[nodiscard]] const std::string& start() const noexcept { return start_; }
  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }

 private:
  static constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

  std::istream& in_;
  std::vector<char> buffer_;
  std::string_view line_;
  std::string start_;
  std::size_t number_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace tactile_net::frames
