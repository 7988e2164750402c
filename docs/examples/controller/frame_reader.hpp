/// @file
/// Recorded or streamed frames as CSV, read by a thread that may wait.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

#include "ring.hpp"

struct Frame {
  double time = 0.0;
  std::vector<double> readings{};
};

/// Header, then one frame a row: `t` [s] if the header begins with it, then the plan's readings in
/// its order, channel after channel; columns beyond are not read.
class FrameReader {
 public:
  /// Reads the header. Waits for it.
  /// @param path  "-": standard input
  /// @throw std::runtime_error  cannot be opened; too few columns
  FrameReader(const std::string& path, std::size_t readings, const std::atomic<bool>& stop);
  ~FrameReader();
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  /// Fills the ring, row after row, `times` times over; waits while it is full. Closes it at the
  /// end of the input, when `stop` is set, or on a row that is none: see `error()`.
  void run(Ring<Frame>& frames, long times);

  [[nodiscard]] const std::string& header() const noexcept { return header_; }
  /// Once `run` has returned: what was wrong with the input, or nothing.
  [[nodiscard]] const std::string& error() const noexcept { return error_; }

 private:
  bool read_line();
  bool parse(Frame& frame);

  std::string path_;
  std::size_t readings_;
  const std::atomic<bool>& stop_;
  int file_;
  std::string buffer_, line_, header_, error_;
  std::size_t line_number_ = 0;
  bool has_time_ = false;
};
