// Scenes of curved skins: taxels with normals, [surface], and a kernel from a file.
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
#include "tests/catch.hpp"
#include "tests/scene/refusal.hpp"

using namespace tactile_net;

namespace {

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

const std::string base_scene = R"([units]
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
class Finger {
 public:
  explicit Finger(const std::string& header = "name,x,y,z,nx,ny,nz,depth",
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
  ~Finger() { std::filesystem::remove_all(folder_); }
  Finger(const Finger&) = delete;
  Finger& operator=(const Finger&) = delete;

  [[nodiscard]] static std::string text(const std::string& more = {},
                                        const std::string& sensor = "frame = \"sensor\"\n") {
    return base_scene +
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
Archive kernel_file(const SkinArray& skin, const Material& material, bool turned) {
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

}  // namespace

TEST_CASE("taxels with normals make a curved skin", "[scene][curved]") {
  const Finger finger;
  const SkinScene scene = finger.read(Finger::text());
  REQUIRE(scene.sensor.curved);
  CHECK(scene.sensor.curved->shape == SurfaceShape::sphere);
  CHECK(scene.sensor.curved->axes == ReadingAxes::sensor);
  CHECK(scene.sensor.curved->kernel == CurvedKernel::ball);
  CHECK(std::abs(scene.sensor.curved->surface.curvature() * 30e-3 - 1.0) <= 1e-12);
  CHECK(components(scene) == 3);
  const SkinScene stated = finger.read(Finger::text(
      "[surface]\nshape = \"sphere\"\ncentre = [0, 0, 0]\nradius = 30\nreference = [0, 2, 0]\n"
      "[reconstruct]\nkernel = \"flat\"\nmoment_about = [0, 0, 10.0]\n"));
  CHECK(stated.sensor.curved->kernel == CurvedKernel::flat);
  CHECK(stated.reconstruct.moment_about == SpaceVector{0.0, 0.0, 10e-3});
  CHECK(length(combined(1.0, stated.sensor.curved->above[3].point, -1.0,
                        scene.sensor.curved->above[3].point)) <= 1e-15);
}

TEST_CASE("a kernel on the skin's own cells, from a file, is the skin's own", "[scene][curved]") {
  const Finger finger;
  const SkinScene scene = finger.read(Finger::text());
  const bool turned = GENERATE(false, true);
  kernel_file(scene.sensor, scene.material, turned).write(finger.folder() / "k.npz");
  const SkinScene given = finger.read(Finger::text("[reconstruct]\nkernel = \"k.npz\"\n"));
  REQUIRE(given.sensor.curved->given);
  const LinearProblem own = make_problem(scene.sensor, scene.material);
  const LinearProblem found = make_problem(given.sensor, given.material);
  REQUIRE(found.grid.rows == own.grid.rows);
  REQUIRE(found.grid.columns == own.grid.columns);
  double largest = 0.0;
  double off = 0.0;
  // Flat cells are smaller than what they stand for by about (spacing / radius)^2 / 12.
  for (std::size_t row = 0; row < own.kernel.rows; ++row)
    for (std::size_t i = 0; i < own.kernel.columns; ++i) {
      largest = std::max(largest, std::abs(own.kernel(row, i)));
      off = std::max(off, std::abs(own.kernel(row, i) - found.kernel(row, i)));
    }
  CHECK(off <= 2e-3 * largest);
  for (std::size_t i = 0; i < own.grid.count(); ++i)
    for (std::size_t u = 0; u < 3; ++u)
      CHECK(length(combined(1.0, (*own.cells)[i].force[u], -1.0, (*found.cells)[i].force[u])) <=
            2e-3 * (*own.cells)[i].area);
  for (std::size_t i = 0; i < scene.sensor.taxels.size(); ++i)
    CHECK(std::hypot(scene.sensor.taxels[i].y - given.sensor.taxels[i].y,
                     scene.sensor.taxels[i].z - given.sensor.taxels[i].z) <= 5e-5);
}

TEST_CASE("what is wrong with a curved skin is said where it stands", "[scene][curved]") {
  const Finger finger;
  const auto refused = [&](const std::string& toml, const std::string& rule) {
    CHECK_THAT(finger.refusal(toml), ContainsSubstring(rule));
  };
  refused(Finger::text({}, {}), "say along which axes");
  refused(Finger::text({}, "frame = \"taxel\"\n"), "frame of displacements");
  refused(Finger::text("[surface]\nshape = \"cube\"\n"), "shape of a surface");
  refused(Finger::text("[surface]\nradius = -30\n"), "that of a hole");
  refused(Finger::text("[surface]\nradius = 0\n"), "must not be 0");
  refused(Finger::text("[surface]\ncentre = [0, 0]\n"), "must be three numbers");
  refused(Finger::text("[surface]\nreference = [0, 0, 1]\n"), "within 10 degrees");
  refused(Finger::text("[surface]\nshape = \"points\"\nradius = 30\n"), "a sphere's");
  refused(Finger::text("[surface]\ncolour = 3\n"), "colour");
  refused(Finger::text("[reconstruct]\nkernel = \"round\"\n"), "kernel");
  refused(Finger::text("[reconstruct]\nkernel = \"none.npz\"\n"), "not in order");
  refused(Finger::text("[reconstruct]\nmoment_about = 3\n"), "moment_about");
  std::string thick = Finger::text();
  thick.replace(thick.find("thickness = 4.0"), 15, "thickness = 31.");
  refused(thick, "");
  std::string metres = Finger::text();
  metres.replace(metres.find("\"mm\""), 4, "\"m\"");
  refused(metres, "state the unit");
  const std::string lattice = base_scene +
                              "[sensor]\nrows = 2\ncolumns = 2\npitch = 1\ndepth = 1\nreads = "
                              "[\"stress_x\"]\n";
  refused(lattice + "[surface]\nshape = \"sphere\"\n", "places in space");
  refused(lattice + "[reconstruct]\nkernel = \"ball\"\n", "is of a curved skin");
}

TEST_CASE("what is wrong with a file of curved taxels is said with its line", "[scene][curved]") {
  CHECK_THAT(Finger("name,x,y,z,nx,ny,n,depth").refusal(Finger::text()),
             ContainsSubstring("another name than"));
  CHECK_THAT(Finger("name,x,y,z,nx,ny,depth,reads").refusal(Finger::text()),
             ContainsSubstring("all of the columns"));
  const auto with_row = [](const std::string& row) {
    return Finger("name,x,y,z,nx,ny,nz,depth",
                  [=](std::size_t i, const std::string& own) { return i == 3 ? row : own; })
        .refusal(Finger::text());
  };
  CHECK_THAT(with_row("t3,0,0,28.8,0,0,1.1,1.2"), ContainsSubstring("taxel t3"));
  CHECK_THAT(with_row("t3,0,0,28.8,0,0,-1,1.2"), ContainsSubstring("taxel t3"));
  CHECK_THAT(with_row("t3,0,0,x,0,0,1,1.2"), ContainsSubstring("line 5"));
  CHECK_THAT(with_row("t3,0,0,28.8,0,0,1,0"), ContainsSubstring("depth is not > 0"));
}

TEST_CASE("what is wrong with a kernel's file is said", "[scene][curved]") {
  const Finger finger;
  const SkinScene scene = finger.read(Finger::text());
  const std::string toml = Finger::text("[reconstruct]\nkernel = \"k.npz\"\n");
  const auto path = finger.folder() / "k.npz";
  const auto refused = [&](const std::string& rule) {
    CHECK_THAT(finger.refusal(toml), ContainsSubstring(rule));
  };
  std::ofstream(path) << "PK and nothing else, in a file that is long enough for its end";
  refused("no .npz file");
  Archive own = kernel_file(scene.sensor, scene.material, false);
  own.add("thickness", "()", {5e-3});
  own.write(path);
  refused("thickness");
  Archive other = kernel_file(scene.sensor, scene.material, false);
  other.add("frame", "<U6", "()", std::string("l\0\0\0o\0\0\0c\0\0\0a\0\0\0l\0\0\0\0\0\0\0", 24));
  other.write(path);
  refused("along the local axes");
  Archive named = kernel_file(scene.sensor, scene.material, false);
  std::vector<std::string> names = reading_names(scene.sensor);
  names[4] = "displacement_x_t99";
  named.add("readings", names);
  named.write(path);
  refused("have no 'displacement_x_t4'");
  Archive zero = kernel_file(scene.sensor, scene.material, false);
  const LinearProblem problem = make_problem(scene.sensor, scene.material);
  std::vector<double> kernel(problem.kernel.values.size(), 0.0);
  const std::string shape = "(" + std::to_string(problem.kernel.rows) + ", " +
                            std::to_string(problem.kernel.columns) + ")";
  zero.add("K", shape, kernel);
  zero.write(path);
  refused("K is 0");
  kernel[7] = std::nan("");
  zero.add("K", shape, kernel);
  zero.write(path);
  refused("not finite");
  zero.add("K", "(3, 2)", std::vector<double>(6, 1.0));
  zero.write(path);
  refused("has the shape (3, 2)");
  Archive packed = kernel_file(scene.sensor, scene.material, false);
  packed.method = 8;
  packed.add("K", shape, kernel);
  packed.write(path);
  refused("is compressed");
  Archive inside = kernel_file(scene.sensor, scene.material, false);
  std::vector<double> cells;
  for (std::size_t row = 0; row < problem.grid.rows; ++row)
    for (std::size_t column = 0; column < problem.grid.columns; ++column) {
      const auto corner = static_cast<double>(row * (problem.grid.columns + 1) + column);
      const double next = corner + static_cast<double>(problem.grid.columns + 1);
      cells.insert(cells.end(), {corner, next, next + 1.0, corner + 1.0});
    }
  inside.add("cells", "(" + std::to_string(cells.size() / 4) + ", 4)", cells);
  inside.write(path);
  refused("cell");
  cells[5] = -1.0;
  inside.add("cells", "(" + std::to_string(cells.size() / 4) + ", 4)", cells);
  inside.write(path);
  refused("no vertex");
  Archive good = kernel_file(scene.sensor, scene.material, false);
  good.write(path);
  CHECK_THAT(finger.refusal(Finger::text("[reconstruct]\nkernel = \"k.npz\"\nspacing = 1.0\n")),
             ContainsSubstring("brings its own cells"));
}
