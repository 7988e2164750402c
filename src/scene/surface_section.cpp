#include "scene/surface_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scene/mesh_file.hpp"
#include "scene/references.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

/// The outer surface, of the file that a scene names; none: a problem, which has been said.
std::shared_ptr<const SurfaceMesh> read_mesh(Table& table, const std::filesystem::path& folder) {
  const auto file = table.required("file", "the mesh of the outer surface: file = \"finger.obj\"");
  const auto named = table.value("unit");
  const auto text = named ? named->text() : std::nullopt;
  const auto unit = text ? unit_named(Dimension::length, *text) : std::nullopt;
  if (text && !unit)
    named->misfit("must be a unit of lengths", "unit = \"mm\"; left out, the mesh is in metres");
  if (!file || (named && !unit)) return nullptr;
  const auto path = path_beside(*file, folder, "file = \"finger.obj\"");
  if (!path) return nullptr;
  try {
    return std::make_shared<const SurfaceMesh>(
        read_mesh_file(*path, unit.value_or(Unit{.name = "m"})));
  } catch (const std::exception& error) {
    file->problem("names a mesh that is not in order: " + std::string(error.what()),
                  "docs/fingers.md says what is asked of it");
    return nullptr;
  }
}

/// Lengths that nobody's finger has are of another unit.
void check_extent(std::span<const CurvedTaxel> taxels, const Units& units) {
  double extent = 0.0;
  for (const CurvedTaxel& taxel : taxels)
    extent = std::max(extent, length(combined(1.0, taxel.place, -1.0, taxels.front().place)));
  if (taxels.size() < 2 || (extent >= 1e-3 && extent <= 1.0)) return;
  throw std::invalid_argument(
      "its taxels lie within " + shortest(extent) + " m of one another, by units.length = \"" +
      std::string(units.length.name) + "\": state the unit that the file has");
}

}  // namespace

std::optional<CurvedSkinOptions> read_surface(Table table, const std::filesystem::path& folder,
                                              const Units& units) {
  constexpr Rule some_radius{"must not be 0",
                             [](double x) noexcept { return std::isfinite(x) && x != 0.0; }};
  CurvedSkinOptions options;
  if (const auto shape = table.value("shape"))
    options.shape = one_named<SurfaceShape>(*shape, "shape of a surface");
  if (const auto frames = table.value("frames"))
    options.frames = one_named<SurfaceFrames>(*frames, "kind of a surface's frames")
                         .value_or(SurfaceFrames::tangent);
  if (const auto centre = table.value("centre"))
    options.centre = read_three(*centre, any_number, units.length, "centre = [0.0, 0.0, -12.0]");
  if (const auto radius = table.value("radius"))
    options.radius = radius->number(some_radius, units.length);
  if (const auto reference = table.value("reference")) {
    const auto along = read_three(*reference, any_number, {}, "reference = [0, 1, 0]");
    if (along && !(length(*along) > 0.0))
      reference->problem("must not be 0", "reference = [0, 1, 0]");
    else if (along)
      options.reference = *along;
  }
  if (options.shape == SurfaceShape::mesh) {
    options.mesh = read_mesh(table, folder);
  } else {
    for (const std::string_view key : {"file", "unit"})
      table.not_here(key, "is of the shape mesh", "shape = \"mesh\", or remove it");
  }
  table.finish();
  if (options.shape == SurfaceShape::mesh && !options.mesh) return std::nullopt;
  return options;
}

std::optional<SpaceVector> read_three(const Value& value, const Rule& rule, const Unit& unit,
                                      std::string_view example) {
  const auto numbers = value.numbers(rule, unit);
  if (!numbers) return std::nullopt;
  if (numbers->size() == 3) return SpaceVector{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  value.problem("must be three numbers, along the sensor's x, y and z (got " +
                    std::to_string(numbers->size()) + ')',
                std::string(example));
  return std::nullopt;
}

SkinArray curved_skin_of(std::vector<FileTaxel> rows, const std::optional<Value>& axes,
                         CurvedSkinOptions options, const Units& units) {
  if (axes) {
    options.axes =
        one_named<ReadingAxes>(*axes, "frame of displacements").value_or(ReadingAxes::local);
  } else if (std::any_of(rows.begin(), rows.end(), [](const FileTaxel& row) {
               return std::any_of(row.taxel.reads.begin(), row.taxel.reads.end(), [](Quantity one) {
                 return traits(one).kind == QuantityKind::displacement;
               });
             })) {
    throw std::invalid_argument(
        "its taxels read displacements: say along which axes, by sensor.frame = \"sensor\", the "
        "sensor's own, or \"local\", the surface's above each taxel");
  }
  std::vector<CurvedTaxel> taxels;
  taxels.reserve(rows.size());
  for (FileTaxel& row : rows)
    taxels.push_back({.name = std::move(row.taxel.name),
                      .place = {*row.x, row.taxel.y, row.taxel.z},
                      .normal = row.normal,
                      .depth = row.taxel.depth,
                      .reads = std::move(row.taxel.reads)});
  if (!units.length.name.empty()) check_extent(taxels, units);
  return curved_skin(std::move(taxels), options);
}

}  // namespace tactile_net
