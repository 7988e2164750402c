#include "frames/checked_file.hpp"

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace tactile_net::frames {

void not_written(const std::filesystem::path& path) {
  const std::string reason = errno == 0 ? "" : ": " + std::generic_category().message(errno);
  throw std::runtime_error(path.string() + " could not be written" + reason +
                           "; nothing was changed there");
}

CheckedFile::CheckedFile(const std::filesystem::path& path, const std::filesystem::path& named)
    : std::ostream(nullptr), buffer_(named) {
  rdbuf(&buffer_);
  exceptions(std::ios::badbit);
  errno = 0;
  (void)buffer_.open(path, std::ios::out | std::ios::binary | std::ios::trunc);
}

void CheckedFile::close() {
  flush();
  errno = 0;
  if (buffer_.close() == nullptr) not_written(buffer_.named());
}

CheckedFile::Buffer::int_type CheckedFile::Buffer::overflow(int_type c) {
  errno = 0;
  const int_type result = std::filebuf::overflow(c);
  if (traits_type::eq_int_type(result, traits_type::eof())) not_written(named_);
  return result;
}

std::streamsize CheckedFile::Buffer::xsputn(const char* text, std::streamsize size) {
  errno = 0;
  const std::streamsize written = std::filebuf::xsputn(text, size);
  if (written != size) not_written(named_);
  return written;
}

int CheckedFile::Buffer::sync() {
  errno = 0;
  if (std::filebuf::sync() != 0) not_written(named_);
  return 0;
}

}  // namespace tactile_net::frames
