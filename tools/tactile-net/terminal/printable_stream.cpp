#include "terminal/printable_stream.hpp"

#include "tactile_net/system/printable.hpp"

namespace tactile_net::tool {

PrintableStream::PrintableStream(std::ostream& to) : std::ostream(nullptr), buffer_(to) {
  rdbuf(&buffer_);
}

PrintableStream::~PrintableStream() { buffer_.sync(); }

int PrintableStream::Buffer::sync() {
  to_ << printable_lines(text_) << std::flush;
  text_.clear();
  return to_ ? 0 : -1;
}

PrintableStream::Buffer::int_type PrintableStream::Buffer::overflow(int_type c) {
  if (!traits_type::eq_int_type(c, traits_type::eof())) {
    text_ += traits_type::to_char_type(c);
    if (text_.back() == '\n') pass_lines();
  }
  return traits_type::not_eof(c);
}

std::streamsize PrintableStream::Buffer::xsputn(const char* text, std::streamsize size) {
  text_.append(text, static_cast<std::size_t>(size));
  pass_lines();
  return size;
}

/// Whole lines alone: a character of several bytes may come in two pieces.
void PrintableStream::Buffer::pass_lines() {
  const std::size_t end = text_.rfind('\n');
  if (end == std::string::npos) return;
  to_ << printable_lines(std::string_view(text_).substr(0, end + 1));
  text_.erase(0, end + 1);
}

}  // namespace tactile_net::tool
