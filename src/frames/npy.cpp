#include "tactile_net/frames/npy.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <istream>
#include <ostream>
#include <stdexcept>

#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::frames {
namespace {

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t header_size = 128;

template <typename Word>
Word little_endian(const unsigned char* bytes) {
  Word word = 0;
  for (std::size_t i = sizeof(Word); i-- > 0;) word = static_cast<Word>(word << 8 | bytes[i]);
  return word;
}

/// What follows a key of the header's dictionary, up to `end`.
std::string_view after(std::string_view header, std::string_view key, std::string_view end) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  std::string_view rest = header.substr(at + key.size());
  rest.remove_prefix(std::min(rest.find_first_not_of(" :"), rest.size()));
  return rest.substr(0, rest.find_first_of(end));
}

/// The numbers of "(3, 81" or "(3,"; empty if it is anything else.
std::vector<std::size_t> numbers_of(std::string_view tuple) {
  std::vector<std::size_t> numbers;
  if (!tuple.starts_with('(')) return {};
  tuple.remove_prefix(1);
  while (!tuple.empty()) {
    const std::size_t blank = tuple.find_first_not_of(' ');
    if (blank == std::string_view::npos) break;
    tuple.remove_prefix(blank);
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(tuple.data(), tuple.data() + tuple.size(), number);
    if (error != std::errc{}) return {};
    numbers.push_back(number);
    tuple.remove_prefix(static_cast<std::size_t>(end - tuple.data()));
    if (tuple.starts_with(',')) tuple.remove_prefix(1);
  }
  return numbers;
}

std::string header(std::size_t frames, std::size_t columns) {
  std::string text(magic);
  text += {'\x01', '\x00', static_cast<char>(header_size - 10), '\x00'};
  text += "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(frames) + ", " +
          std::to_string(columns) + "), }";
  text.resize(header_size - 1, ' ');
  return text + '\n';
}

}  // namespace

bool begins_like_npy(std::istream& in) {
  return in.peek() == static_cast<unsigned char>(magic.front());
}

bool is_npy_name(const std::string& path) { return path.ends_with(".npy"); }

NpyFrames::NpyFrames(std::istream& in, std::string file, std::vector<std::string> columns,
                     std::vector<bool> unread)
    : in_(in), file_(std::move(file)), columns_(std::move(columns)), unread_(std::move(unread)) {
  unread_.resize(columns_.size());
  constexpr const char* save = "numpy.save(file, numpy.ascontiguousarray(frames, dtype='<f8'))";
  unsigned char start[12] = {};
  in_.read(reinterpret_cast<char*>(start), 8);
  if (!in_ || std::string_view(reinterpret_cast<const char*>(start), magic.size()) != magic)
    fail("is not a .npy file: it does not begin as one", save);
  const unsigned version = start[6];
  if (version < 1 || version > 3)
    fail("is a .npy file of version " + std::to_string(version) + ", not 1 to 3", save);
  const int length_bytes = version == 1 ? 2 : 4;
  in_.read(reinterpret_cast<char*>(start), length_bytes);
  const std::size_t length =
      version == 1 ? little_endian<std::uint16_t>(start) : little_endian<std::uint32_t>(start);
  if (!in_ || length > 65'536) fail("has a header that is cut off or too long", save);
  std::string dictionary(length, '\0');
  in_.read(dictionary.data(), std::ssize(dictionary));
  if (!in_) fail("has a header that is cut off", save);

  const std::string_view type = after(dictionary, "'descr'", ",}");
  if (type != "'<f8'" && type != "'<f4'")
    fail("holds numbers of type " + std::string(type.substr(0, 40)) + ", not '<f8' or '<f4'", save);
  width_ = type == "'<f8'" ? 8 : 4;
  if (after(dictionary, "'fortran_order'", ",}") != "False")
    fail("holds its numbers in Fortran's order, column after column", save);
  const std::string_view tuple = after(dictionary, "'shape'", ")");
  const std::vector<std::size_t> shape = numbers_of(tuple);
  if (shape.size() != 2)
    fail("has the shape " + std::string(tuple.substr(0, 40)) + "), not (frames, readings)",
         "one frame is an array of one row: frames.reshape(1, -1)");
  if (shape[1] != columns_.size())
    fail("has " + std::to_string(shape[1]) + " columns, the scene reads " +
             std::to_string(columns_.size()),
         columns_.front() + " to " + columns_.back() + ", quantity by quantity");
  frames_ = shape[0];
  row_.resize(columns_.size() * width_);
}

void NpyFrames::fail(const std::string& message, const std::string& hint) const {
  throw InputError({{.file = file_, .message = message, .hint = hint}});
}

void NpyFrames::refuse(const std::string& message, const std::string& hint) const {
  fail("frame " + std::to_string(next_ - 1) + ": " + message, hint);
}

bool NpyFrames::next(std::span<double> values) {
  if (next_ == frames_) {
    if (in_.peek() != std::istream::traits_type::eof())
      fail("goes on after the " + std::to_string(frames_) + " frames of its header", "");
    return false;
  }
  in_.read(reinterpret_cast<char*>(row_.data()), std::ssize(row_));
  if (!in_)
    fail("ends within frame " + std::to_string(next_) + " of " + std::to_string(frames_),
         "was it copied as a whole?");
  ++next_;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const unsigned char* at = row_.data() + i * width_;
    values[i] = width_ == 8 ? std::bit_cast<double>(little_endian<std::uint64_t>(at))
                            : std::bit_cast<float>(little_endian<std::uint32_t>(at));
    if (unread_[i])
      values[i] = 0.0;
    else if (!std::isfinite(values[i]))
      refuse("column " + std::to_string(i) + " (" + columns_[i] + ") is not finite",
             "list the taxel under [dead_taxels] if it is broken");
  }
  return true;
}

NpySink::NpySink(std::ostream& out, std::size_t columns) : out_(out), columns_(columns) {
  bytes_ = header(0, columns);
}

void NpySink::add(std::string_view, std::span<const double> values) {
  for (const double value : values)
    for (std::uint64_t word = std::bit_cast<std::uint64_t>(value), i = 0; i < 8; ++i, word >>= 8)
      bytes_ += static_cast<char>(word & 0xff);
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
  const std::string head = header(frames_, columns_);
  out_.seekp(0);
  out_.write(head.data(), std::ssize(head));
  if (!out_) throw std::runtime_error("a .npy file must be a file that can be gone back in");
}

}  // namespace tactile_net::frames
