#include "scene/npz_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "scene/npy_header.hpp"
#include "scene/npy_numbers.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net {
namespace {

/// A whole number of some bytes, the lowest first.
std::uint64_t little(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint64_t number = 0;
  for (std::size_t i = count; i-- > 0;)
    number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

std::string bytes_at(std::ifstream& in, std::uint64_t at, std::size_t count) {
  std::string bytes(count, '\0');
  in.seekg(static_cast<std::streamoff>(at));
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  if (!in) throw std::runtime_error("it is cut off");
  return bytes;
}

/// UTF-8 of a code point.
void append_utf8(std::string& text, std::uint32_t code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0 | (code >> 6));
    text += static_cast<char>(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    text += static_cast<char>(0xE0 | (code >> 12));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
    text += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    text += '?';
  }
}

/// Texts of type "<U18" or "|S18".
std::vector<std::string> texts_in(const std::string& bytes, std::size_t count, bool wide,
                                  std::size_t length) {
  std::vector<std::string> texts(count);
  const std::size_t step = wide ? 4 : 1;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < length; ++k) {
      const auto code = static_cast<std::uint32_t>(little(bytes, (i * length + k) * step, step));
      if (code == 0) break;
      append_utf8(texts[i], code);
    }
  return texts;
}

}  // namespace

NpzFile::NpzFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code none;  // a pipe may never begin, a device never ends
  if (!std::filesystem::is_regular_file(path_, none))
    throw std::runtime_error(std::filesystem::exists(path_, none)
                                 ? "it is a folder, a pipe or a device, and no file"
                                 : "there is no such file");
  std::ifstream in(path_, std::ios::binary | std::ios::ate);
  if (!in) throw std::runtime_error("it cannot be read");
  bytes_ = static_cast<std::uint64_t>(in.tellg());
  constexpr std::size_t end_size = 22;
  constexpr std::size_t most_comment = 65'535;
  const std::string no_archive = "it is no .npz file: numpy.savez writes one";
  if (bytes_ < end_size) throw std::runtime_error(no_archive);
  const auto tail_size =
      static_cast<std::size_t>(std::min<std::uint64_t>(bytes_, end_size + most_comment));
  const std::string tail = bytes_at(in, bytes_ - tail_size, tail_size);
  const std::size_t end = tail.rfind(std::string("PK\x05\x06", 4));
  if (end == std::string::npos || end + end_size > tail.size())
    throw std::runtime_error(no_archive);
  const auto count = static_cast<std::size_t>(little(tail, end + 10, 2));
  const auto directory_size = static_cast<std::size_t>(little(tail, end + 12, 4));
  const std::uint64_t directory_at = little(tail, end + 16, 4);
  constexpr std::size_t most_directory = std::size_t{1} << 20;
  if (directory_size > most_directory || directory_at + directory_size > bytes_)
    throw std::runtime_error("its list of arrays is cut off or too long");
  const std::string directory = bytes_at(in, directory_at, directory_size);
  std::size_t at = 0;
  constexpr std::size_t head = 46;
  for (std::size_t i = 0; i < count; ++i) {
    if (at + head > directory.size() || directory.compare(at, 4, std::string("PK\x01\x02", 4)) != 0)
      throw std::runtime_error("its list of arrays is not in order");
    const auto name_size = static_cast<std::size_t>(little(directory, at + 28, 2));
    const std::size_t rest = static_cast<std::size_t>(little(directory, at + 30, 2)) +
                             static_cast<std::size_t>(little(directory, at + 32, 2));
    if (at + head + name_size + rest > directory.size())
      throw std::runtime_error("its list of arrays is not in order");
    std::string name = directory.substr(at + head, name_size);
    if (name.ends_with(".npy")) name.resize(name.size() - 4);
    const Entry entry{.at = static_cast<std::size_t>(little(directory, at + 42, 4)),
                      .size = static_cast<std::size_t>(little(directory, at + 20, 4)),
                      .stored = little(directory, at + 10, 2) == 0};
    entries_.insert_or_assign(std::move(name), entry);
    at += head + name_size + rest;
  }
}

NpzArray NpzFile::array(std::string_view name, std::size_t most) const {
  const auto found = entries_.find(name);
  const std::string what = "the array " + std::string(name);
  if (found == entries_.end()) throw std::runtime_error(what + " is missing");
  const Entry& entry = found->second;
  if (!entry.stored)
    throw std::runtime_error(what +
                             " is compressed: write the file by numpy.savez, not "
                             "numpy.savez_compressed");
  std::ifstream in(path_, std::ios::binary);
  const std::string local = bytes_at(in, entry.at, 30);
  if (local.compare(0, 4, std::string("PK\x03\x04", 4)) != 0)
    throw std::runtime_error(what + " is not where the file's list says");
  const std::uint64_t begin = entry.at + 30 + little(local, 26, 2) + little(local, 28, 2);
  if (begin > bytes_ || entry.size > bytes_ - begin) throw std::runtime_error(what + " is cut off");
  constexpr std::size_t header_room = std::size_t{1} << 17;
  std::istringstream stream(bytes_at(in, begin, std::min(entry.size, header_room)));
  NpyHeader header;
  try {
    header = read_npy_header(stream, std::string(name));
  } catch (const InputError&) {
    throw std::runtime_error(what + " is no array of numpy's");
  }
  if (header.fortran_order && header.shape.size() > 1)
    throw std::runtime_error(what + " is in Fortran's order: write numpy.ascontiguousarray of it");
  if (header.shape.size() > 8) throw std::runtime_error(what + " has more than 8 dimensions");
  std::size_t count = 1;
  for (const std::size_t length : header.shape) {
    if (length > 0 && count > most / length) throw std::runtime_error(what + " is too large");
    count *= length;
  }
  // No more is read than the header asks for, and no more of that than is there.
  const auto elements = [&](std::size_t width) {
    if (count * width > entry.size - header.size) throw std::runtime_error(what + " is cut off");
    return bytes_at(in, begin + header.size, count * width);
  };
  NpzArray array{.shape = header.shape};
  const bool wide = header.type.starts_with("<U");
  if (wide || header.type.starts_with("|S")) {
    constexpr std::size_t widest_text = 1024;
    constexpr std::size_t most_letters = std::size_t{1} << 24;
    std::size_t length = 0;
    for (const char digit : std::string_view(header.type).substr(2))
      length = digit >= '0' && digit <= '9' && length <= widest_text
                   ? 10 * length + static_cast<std::size_t>(digit - '0')
                   : widest_text + 1;
    if (length > widest_text || (length > 0 && count > most_letters / length))
      throw std::runtime_error(what + " has texts that are too long");
    array.texts = texts_in(elements(length * (wide ? 4 : 1)), count, wide, length);
    return array;
  }
  const NpyNumbers numbers = npy_numbers(header.type);
  if (numbers.width == 0)
    throw std::runtime_error(what + " holds " + std::string(kind_of_type(header.type)) +
                             " of type '" + header.type.substr(0, 40) +
                             "': numbers, such as '<f8', and texts are read");
  const std::string bytes = elements(numbers.width);
  std::vector<std::size_t> places(count);
  for (std::size_t i = 0; i < count; ++i) places[i] = i * numbers.width;
  array.numbers.resize(count);
  numbers.read(reinterpret_cast<const unsigned char*>(bytes.data()), places, array.numbers.data());
  return array;
}

}  // namespace tactile_net
