/// @file
/// Frames as NumPy's .npy: one array of shape (frames, columns), C order, little-endian doubles.
///
/// The format is NEP 1's version 1.0, its header padded to 128 bytes, so that the data are aligned
/// and numpy.load may map them. There is no column of times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/frames/source.hpp"

namespace tactile_net::frames {

/// Whether a file begins as a .npy does, by its first byte, which no text begins with.
[[nodiscard]] bool begins_like_npy(std::istream& in);

/// Whether a file is to be a .npy, by its name.
[[nodiscard]] bool is_npy_name(const std::string& path);

/// Reads versions 1 to 3, doubles or floats ("<f8", "<f4").
class NpyFrames final : public FrameSource {
 public:
  /// Reads the header.
  ///
  /// @param columns, unread  as for `CsvFrames`; the array has these columns in this order
  /// @throw InputError  not a .npy, no array of two dimensions in C order, another type, another
  ///                    number of columns, or not as long as its header says
  NpyFrames(std::istream& in, std::string file, std::vector<std::string> columns,
            std::vector<bool> unread = {});

  [[nodiscard]] bool next(std::span<double> values) override;
  [[noreturn]] void refuse(const std::string& message, const std::string& hint) const override;
  [[nodiscard]] std::span<const std::string> columns() const noexcept override { return columns_; }

 private:
  [[noreturn]] void fail(const std::string& message, const std::string& hint) const;

  std::istream& in_;
  std::string file_;
  std::vector<std::string> columns_;
  std::vector<bool> unread_;
  std::size_t width_ = 8;  // bytes of a number
  std::size_t frames_ = 0;
  std::size_t next_ = 0;
  std::vector<unsigned char> row_;
};

/// Writes doubles; how many frames there were is known at the end, so that the file must be one
/// that can be gone back in.
class NpySink final : public FrameSink {
 public:
  NpySink(std::ostream& out, std::size_t columns);
  void add(std::string_view time, std::span<const double> values) override;
  void flush() override;
  void finish() override;

 private:
  std::ostream& out_;
  std::size_t columns_;
  std::size_t frames_ = 0;
  std::string bytes_;
};

}  // namespace tactile_net::frames
