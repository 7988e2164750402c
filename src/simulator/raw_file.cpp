#include "tactile_net/simulator/raw_file.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

/// Walks through a file that is in memory.
struct Cursor {
  std::string_view rest;
  std::string file;

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(file + ": error: not a whole raw file: " + what);
  }
  [[nodiscard]] std::string_view line() {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) fail("the header ends early");
    std::string_view text = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
  }
  /// The next word of the text form.
  [[nodiscard]] std::string_view word() {
    const auto is_space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    const auto begin = std::find_if_not(rest.begin(), rest.end(), is_space);
    const auto end = std::find_if(begin, rest.end(), is_space);
    const std::string_view text(begin, end);
    rest.remove_prefix(static_cast<std::size_t>(end - rest.begin()));
    return text;
  }
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// What follows `key:` in a header line, or nothing.
std::optional<std::string_view> field(std::string_view line, std::string_view key) {
  if (line.size() <= key.size() || line[key.size()] != ':' ||
      lower(line.substr(0, key.size())) != lower(key))
    return std::nullopt;
  return trimmed(line.substr(key.size() + 1));
}

std::size_t size_field(const Cursor& cursor, std::string_view text, const char* what) {
  const auto value = whole_number(text);
  if (!value) cursor.fail(std::string(what) + " is not a number");
  return *value;
}

void read_values(Cursor& cursor, RawFile& raw, bool complex, bool binary) {
  const std::size_t variables = raw.names.size();
  const std::size_t parts = complex ? 2 : 1;
  // A value takes at least two bytes in either form: bounds what a lying header may ask for.
  const std::size_t least = binary ? parts * sizeof(double) : 2;
  if (variables == 0 || raw.points > cursor.rest.size() / least / variables)
    cursor.fail("it announces " + std::to_string(raw.points) + " points of " +
                std::to_string(variables) + " variables, and holds " +
                std::to_string(cursor.rest.size()) + " bytes");
  raw.values.assign(variables, std::vector<double>(raw.points));
  if (complex) raw.imaginary = raw.values;

  const auto next = [&](std::string_view text) {
    double value = 0.0;
    if (!read_number(text, value))
      cursor.fail("'" + std::string(text.substr(0, 40)) + "' is not a number");
    return value;
  };
  for (std::size_t point = 0; point < raw.points; ++point) {
    if (!binary) (void)cursor.word();  // the point's index
    for (std::size_t v = 0; v < variables; ++v) {
      if (binary) {
        std::memcpy(&raw.values[v][point], cursor.rest.data(), sizeof(double));
        if (complex)
          std::memcpy(&raw.imaginary[v][point], cursor.rest.data() + sizeof(double),
                      sizeof(double));
        cursor.rest.remove_prefix(parts * sizeof(double));
        continue;
      }
      const std::string_view text = cursor.word();
      if (text.empty())
        cursor.fail("values are missing from point " + std::to_string(point) + " on");
      const std::size_t comma = text.find(',');
      raw.values[v][point] = next(text.substr(0, comma));
      if (complex && comma != std::string_view::npos)
        raw.imaginary[v][point] = next(text.substr(comma + 1));
    }
  }
  // `ngspice -r` leaves what its memory held in the place of the frequency's imaginary part.
  for (std::size_t v = 0; complex && v < variables; ++v)
    if (raw.names[v] == "frequency") raw.imaginary[v].assign(raw.points, 0.0);
}

}  // namespace

std::span<const double> RawFile::vector(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw std::out_of_range("there is no vector '" + std::string(name) + "'");
  return values[static_cast<std::size_t>(found - names.begin())];
}

RawFile read_raw_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": error: there is no such raw file");
  std::error_code unknown;
  if (const auto size = std::filesystem::file_size(path, unknown);
      unknown || size > largest_raw_file)
    throw std::runtime_error(path.string() + ": error: is not a file, or larger than " +
                             std::to_string(largest_raw_file >> 20U) + " MiB");
  const std::string content((std::istreambuf_iterator<char>(file)), {});
  Cursor cursor{content, path.string()};

  RawFile raw;
  bool complex = false;
  std::size_t variables = 0;
  for (;;) {
    const std::string_view line = cursor.line();
    if (const auto title = field(line, "Title"))
      raw.title = *title;
    else if (const auto plot = field(line, "Plotname"))
      raw.plot = *plot;
    else if (const auto flags = field(line, "Flags"))
      complex = lower(*flags).find("complex") != std::string::npos;
    else if (const auto count = field(line, "No. Variables"))
      variables = size_field(cursor, *count, "No. Variables");
    else if (const auto points = field(line, "No. Points"))
      raw.points = size_field(cursor, *points, "No. Points");
    else if (lower(trimmed(line)) == "variables:")
      break;
  }
  for (std::size_t i = 0; i < variables; ++i) {
    Cursor words{cursor.line(), cursor.file};
    (void)words.word();  // index
    raw.names.push_back(lower(words.word()));
  }
  const std::string form = lower(trimmed(cursor.line()));
  if (form != "binary:" && form != "values:") cursor.fail("no values follow the header");
  read_values(cursor, raw, complex, form == "binary:");
  return raw;
}

}  // namespace tactile_net
