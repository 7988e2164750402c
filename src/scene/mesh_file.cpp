#include "scene/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "numeric/lower_case.hpp"
#include "scene/csv_table.hpp"
#include "scene/document.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/bounded_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 27;

std::string bytes_of(const std::filesystem::path& path) {
  std::error_code none;
  if (!std::filesystem::exists(path, none)) throw std::runtime_error("there is no such file");
  try {
    return bounded_text(path, most_bytes, "give a coarser mesh");
  } catch (const InputError& error) {
    const Diagnostic& first = error.diagnostics().front();
    throw std::runtime_error("it " + first.message + (first.hint.empty() ? "" : ": " + first.hint));
  }
}

/// The words of each line of a text, with its number from 1.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(without_byte_order_mark(text)) {}

  /// False at the end.
  [[nodiscard]] bool next() {
    if (rest_.empty()) return false;
    ++number_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    words_.clear();
    constexpr std::string_view blanks = " \t\r\v\f";
    for (std::size_t at = line.find_first_not_of(blanks); at < line.size();
         at = line.find_first_not_of(blanks)) {
      line.remove_prefix(at);
      const std::size_t length = std::min(line.find_first_of(blanks), line.size());
      words_.push_back(line.substr(0, length));
      line.remove_prefix(length);
    }
    return true;
  }
  [[nodiscard]] const std::vector<std::string_view>& words() const noexcept { return words_; }
  [[nodiscard]] std::string_view word(std::size_t i) const {
    return i < words_.size() ? words_[i] : std::string_view{};
  }
  [[nodiscard]] std::size_t number() const noexcept { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
  std::vector<std::string_view> words_{};
};

/// Three numbers from a word on.
std::optional<SpaceVector> place_in(const Lines& lines, std::size_t first, const Unit& unit) {
  SpaceVector place{};
  for (std::size_t k = 0; k < place.size(); ++k) {
    double number = 0.0;
    std::string_view word = lines.word(first + k);
    if (word.starts_with('+')) word.remove_prefix(1);
    if (!read_number(word, number) || !std::isfinite(number)) return std::nullopt;
    place[k] = unit.to_si(number);
  }
  return place;
}

void require_room(const SurfaceMesh& mesh) {
  if (mesh.triangles.size() >= most_triangles)
    throw std::runtime_error("it holds more than " + std::to_string(most_triangles) +
                             " triangles: give a coarser mesh");
}

/// The vertex of "7", "7/1/3" or, from the end, "-1". @param count  of vertices before it
std::optional<std::size_t> vertex_of(std::string_view word, std::size_t count) {
  word = word.substr(0, word.find('/'));
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size() || number == 0) return std::nullopt;
  if (number < 0) number += static_cast<std::int64_t>(count) + 1;
  return number > 0 ? std::optional(static_cast<std::size_t>(number - 1)) : std::nullopt;
}

SurfaceMesh read_obj(std::string_view text, const Unit& unit) {
  if (text.find('\0') != std::string_view::npos)
    throw std::runtime_error(
        "it holds a byte 0, which plain text never does: it is in UTF-16, or damaged; save it as "
        "plain text, or copy it again");
  SurfaceMesh mesh;
  Lines lines(text);
  while (lines.next()) {
    if (lines.word(0) == "v") {
      const auto place = place_in(lines, 1, unit);
      if (!place)
        throw error_in_line(lines.number(), "a vertex needs three finite numbers: v 1.0 2.0 3.0");
      mesh.vertices.push_back(*place);
    } else if (lines.word(0) == "f") {
      std::vector<std::size_t> corners;
      for (std::size_t k = 1; k < lines.words().size(); ++k)
        if (const auto corner = vertex_of(lines.word(k), mesh.vertices.size()))
          corners.push_back(*corner);
      if (corners.size() < 3 || corners.size() + 1 != lines.words().size())
        throw error_in_line(lines.number(), "a face names three vertices or more: f 1 2 3");
      for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        require_room(mesh);
        mesh.triangles.push_back({corners[0], corners[k], corners[k + 1]});
      }
    }
  }
  if (mesh.triangles.empty())
    throw std::runtime_error(
        "it holds no face: a Wavefront .obj has lines \"v x y z\" and \"f 1 2 "
        "3\"");
  return mesh;
}

/// Corners at one place are one vertex.
class MergedCorners {
 public:
  void add(const std::array<SpaceVector, 3>& corners) {
    require_room(mesh_);
    std::array<std::size_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [vertex, is_new] = places_.try_emplace(corners[k], mesh_.vertices.size());
      if (is_new) mesh_.vertices.push_back(corners[k]);
      triangle[k] = vertex->second;
    }
    mesh_.triangles.push_back(triangle);
  }
  [[nodiscard]] std::size_t count() const noexcept { return mesh_.triangles.size(); }
  [[nodiscard]] SurfaceMesh take() { return std::move(mesh_); }

 private:
  SurfaceMesh mesh_{};
  std::map<SpaceVector, std::size_t> places_{};
};

SurfaceMesh read_stl_text(std::string_view text, const Unit& unit) {
  MergedCorners corners;
  std::vector<SpaceVector> loop;
  bool is_open = true;
  Lines lines(text);
  while (lines.next()) {
    const std::string word = lower_case(lines.word(0));
    if (word == "vertex") {
      const auto place = place_in(lines, 1, unit);
      if (!place)
        throw error_in_line(lines.number(),
                            "a vertex needs three finite numbers: vertex 1.0 2.0 3.0");
      loop.push_back(*place);
    } else if (word == "endloop") {
      if (loop.size() != 3)
        throw error_in_line(lines.number(), "triangle " + std::to_string(corners.count() + 1) +
                                                " has " + std::to_string(loop.size()) +
                                                " vertices, not three");
      corners.add({loop[0], loop[1], loop[2]});
      loop.clear();
    }
    if (word == "solid" || word == "endsolid") is_open = word == "solid";
  }
  if (is_open || !loop.empty())
    throw std::runtime_error("it ends after triangle " + std::to_string(corners.count()) +
                             " without \"endsolid\": it is cut short; copy it again");
  if (corners.count() == 0) throw std::runtime_error("it holds no triangle");
  return corners.take();
}

std::uint32_t little(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;)
    number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

constexpr std::size_t stl_head = 84;      // 80 bytes of anything, then the count
constexpr std::size_t stl_triangle = 50;  // a normal, three corners, two bytes of anything

SurfaceMesh read_stl_binary(std::string_view bytes, const Unit& unit) {
  if (bytes.size() < stl_head)
    throw std::runtime_error(
        "it is no .stl file: a binary one begins with 84 bytes, one of text "
        "with \"solid\"");
  const std::size_t count = little(bytes, 80);
  if (bytes.size() != stl_head + stl_triangle * count) {
    const std::size_t held = (bytes.size() - stl_head) / stl_triangle;
    const std::size_t more = (bytes.size() - stl_head) % stl_triangle;
    throw std::runtime_error("it announces " + std::to_string(count) + " triangles and holds " +
                             std::to_string(held) +
                             (more > 0 ? " and " + std::to_string(more) + " bytes more" : "") +
                             ": it is cut short or no .stl file; copy it again");
  }
  MergedCorners corners;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<SpaceVector, 3> places{};
    for (std::size_t k = 0; k < 9; ++k) {
      const auto number = static_cast<double>(
          std::bit_cast<float>(little(bytes, stl_head + stl_triangle * i + 12 + 4 * k)));
      if (!std::isfinite(number))
        throw std::runtime_error("triangle " + std::to_string(i + 1) +
                                 " has a number that is not finite");
      places[k / 3][k % 3] = unit.to_si(number);
    }
    corners.add(places);
  }
  return corners.take();
}

/// Some binary files begin with "solid" too: they hold bytes 0.
bool is_text(std::string_view bytes) {
  if (bytes.find('\0') != std::string_view::npos) return false;
  bytes = without_byte_order_mark(bytes);
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  return lower_case(bytes.substr(0, 5)) == "solid";
}

}  // namespace

SurfaceMesh read_mesh_file(const std::filesystem::path& path, const Unit& unit) {
  const std::string ending = lower_case(path.extension().string());
  if (ending != ".obj" && ending != ".stl")
    throw std::runtime_error("it is neither an .obj nor an .stl file");
  const std::string bytes = bytes_of(path);
  SurfaceMesh mesh = ending == ".obj" ? read_obj(bytes, unit)
                     : is_text(bytes) ? read_stl_text(bytes, unit)
                                      : read_stl_binary(bytes, unit);
  check(mesh);
  return mesh;
}

}  // namespace tactile_net
