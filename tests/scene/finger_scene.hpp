/// @file
/// A finger's scene with its files, and archives of arrays as numpy.savez writes them.
#pragma once

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/skin/curved_skin.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tests/scene/refusal.hpp"

namespace tactile_net {

/// A .npz file as numpy.savez writes it, its arrays stored.
class Archive {
 public:
  void add(const std::string& name, const std::string& type, const std::string& shape,
           const std::string& bytes) {
    std::string header =
        "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
    header.resize(117, ' ');
    header += '\n';
    std::string array = std::string("\x93NUMPY\x01\x00", 8) + little(header.size(), 2);
    array += header + bytes;
    const std::string file = name + ".npy";
    const std::string common = little(method, 2) + std::string(4, '\0') + little(0, 4) +
                               little(array.size(), 4) + little(array.size(), 4) +
                               little(file.size(), 2) + little(0, 2);
    directory_ += std::string("PK\x01\x02\x14\x00\x14\x00\x00\x00", 10) + common +
                  std::string(10, '\0') + little(text_.size(), 4) + file;
    text_ += std::string("PK\x03\x04\x14\x00\x00\x00", 8) + common + file + array;
    ++count_;
  }
  void add(const std::string& name, const std::string& shape, const std::vector<double>& numbers) {
    std::string bytes(numbers.size() * sizeof(double), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    add(name, "<f8", shape, bytes);
  }
  void add(const std::string& name, const std::vector<std::string>& texts) {
    constexpr std::size_t length = 24;
    std::string bytes;
    for (const std::string& one : texts)
      for (std::size_t k = 0; k < length; ++k)
        bytes += little(k < one.size() ? static_cast<unsigned char>(one[k]) : 0U, 4);
    add(name, "<U24", "(" + std::to_string(texts.size()) + ",)", bytes);
  }
  void write(const std::filesystem::path& path) const {
    std::ofstream(path, std::ios::binary)
        << text_ << directory_ << std::string("PK\x05\x06\x00\x00\x00\x00", 8) << little(count_, 2)
        << little(count_, 2) << little(directory_.size(), 4) << little(text_.size(), 4)
        << std::string(2, '\0');
  }

  std::uint64_t method = 0;  ///< 0: stored

 private:
  static std::string little(std::uint64_t number, std::size_t bytes) {
    std::string text;
    for (std::size_t i = 0; i < bytes; ++i, number >>= 8) text += static_cast<char>(number & 255);
    return text;
  }
  std::string text_, directory_;
  std::size_t count_ = 0;
};

inline const std::string finger_head = R"([units]
length = "mm"
modulus = "MPa"
stress = "Pa"
force = "N"
[material]
youngs_modulus = 0.25
poisson_ratio = 0.48
layer = { thickness = 4.0, base = "bonded" }
)";

/// A folder of its own with taxels below a ball of 30 mm.
class FingerScene {
 public:
  explicit FingerScene(const std::string& header = "name,x,y,z,nx,ny,nz,depth",
                       const std::function<std::string(std::size_t, std::string)>& edit = {})
      : folder_(std::filesystem::temp_directory_path() / ("finger-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    std::ofstream file(folder_ / "finger.csv");
    file << header << '\n';
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const double x = 2.0 * static_cast<double>(i) - 4.0;
        const double y = 2.0 * static_cast<double>(j) - 3.0;
        const double z = std::sqrt(30.0 * 30.0 - x * x - y * y);
        std::string row = "t" + std::to_string(4 * i + j);
        for (const double number : {x, y, z}) row += ',' + shortest(number * (28.8 / 30.0));
        for (const double number : {x, y, z}) row += ',' + shortest(number / 30.0);
        row += ",1.2";
        file << (edit ? edit(4 * i + j, row) : row) << '\n';
      }
  }
  ~FingerScene() { std::filesystem::remove_all(folder_); }
  FingerScene(const FingerScene&) = delete;
  FingerScene& operator=(const FingerScene&) = delete;

  [[nodiscard]] static std::string text(const std::string& more = {},
                                        const std::string& sensor = "frame = \"sensor\"\n") {
    return finger_head +
           "[sensor]\ntaxels = \"finger.csv\"\nreads = [\"displacement_x\", \"displacement_y\", "
           "\"displacement_z\"]\n" +
           sensor + more;
  }
  [[nodiscard]] SkinScene read(const std::string& toml) const {
    return std::get<SkinScene>(parse_any_scene(toml, (folder_ / "scene.toml").string()));
  }
  [[nodiscard]] std::string refusal(const std::string& toml) const {
    return test::refusal_of(
        [&] { return parse_any_scene(toml, (folder_ / "scene.toml").string()); });
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// The file of a kernel on this skin's own cells.
/// @param turned  columns before rows
inline Archive kernel_file(const SkinArray& skin, const Material& material, bool turned) {
  const LinearProblem problem = make_problem(skin, material);
  const SurfaceGrid& grid = problem.grid;
  const std::size_t rows = turned ? grid.columns : grid.rows;
  const std::size_t columns = turned ? grid.rows : grid.columns;
  const auto cell_at = [&](std::size_t row, std::size_t column) {
    return turned ? column * grid.columns + row : row * grid.columns + column;
  };
  std::vector<double> vertices;
  for (std::size_t row = 0; row <= rows; ++row)
    for (std::size_t column = 0; column <= columns; ++column) {
      const double y = (turned ? static_cast<double>(column) : static_cast<double>(row)) - 0.5;
      const double z = (turned ? static_cast<double>(row) : static_cast<double>(column)) - 0.5;
      const SpaceVector at =
          skin.curved->surface
              .tangents(grid.y(0) + y * grid.spacing_y, grid.z(0) + z * grid.spacing_z)
              .point;
      vertices.insert(vertices.end(), at.begin(), at.end());
    }
  std::vector<double> cells;
  std::vector<double> kernel(problem.kernel.values.size());
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const double corner = static_cast<double>(row * (columns + 1) + column);
      const double next = corner + static_cast<double>(columns + 1);
      // From outside y, then z is clockwise.
      if (turned)
        cells.insert(cells.end(), {corner, next, next + 1.0, corner + 1.0});
      else
        cells.insert(cells.end(), {corner, corner + 1.0, next + 1.0, next});
      const std::size_t place = row * columns + column;
      for (std::size_t reading = 0; reading < problem.kernel.rows; ++reading)
        for (std::size_t u = 0; u < 3; ++u)
          kernel[reading * problem.kernel.columns + u * grid.count() + place] =
              problem.kernel(reading, u * grid.count() + cell_at(row, column));
    }
  Archive archive;
  archive.add("K",
              "(" + std::to_string(problem.kernel.rows) + ", " +
                  std::to_string(problem.kernel.columns) + ")",
              kernel);
  archive.add("vertices", "(" + std::to_string(vertices.size() / 3) + ", 3)", vertices);
  archive.add("cells", "(" + std::to_string(cells.size() / 4) + ", 4)", cells);
  archive.add("readings", reading_names(skin));
  return archive;
}

}  // namespace tactile_net
