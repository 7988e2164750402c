/// @file
/// A stream into a file that says why it could not be written. Private.
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>

namespace tactile_net::frames {

/// Not all of an output was written. @throw std::runtime_error  with what errno says, if anything
[[noreturn]] void not_written(const std::filesystem::path& path);

/// A stream keeps of a failure that there was one, and by the time somebody asks errno tells of
/// something else: so the buffer throws where it fails, and the stream passes that on.
class CheckedFile final : public std::ostream {
 public:
  /// @param path   to be opened, whatever was there is gone
  /// @param named  what messages call it
  CheckedFile(const std::filesystem::path& path, const std::filesystem::path& named);

  [[nodiscard]] bool opened() const { return buffer_.is_open(); }

  /// @throw std::runtime_error  something was not written: which file, and why
  void close();

 private:
  class Buffer final : public std::filebuf {
   public:
    explicit Buffer(std::filesystem::path named) : named_(std::move(named)) {}
    [[nodiscard]] const std::filesystem::path& named() const noexcept { return named_; }

   private:
    int_type overflow(int_type c) override;
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int sync() override;
    std::filesystem::path named_;
  };
  Buffer buffer_;
};

}  // namespace tactile_net::frames
