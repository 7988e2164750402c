// Scenes of curved skins: taxels with normals, [surface], and a kernel from a file.
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tactile_net/skin/curved_skin.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tests/catch.hpp"
#include "tests/scene/finger_scene.hpp"

using namespace tactile_net;

TEST_CASE("taxels with normals make a curved skin", "[scene][curved]") {
  const FingerScene finger;
  const SkinScene scene = finger.read(FingerScene::text());
  REQUIRE(scene.sensor.curved);
  CHECK(scene.sensor.curved->shape == SurfaceShape::sphere);
  CHECK(scene.sensor.curved->axes == ReadingAxes::sensor);
  CHECK(scene.sensor.curved->kernel == CurvedKernel::ball);
  CHECK(std::abs(scene.sensor.curved->surface.curvature() * 30e-3 - 1.0) <= 1e-12);
  CHECK(components(scene) == 3);
  const SkinScene stated = finger.read(FingerScene::text(
      "[surface]\nshape = \"sphere\"\ncentre = [0, 0, 0]\nradius = 30\nreference = [0, 2, 0]\n"
      "[reconstruct]\nkernel = \"flat\"\nmoment_about = [0, 0, 10.0]\n"));
  CHECK(stated.sensor.curved->kernel == CurvedKernel::flat);
  CHECK(stated.reconstruct.moment_about == SpaceVector{0.0, 0.0, 10e-3});
  CHECK(length(combined(1.0, stated.sensor.curved->above[3].point, -1.0,
                        scene.sensor.curved->above[3].point)) <= 1e-15);
}

TEST_CASE("a kernel on the skin's own cells, from a file, is the skin's own", "[scene][curved]") {
  const FingerScene finger;
  const SkinScene scene = finger.read(FingerScene::text());
  const bool turned = GENERATE(false, true);
  kernel_file(scene.sensor, scene.material, turned).write(finger.folder() / "k.npz");
  const SkinScene given = finger.read(FingerScene::text("[reconstruct]\nkernel = \"k.npz\"\n"));
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
  const FingerScene finger;
  const auto refused = [&](const std::string& toml, const std::string& rule) {
    CHECK_THAT(finger.refusal(toml), ContainsSubstring(rule));
  };
  refused(FingerScene::text({}, {}), "say along which axes");
  refused(FingerScene::text({}, "frame = \"taxel\"\n"), "frame of displacements");
  refused(FingerScene::text("[surface]\nshape = \"cube\"\n"), "shape of a surface");
  refused(FingerScene::text("[surface]\nradius = -30\n"), "that of a hole");
  refused(FingerScene::text("[surface]\nradius = 0\n"), "must not be 0");
  refused(FingerScene::text("[surface]\ncentre = [0, 0]\n"), "must be three numbers");
  refused(FingerScene::text("[surface]\nreference = [0, 0, 1]\n"), "within 10 degrees");
  refused(FingerScene::text("[surface]\nshape = \"points\"\nradius = 30\n"), "a sphere's");
  refused(FingerScene::text("[surface]\ncolour = 3\n"), "colour");
  refused(FingerScene::text("[reconstruct]\nkernel = \"round\"\n"), "kernel");
  refused(FingerScene::text("[reconstruct]\nkernel = \"none.npz\"\n"), "not in order");
  refused(FingerScene::text("[reconstruct]\nmoment_about = 3\n"), "moment_about");
  std::string thick = FingerScene::text();
  thick.replace(thick.find("thickness = 4.0"), 15, "thickness = 31.");
  refused(thick, "");
  std::string metres = FingerScene::text();
  metres.replace(metres.find("\"mm\""), 4, "\"m\"");
  refused(metres, "state the unit");
  const std::string lattice = finger_head +
                              "[sensor]\nrows = 2\ncolumns = 2\npitch = 1\ndepth = 1\nreads = "
                              "[\"stress_x\"]\n";
  refused(lattice + "[surface]\nshape = \"sphere\"\n", "places in space");
  refused(lattice + "[reconstruct]\nkernel = \"ball\"\n", "is of a curved skin");
}

TEST_CASE("what is wrong with a file of curved taxels is said with its line", "[scene][curved]") {
  CHECK_THAT(FingerScene("name,x,y,z,nx,ny,n,depth").refusal(FingerScene::text()),
             ContainsSubstring("another name than"));
  CHECK_THAT(FingerScene("name,x,y,z,nx,ny,depth,reads").refusal(FingerScene::text()),
             ContainsSubstring("all of the columns"));
  const auto with_row = [](const std::string& row) {
    return FingerScene("name,x,y,z,nx,ny,nz,depth",
                       [=](std::size_t i, const std::string& own) { return i == 3 ? row : own; })
        .refusal(FingerScene::text());
  };
  CHECK_THAT(with_row("t3,0,0,28.8,0,0,1.1,1.2"), ContainsSubstring("taxel t3"));
  CHECK_THAT(with_row("t3,0,0,28.8,0,0,-1,1.2"), ContainsSubstring("taxel t3"));
  CHECK_THAT(with_row("t3,0,0,x,0,0,1,1.2"), ContainsSubstring("line 5"));
  CHECK_THAT(with_row("t3,0,0,28.8,0,0,1,0"), ContainsSubstring("depth is not > 0"));
}

TEST_CASE("what is wrong with a kernel's file is said", "[scene][curved]") {
  const FingerScene finger;
  const SkinScene scene = finger.read(FingerScene::text());
  const std::string toml = FingerScene::text("[reconstruct]\nkernel = \"k.npz\"\n");
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
  for (const double corner : {-1.0, 1e6, 0.5}) {
    cells[5] = corner;
    inside.add("cells", "(" + std::to_string(cells.size() / 4) + ", 4)", cells);
    inside.write(path);
    refused("no vertex");
  }
  inside.add("cells", "(" + std::to_string(cells.size() / 2) + ", 2)", cells);
  inside.write(path);
  refused("not (any, 3) or (any, 4)");
  Archive good = kernel_file(scene.sensor, scene.material, false);
  good.write(path);
  CHECK_THAT(
      finger.refusal(FingerScene::text("[reconstruct]\nkernel = \"k.npz\"\nspacing = 1.0\n")),
      ContainsSubstring("brings its own cells"));
}

TEST_CASE("what a kernel's file says beside its kernel must be true", "[scene][curved]") {
  const FingerScene finger;
  const SkinScene scene = finger.read(FingerScene::text());
  const LinearProblem problem = make_problem(scene.sensor, scene.material);
  const std::string toml = FingerScene::text("[reconstruct]\nkernel = \"k.npz\"\n");
  const auto path = finger.folder() / "k.npz";
  const auto refused = [&](const std::string& rule, const auto& add) {
    Archive archive = kernel_file(scene.sensor, scene.material, false);
    add(archive);
    archive.write(path);
    CHECK_THAT(finger.refusal(toml), ContainsSubstring(rule));
  };
  const std::size_t count = problem.grid.count();
  const std::string cells = "(" + std::to_string(count);
  const auto forces = [&](Archive& archive, double scale, double shift) {
    std::vector<double> force;
    std::vector<double> moment;
    for (const SurfaceCell& cell : *problem.cells)
      for (std::size_t u = 0; u < 3; ++u)
        for (std::size_t k = 0; k < 3; ++k) {
          force.push_back(scale * cell.force[u][k]);
          moment.push_back(cell.moment[u][k] + shift * cell.area);
        }
    archive.add("F", cells + ", 3, 3)", force);
    archive.add("M", cells + ", 3, 3)", moment);
  };
  for (const double modulus : {0.0, -0.25e6, std::nan("")})
    refused("youngs_modulus must be > 0",
            [&](Archive& archive) { archive.add("youngs_modulus", "()", {modulus}); });
  refused("holds 5 texts, and the sensor has 60 readings",
          [](Archive& archive) { archive.add("units", std::vector<std::string>(5, "m")); });
  refused("holds 0 texts", [](Archive& archive) { archive.add("units", "(1,)", {1.0}); });
  refused("the array frame is not one text",
          [](Archive& archive) { archive.add("frame", "()", {1.0}); });
  // In mm2, about another origin.
  refused("areas are in m2", [&](Archive& archive) {
    archive.add("areas", cells + ",)", std::vector<double>(count, 1.0));
  });
  refused("F of cell 0", [&](Archive& archive) { forces(archive, 1e6, 0.0); });
  refused("M of cell 0", [&](Archive& archive) { forces(archive, 1.0, 0.1); });
  refused("lies below none of the kernel's cells", [&](Archive& archive) {
    std::vector<double> millimetres;
    for (std::size_t row = 0; row <= problem.grid.rows; ++row)
      for (std::size_t column = 0; column <= problem.grid.columns; ++column) {
        const double y = static_cast<double>(row) - 0.5;
        const double z = static_cast<double>(column) - 0.5;
        const SpaceVector at = scene.sensor.curved->surface
                                   .tangents(problem.grid.y(0) + y * problem.grid.spacing_y,
                                             problem.grid.z(0) + z * problem.grid.spacing_z)
                                   .point;
        for (const double x : at) millimetres.push_back(1e3 * x);
      }
    archive.add("vertices", "(" + std::to_string(millimetres.size() / 3) + ", 3)", millimetres);
  });
}

TEST_CASE("no more is read of a kernel's file than there is", "[scene][curved]") {
  const FingerScene finger;
  const SkinScene scene = finger.read(FingerScene::text());
  const std::string toml = FingerScene::text("[reconstruct]\nkernel = \"k.npz\"\n");
  const auto path = finger.folder() / "k.npz";
  kernel_file(scene.sensor, scene.material, false).write(path);
  // The list says that K, its first array, takes 4 GB.
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  file.seekp(static_cast<std::streamoff>(bytes.find("PK\x01\x02")) + 20);
  file.write("\xff\xff\xff\xfe\xff\xff\xff\xfe", 8);
  file.close();
  CHECK_THAT(finger.refusal(toml), ContainsSubstring("the array K is cut off"));
  // A pipe that nobody writes into.
  std::filesystem::remove(path);
  REQUIRE(mkfifo(path.c_str(), 0600) == 0);
  CHECK_THAT(finger.refusal(toml), ContainsSubstring("a pipe or a device, and no file"));
}
