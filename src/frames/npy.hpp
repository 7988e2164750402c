/// @file
/// Private. Frames as NumPy's .npy: one array of shape (frames, columns).
///
/// Written are doubles in C order, in the format of NEP 1's version 1.0, its header padded to 128
/// bytes, so that the data are aligned and numpy.load may map them. There is no column of times.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/frames/frame_clock.hpp"
#include "tactile_net/frames/source.hpp"

namespace tactile_net::frames {

/// Whether a file begins as a .npy does, by its first byte, which no text begins with.
[[nodiscard]] bool begins_like_npy(std::istream& in);

/// Whether a file is to be a .npy, by its name.
[[nodiscard]] bool is_npy_name(const std::string& path);

/// Reads versions 1 to 3, of whole numbers of every width and floating-point ones of 2, 4 and 8
/// bytes, of either byte order. In C order a frame at a time; in Fortran's order, column after
/// column, in blocks of frames of at most 8 MiB (or one frame), and only from a file that can be
/// gone back in.
///
/// Of a skin on a lattice (frames, rows, columns, channels) too, in C order. An array of shape
/// (frames, channels, taxels) is read as (frames, channels * taxels); one of a
/// single dimension, as long as a frame, is one frame.
class NpyFrames final : public FrameSource {
 public:
  /// Reads the header.
  ///
  /// @param wanted  the array has these columns in this order, or `wanted.places` says where;
  ///                missing is what is not finite
  /// @throw InputError  not a .npy, another type or number of columns, or not as long as its header
  ///                    says
  /// @throw std::invalid_argument  `wanted.places` does not fit the array
  NpyFrames(std::istream& in, std::string file, WantedColumns wanted);

  [[nodiscard]] bool next(std::span<double> values) override;
  [[nodiscard]] InputError refusal(const std::string& message,
                                   const std::string& hint) const override;
  [[nodiscard]] std::span<const std::string> columns() const noexcept override {
    return wanted_.names;
  }
  [[nodiscard]] bool has_time() const noexcept override { return time_at_ != none; }
  [[nodiscard]] std::string_view time() const noexcept override { return time_; }
  [[nodiscard]] std::optional<double> seconds() const override { return clock_.seconds(); }
  [[nodiscard]] bool time_unit_known() const noexcept override { return clock_.unit_known(); }
  [[nodiscard]] std::size_t bytes_read() const noexcept override;
  [[nodiscard]] std::optional<std::size_t> frames() const noexcept override { return frames_; }

 private:
  static constexpr auto none = static_cast<std::size_t>(-1);
  using ReadNumbers = void (*)(const unsigned char*, std::span<const std::size_t>, double*);

  [[noreturn]] void fail(const std::string& message, const std::string& hint) const;
  /// Sets `frames_`; the number of columns of a frame.
  std::size_t take_shape(const std::vector<std::size_t>& shape, const std::string& text);
  std::size_t take_lattice(const std::vector<std::size_t>& shape, const std::string& text);
  void place_columns(std::size_t columns, std::size_t channels);
  void read_row();
  void read_block();
  void check_end();

  std::istream& in_;
  std::string file_;
  WantedColumns wanted_;
  ReadNumbers read_ = nullptr;
  std::string (*text_)(const unsigned char*) = nullptr;
  std::size_t width_ = 8;  // bytes of a number
  bool fortran_ = false;
  bool any_unread_ = false;
  std::size_t channels_last_ = 0;  // of an array of a skin; 0: it has another shape
  std::size_t header_ = 0;         // bytes
  std::size_t columns_ = 0;        // of the array
  std::size_t frames_ = 0;
  std::size_t next_ = 0;
  std::size_t block_ = 1;               // frames held at once
  std::vector<std::size_t> stored_at_;  // per value read: the column's place in the array
  std::vector<std::size_t> at_;         // and its byte in `bytes_`, for the first frame held
  std::size_t time_at_ = none;          // index of the times among those
  std::vector<unsigned char> bytes_;
  std::vector<double> numbers_;  // of a frame, the time last
  std::string time_;
  FrameClock clock_;
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
