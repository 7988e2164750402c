#include "scene/npy_header.hpp"

#include <algorithm>
#include <charconv>
#include <istream>
#include <optional>
#include <string_view>

#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t written_size = 128;

/// What follows a key of the header's dictionary, up to one of `end`.
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

std::string_view without_quotes(std::string_view text) {
  const bool quoted = text.size() >= 2 && (text.front() == '\'' || text.front() == '"') &&
                      text.back() == text.front();
  return quoted ? text.substr(1, text.size() - 2) : text;
}

}  // namespace

NpyHeader read_npy_header(std::istream& in, const std::string& file) {
  const auto fail = [&](const std::string& message) {
    throw InputError({{.file = file,
                       .message = message,
                       .hint = "numpy.save(file, numpy.ascontiguousarray(frames, dtype='<f8'))"}});
  };
  unsigned char start[12] = {};
  in.read(reinterpret_cast<char*>(start), 8);
  if (!in || std::string_view(reinterpret_cast<const char*>(start), npy_magic.size()) != npy_magic)
    fail("is not a .npy file: it does not begin as one");
  const unsigned version = start[6];
  if (version < 1 || version > 3)
    fail("is a .npy file of version " + std::to_string(version) + ", not 1 to 3");
  const int length_bytes = version == 1 ? 2 : 4;
  in.read(reinterpret_cast<char*>(start), length_bytes);
  std::size_t length = 0;
  for (int i = length_bytes; i-- > 0;) length = length << 8 | start[i];
  if (!in || length > 65'536) fail("has a header that is cut off or too long");
  std::string dictionary(length, '\0');
  in.read(dictionary.data(), std::ssize(dictionary));
  if (!in) fail("has a header that is cut off");

  NpyHeader header;
  header.type = without_quotes(after(dictionary, "'descr'", ",}"));
  header.fortran_order = after(dictionary, "'fortran_order'", ",}") == "True";
  const std::string_view tuple = after(dictionary, "'shape'", ")");
  header.shape = numbers_of(tuple);
  header.shape_text = std::string(tuple.substr(0, 40)) + ")";
  header.size = 8 + static_cast<std::size_t>(length_bytes) + length;
  return header;
}

std::string npy_header(std::size_t frames, std::size_t columns) {
  std::string text(npy_magic);
  text += {'\x01', '\x00', static_cast<char>(written_size - 10), '\x00'};
  text += "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(frames) + ", " +
          std::to_string(columns) + "), }";
  text.resize(written_size - 1, ' ');
  return text + '\n';
}

}  // namespace tactile_net
