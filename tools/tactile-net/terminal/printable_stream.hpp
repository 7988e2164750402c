/// @file
/// A stream to a terminal through which no control character gets.
#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace tactile_net::tool {

/// Passes text on line by line, made printable; lines of any length, and what has no line end yet
/// when it is flushed or at its own end.
class PrintableStream final : public std::ostream {
 public:
  /// @param to  must outlive this
  explicit PrintableStream(std::ostream& to);
  ~PrintableStream() override;
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 private:
  class Buffer final : public std::streambuf {
   public:
    explicit Buffer(std::ostream& to) : to_(to) {}
    int sync() override;

   private:
    int_type overflow(int_type c) override;
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    void pass_lines();

    std::ostream& to_;
    std::string text_;
  };
  Buffer buffer_;
};

}  // namespace tactile_net::tool
