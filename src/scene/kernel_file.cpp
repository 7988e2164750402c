#include "scene/kernel_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scene/npz_file.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/skin/array.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t most_corners = std::size_t{1} << 20;

std::string shape_of(const NpzArray& array) {
  std::string text = "(";
  for (const std::size_t length : array.shape)
    text += (text.size() > 1 ? ", " : "") + std::to_string(length);
  return text + ')';
}

/// @param wanted  0: any length
NpzArray numbers(const NpzFile& file, std::string_view name, std::size_t most,
                 const std::vector<std::size_t>& wanted) {
  NpzArray array = file.array(name, most);
  bool fits = array.texts.empty() && array.shape.size() == wanted.size();
  for (std::size_t i = 0; fits && i < wanted.size(); ++i)
    fits = wanted[i] == 0 || wanted[i] == array.shape[i];
  if (!fits) {
    std::string text;
    for (const std::size_t length : wanted)
      text +=
          (text.empty() ? "" : ", ") + (length == 0 ? std::string("any") : std::to_string(length));
    throw std::runtime_error("the array " + std::string(name) + " has the shape " +
                             shape_of(array) + ", not (" + text + ')');
  }
  if (!std::all_of(array.numbers.begin(), array.numbers.end(),
                   [](double x) { return std::isfinite(x); }))
    throw std::runtime_error("the array " + std::string(name) +
                             " holds a number that is not finite");
  return array;
}

SpaceVector vector_at(const NpzArray& array, std::size_t index) {
  return {array.numbers[3 * index], array.numbers[3 * index + 1], array.numbers[3 * index + 2]};
}

using Corners = std::array<std::size_t, 4>;

std::size_t shared(const Corners& a, const Corners& b) {
  return static_cast<std::size_t>(std::count_if(a.begin(), a.end(), [&](std::size_t corner) {
    return std::find(b.begin(), b.end(), corner) != b.end();
  }));
}

bool is_triangle(const Corners& cell) { return cell[2] == cell[3]; }

/// The length of a row of quadrilaterals that lie row after row; 0: they do not.
std::size_t row_length(const std::vector<Corners>& cells) {
  if (std::any_of(cells.begin(), cells.end(), is_triangle)) return 0;
  std::size_t length = 2;
  while (length < cells.size() && shared(cells[0], cells[length]) != 2) ++length;
  if (length >= cells.size() || cells.size() % length != 0) return 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if ((i + 1) % length != 0 && shared(cells[i], cells[i + 1]) != 2) return 0;
    if (i + length < cells.size() && shared(cells[i], cells[i + length]) != 2) return 0;
  }
  return length;
}

/// Of triangles, whose last corner stands there twice, and of quadrilaterals.
std::vector<Corners> corners_of(const NpzFile& file, std::size_t vertices) {
  const NpzArray cells = file.array("cells", 4 * most_corners);
  const std::size_t wide = cells.shape.size() == 2 ? cells.shape[1] : 0;
  if (!cells.texts.empty() || (wide != 3 && wide != 4) || cells.shape[0] == 0)
    throw std::runtime_error("the array cells has the shape " + shape_of(cells) +
                             ", not (any, 3) or (any, 4)");
  std::vector<Corners> corners(cells.shape[0]);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double corner = k < wide ? cells.numbers[wide * i + k] : -1.0;
      if (k == 3 && corner == -1.0) {
        corners[i][3] = corners[i][2];
        continue;
      }
      if (!(corner >= 0.0 && corner < static_cast<double>(vertices)) ||
          corner != std::floor(corner))
        throw std::runtime_error("cell " + std::to_string(i) +
                                 " has a corner that is no vertex: it names three or four of " +
                                 std::to_string(vertices) + ", from 0, and -1 fills up a triangle");
      corners[i][k] = static_cast<std::size_t>(corner);
    }
  }
  return corners;
}

/// Where each reading of the skin stands in the file.
std::vector<std::size_t> rows_of(const NpzFile& file, const SkinArray& skin) {
  const NpzArray named = file.array("readings", most_corners);
  const std::vector<std::string> wanted = reading_names(skin);
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < named.texts.size(); ++i)
    if (!places.try_emplace(named.texts[i], i).second)
      throw std::runtime_error("the array readings names '" + named.texts[i] + "' twice");
  std::vector<std::size_t> rows;
  for (const std::string& name : wanted) {
    const auto found = places.find(name);
    if (found == places.end())
      throw std::runtime_error("its readings have no '" + name + "', which the sensor has");
    rows.push_back(found->second);
  }
  if (named.texts.size() != wanted.size())
    throw std::runtime_error("it has " + std::to_string(named.texts.size()) +
                             " readings, and the sensor " + std::to_string(wanted.size()));
  return rows;
}

/// A number that the file may have.
std::optional<double> number_in(const NpzFile& file, std::string_view name) {
  if (!file.has(name)) return std::nullopt;
  const NpzArray array = file.array(name, 1);
  if (array.numbers.size() != 1)
    throw std::runtime_error("the array " + std::string(name) + " is not one number");
  return array.numbers.front();
}

void require_same(const NpzFile& file, std::string_view name, double of_scene) {
  const auto number = number_in(file, name);
  if (number && !(std::abs(*number - of_scene) <= 1e-6 * std::abs(of_scene)))
    throw std::runtime_error("it is of " + std::string(name) + " = " + shortest(*number) +
                             ", and the scene says " + shortest(of_scene));
}

void check_frame(const NpzFile& file, const SkinArray& skin) {
  if (!file.has("frame")) return;
  const NpzArray frame = file.array("frame", 1);
  const std::string_view of_scene = enumerator_name(skin.curved->axes);
  if (frame.texts.size() != 1) throw std::runtime_error("the array frame is not one text");
  if (frame.texts.front() != of_scene)
    throw std::runtime_error("its displacements are along the " + frame.texts.front() +
                             " axes, and the scene says sensor.frame = \"" + std::string(of_scene) +
                             '"');
}

void check_units(const NpzFile& file, const SkinArray& skin, const std::vector<std::size_t>& rows) {
  if (!file.has("units")) return;
  const NpzArray units = file.array("units", most_corners);
  if (units.texts.size() != 1 && units.texts.size() != rows.size())
    throw std::runtime_error("the array units holds " + std::to_string(units.texts.size()) +
                             " texts, and the sensor has " + std::to_string(rows.size()) +
                             " readings: one for each, or one for all");
  const std::vector<Site> all = sites(skin);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string& unit = units.texts.size() == 1 ? units.texts.front() : units.texts[rows[i]];
    const std::string_view wanted = traits(all[i].quantity).unit;
    if (unit != wanted)
      throw std::runtime_error("its units are '" + unit + "' for " +
                               std::string(name(all[i].quantity)) + ", not '" +
                               std::string(wanted) + "' (over Pa)");
  }
}

/// Of the bent surface: what the corners span, more or less.
void read_areas(const NpzFile& file, std::vector<SurfaceCell>& cells) {
  if (!file.has("areas")) return;
  const NpzArray areas = numbers(file, "areas", most_corners, {cells.size()});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    SurfaceCell& cell = cells[i];
    const double ratio = areas.numbers[i] / cell.area;
    if (!(ratio > 0.5 && ratio < 2.0))
      throw std::runtime_error("the area of cell " + std::to_string(i) + " is " +
                               shortest(areas.numbers[i]) + ", and its corners span " +
                               brief(cell.area, 3) + " m2: areas are in m2");
    cell.first_moment = multiple(ratio, cell.first_moment);
    cell.area = areas.numbers[i];
  }
}

/// Forces and moments of unit tractions: near those of the cell's area at its middle.
void read_resultants(const NpzFile& file, std::vector<SurfaceCell>& cells) {
  if (!file.has("F") || !file.has("M")) return;
  const NpzArray forces = numbers(file, "F", 9 * most_corners, {cells.size(), 3, 3});
  const NpzArray moments = numbers(file, "M", 9 * most_corners, {cells.size(), 3, 3});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    SurfaceCell& cell = cells[i];
    const double size = std::sqrt(cell.area);
    for (std::size_t u = 0; u < 3; ++u) {
      const SpaceVector force = vector_at(forces, 3 * i + u);
      const SpaceVector moment = vector_at(moments, 3 * i + u);
      if (!(length(combined(1.0, force, -cell.area, cell.middle.frame[u])) < 0.5 * cell.area))
        throw std::runtime_error("F of cell " + std::to_string(i) +
                                 " is not its area times its frame, in m2");
      if (!(length(combined(1.0, moment, -1.0, cross(cell.middle.point, force))) <
            4.0 * size * cell.area))
        throw std::runtime_error("M of cell " + std::to_string(i) +
                                 " is not its place times F, about the origin, in m3");
      cell.force[u] = force;
      cell.moment[u] = moment;
    }
  }
}

}  // namespace

GivenKernel read_kernel_file(const std::filesystem::path& path, const SkinArray& skin,
                             const Material& material) {
  const NpzFile file(path);
  const std::vector<std::size_t> rows = rows_of(file, skin);
  check_frame(file, skin);
  check_units(file, skin, rows);
  require_same(file, "poisson_ratio", material.poisson_ratio);
  if (material.layer) require_same(file, "thickness", material.layer->thickness);
  const double modulus = number_in(file, "youngs_modulus").value_or(material.youngs_modulus);
  if (!(modulus > 0.0 && std::isfinite(modulus)))
    throw std::runtime_error("youngs_modulus must be > 0 and finite (got " + shortest(modulus) +
                             " Pa)");
  const double stiffer = modulus / material.youngs_modulus;

  const NpzArray vertices = numbers(file, "vertices", 3 * most_corners, {0, 3});
  const std::vector<Corners> corners = corners_of(file, vertices.shape[0]);
  GivenKernel kernel{.from = path.filename().string()};
  kernel.columns = row_length(corners);
  kernel.rows = kernel.columns > 0 ? corners.size() / kernel.columns : 0;
  std::optional<NpzArray> frames;
  if (file.has("frames"))
    frames = numbers(file, "frames", 9 * most_corners, {corners.size(), 3, 3});
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::array<SpaceVector, 4> points;
    for (std::size_t k = 0; k < 4; ++k) points[k] = vector_at(vertices, corners[i][k]);
    const SpaceVector twice =
        cross(combined(1.0, points[2], -1.0, points[0]), combined(1.0, points[3], -1.0, points[1]));
    if (!(length(twice) > 0.0))
      throw std::runtime_error("cell " + std::to_string(i) + " has no area");
    const SurfaceFrame frame =
        frames ? SurfaceFrame{vector_at(*frames, 3 * i), vector_at(*frames, 3 * i + 1),
                              vector_at(*frames, 3 * i + 2)}
               : skin.curved->surface.frame(multiple(1.0 / length(twice), twice));
    for (std::size_t u = 0; u < 3; ++u)
      if (!(std::abs(dot(frame[u], frame[u]) - 1.0) <= 1e-6 &&
            std::abs(dot(frame[u], frame[(u + 1) % 3])) <= 1e-6 &&
            dot(cross(frame[0], frame[1]), frame[2]) > 0.0))
        throw std::runtime_error("the frame of cell " + std::to_string(i) +
                                 " is not three unit vectors at right angles, right-handed");
    kernel.cells.push_back(quadrilateral(points, frame));
    if (kernel.rows == 0) kernel.corners.push_back(points);
  }
  read_areas(file, kernel.cells);
  read_resultants(file, kernel.cells);
  const NpzArray given = numbers(file, "K", most_kernel_entries, {rows.size(), 3 * corners.size()});
  kernel.kernel = {rows.size(), 3 * corners.size(), std::vector<double>(given.numbers.size())};
  const std::vector<Site> all = sites(skin);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double scale = traits(all[row].quantity).kind == QuantityKind::stress ? 1.0 : stiffer;
    for (std::size_t i = 0; i < kernel.kernel.columns; ++i)
      kernel.kernel(row, i) = scale * given.numbers[rows[row] * kernel.kernel.columns + i];
  }
  return kernel;
}

}  // namespace tactile_net
