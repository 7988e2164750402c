// Files that a scene names: whatever their bytes, a scene or a refusal in words.
#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "src/scene/kernel_file.hpp"
#include "src/scene/mesh_file.hpp"
#include "tests/catch.hpp"
#include "tests/damaged.hpp"
#include "tests/scene/finger_scene.hpp"

using namespace tactile_net;

namespace {

constexpr int rounds = 1500;

void put(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What a reader says of damaged files. @return how many it took
template <class Read>
int count_read(const std::filesystem::path& path, const std::vector<std::string>& seeds,
               const std::string& letters, Read read) {
  std::mt19937 random(11);
  int taken = 0;
  for (int round = 0; round < rounds; ++round) {
    const std::string bytes = test::damaged(seeds[random() % seeds.size()], letters, random);
    put(path, bytes);
    CAPTURE(round, bytes.substr(0, 2000));
    try {
      read();
      ++taken;
    } catch (const std::runtime_error& error) {
      CHECK_THAT(std::string(error.what()), !ContainsSubstring("::"));
    } catch (const std::invalid_argument& error) {
      CHECK_THAT(std::string(error.what()), !ContainsSubstring("::"));
    }
  }
  return taken;
}

}  // namespace

TEST_CASE("any bytes are a mesh or are refused in words", "[scene][fuzz]") {
  const FingerScene finger;
  const std::vector<std::string> objects = {
      "# cap\nv 0 0 8\nv 5 0 7.5\nv 5 5 7\nv 0 5 7.5\nf 1 2 3\nf 1 3 4\n",
      "\xef\xbb\xbfv 0 0 8 1 1 1\r\nv 5 0 7.5\r\nv 5 5 7\r\nf -3//1 -2//1 -1//1\r\n"};
  const std::string facet =
      " facet normal 0 0 1\n  outer loop\n   vertex 0 0 8\n   vertex 5 0 7.5\n   vertex 5 5 7\n"
      "  endloop\n endfacet\n";
  std::string binary(80, ' ');
  binary += std::string("\x01\0\0\0", 4) + std::string(12, '\0');
  for (const char* number : {"\0\0\0\0", "\0\0\0\0", "\0\0\0\x41", "\0\0\xa0\x40", "\0\0\0\0",
                             "\0\0\xf0\x40", "\0\0\xa0\x40", "\0\0\xa0\x40", "\0\0\xe0\x40"})
    binary += std::string(number, 4);
  binary += std::string(2, '\0');
  const std::vector<std::string> solids = {"solid a\n" + facet + "endsolid a\n", binary};
  const Unit unit = *unit_named(Dimension::length, "mm");
  for (const bool is_object : {true, false}) {
    const auto path = finger.folder() / (is_object ? "any.obj" : "any.stl");
    const int taken =
        count_read(path, is_object ? objects : solids, "0123456789.-+ efv/\n\r\\#", [&] {
          const SurfaceMesh mesh = read_mesh_file(path, unit);
          CHECK(!mesh.triangles.empty());
          for (const auto& triangle : mesh.triangles)
            for (const std::size_t corner : triangle) CHECK(corner < mesh.vertices.size());
          for (const SpaceVector& vertex : mesh.vertices)
            for (const double x : vertex) CHECK(std::isfinite(x));
        });
    CHECK(taken > rounds / 50);
    CHECK(taken < rounds);
  }
}

TEST_CASE("any bytes are a kernel or are refused in words", "[scene][fuzz]") {
  const FingerScene finger;
  const SkinScene scene = finger.read(FingerScene::text());
  const auto path = finger.folder() / "k.npz";
  Archive archive = kernel_file(scene.sensor, scene.material, false);
  archive.add("youngs_modulus", "()", {0.25e6});
  archive.add("units", std::vector<std::string>(60, "m"));
  archive.write(path);
  const std::string good = bytes_of(path);
  // What is said of the arrays is few of the bytes: the kernel's are left out.
  const std::size_t numbers = good.find('\n') + 1;
  const std::size_t end = good.find("PK\x03\x04", numbers);
  std::mt19937 random(5);
  int taken = 0;
  for (int round = 0; round < rounds; ++round) {
    std::string rest = good.substr(0, numbers) + good.substr(end);
    for (auto left = 1 + random() % 3; left > 0; --left)
      rest[random() % rest.size()] = static_cast<char>(random() % 256);
    rest.insert(numbers, good.substr(numbers, end - numbers));
    if (round % 10 == 0) rest.resize(random() % rest.size());
    put(path, rest);
    CAPTURE(round);
    try {
      const GivenKernel kernel = read_kernel_file(path, scene.sensor, scene.material);
      ++taken;
      CHECK(kernel.kernel.rows == 60);
      CHECK(kernel.kernel.columns == 3 * kernel.cells.size());
    } catch (const std::runtime_error& error) {
      CHECK_THAT(std::string(error.what()), !ContainsSubstring("::"));
    }
  }
  CHECK(taken > rounds / 50);
  CHECK(taken < rounds);
}

TEST_CASE("any bytes are measured parts or are refused in words", "[scene][fuzz]") {
  const FingerScene finger;
  const std::string toml =
      "[sensor]\ncount = 4\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
      "[network]\nrealization = \"lattice\"\n"
      "tolerance = { measured = { file = \"reel.csv\", nominal = 10e3 } }\n";
  const int taken = count_read(
      finger.folder() / "reel.csv",
      {"part,ohms\n1,10010\n2,10020\n3,9990\n",
       "\xef\xbb\xbf\"value [kohm]\";\"who\"\r\n10,01;\"a;b\"\r\n9,99;\"c\"\r\n"},
      "0123456789.,;\"\n\r\te-", [&] {
        const AnyScene scene = parse_any_scene(toml, (finger.folder() / "scene.toml").string());
        const auto& reel = std::get<Scene>(scene).network.tolerance.value().common.measured;
        REQUIRE(reel);
        CHECK(std::abs(reel->mean) <= 0.1);
        CHECK(reel->spread >= 0.0);
        CHECK(std::isfinite(reel->spread));
      });
  CHECK(taken > rounds / 50);
  CHECK(taken < rounds);
}
