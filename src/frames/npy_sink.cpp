#include <bit>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <stdexcept>

#include "frames/npy.hpp"
#include "scene/npy_header.hpp"

namespace tactile_net::frames {

NpySink::NpySink(std::ostream& out, std::size_t columns) : out_(out), columns_(columns) {
  bytes_ = npy_header(0, columns);
}

void NpySink::add(std::string_view, std::span<const double> values) {
  const std::size_t first = bytes_.size();
  bytes_.resize(first + values.size() * sizeof(double));
  char* to = bytes_.data() + first;
  if constexpr (std::endian::native == std::endian::little) {
    if (!values.empty()) std::memcpy(to, values.data(), values.size() * sizeof(double));
  } else {
    for (const double value : values)
      for (std::uint64_t word = std::bit_cast<std::uint64_t>(value), i = 0; i < 8; ++i, word >>= 8)
        *to++ = static_cast<char>(word & 0xff);
  }
  ++frames_;
  if (bytes_.size() >= std::size_t{1} << 16) flush();
}

void NpySink::flush() {
  out_.write(bytes_.data(), std::ssize(bytes_));
  bytes_.clear();
  if (!out_) throw std::runtime_error("the frames could not be written: is the disk full?");
}

void NpySink::finish() {
  flush();
  const std::string head = npy_header(frames_, columns_);
  out_.seekp(0);
  out_.write(head.data(), std::ssize(head));
  if (!out_)
    throw std::runtime_error(
        "a .npy file must be seekable, and this output is not: write it to a file");
}

}  // namespace tactile_net::frames
