// Scenes whose surface is a mesh from a file, and kernels on triangles.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tests/catch.hpp"
#include "tests/scene/finger_scene.hpp"

using namespace tactile_net;

namespace {

/// A cap of 30 mm around the origin, as far as 12 mm to each side; in millimetres.
struct Cap {
  std::vector<SpaceVector> vertices{};
  std::vector<std::array<std::size_t, 3>> triangles{};
};

Cap cap_mesh(std::size_t cells = 12) {
  Cap cap;
  for (std::size_t i = 0; i <= cells; ++i)
    for (std::size_t j = 0; j <= cells; ++j) {
      const double x = 24.0 * static_cast<double>(i) / static_cast<double>(cells) - 12.0;
      const double y = 24.0 * static_cast<double>(j) / static_cast<double>(cells) - 12.0;
      cap.vertices.push_back({x, y, std::sqrt(900.0 - x * x - y * y)});
    }
  for (std::size_t i = 0; i < cells; ++i)
    for (std::size_t j = 0; j < cells; ++j) {
      const std::size_t at = i * (cells + 1) + j;
      cap.triangles.push_back({at, at + cells + 1, at + cells + 2});
      cap.triangles.push_back({at, at + cells + 2, at + 1});
    }
  return cap;
}

std::string obj_text(const Cap& cap, double unit = 1.0) {
  std::string text = "# a cap\no finger\n";
  for (const SpaceVector& vertex : cap.vertices) {
    text += "v";
    for (const double x : vertex) text += ' ' + shortest(unit * x);
    text += '\n';
  }
  text += "vn 0 0 1\nusemtl skin\n";
  for (const auto& triangle : cap.triangles) {
    text += "f";
    for (const std::size_t corner : triangle) text += ' ' + std::to_string(corner + 1) + "//1";
    text += '\n';
  }
  return text;
}

std::string stl_text(const Cap& cap) {
  std::string text = "solid finger\n";
  for (const auto& triangle : cap.triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const std::size_t corner : triangle) {
      text += "      vertex";
      for (const double x : cap.vertices[corner]) text += ' ' + shortest(x);
      text += '\n';
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid finger\n";
}

void append_little(std::string& bytes, std::uint32_t number) {
  for (int i = 0; i < 4; ++i, number >>= 8) bytes += static_cast<char>(number & 255);
}

std::string stl_bytes(const Cap& cap, std::uint32_t announced) {
  std::string bytes = "solid is what some binary files begin with";
  bytes.resize(80, ' ');
  append_little(bytes, announced);
  for (const auto& triangle : cap.triangles) {
    bytes.append(12, '\0');
    for (const std::size_t corner : triangle)
      for (const double x : cap.vertices[corner])
        append_little(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string on_mesh(const std::string& file, const std::string& more = "unit = \"mm\"\n") {
  return FingerScene::text("[surface]\nshape = \"mesh\"\nfile = \"" + file + "\"\n" + more);
}

void put(const FingerScene& finger, const std::string& name, const std::string& bytes) {
  std::ofstream(finger.folder() / name, std::ios::binary) << bytes;
}

double off(const SkinScene& one, const SkinScene& other) {
  double most = 0.0;
  for (std::size_t i = 0; i < one.sensor.curved->above.size(); ++i)
    most = std::max(most, length(combined(1.0, one.sensor.curved->above[i].point, -1.0,
                                          other.sensor.curved->above[i].point)));
  return most;
}

}  // namespace

TEST_CASE("a mesh in any file is the surface of a scene", "[scene][curved][mesh]") {
  const FingerScene finger;
  const Cap cap = cap_mesh();
  put(finger, "cap.obj", obj_text(cap));
  put(finger, "metres.obj", obj_text(cap, 1e-3));
  put(finger, "text.stl", stl_text(cap));
  put(finger, "BYTES.STL", stl_bytes(cap, static_cast<std::uint32_t>(cap.triangles.size())));
  const SkinScene sphere = finger.read(FingerScene::text());
  const SkinScene mesh = finger.read(on_mesh("cap.obj"));
  REQUIRE(mesh.sensor.curved);
  CHECK(mesh.sensor.curved->shape == SurfaceShape::mesh);
  CHECK(off(mesh, sphere) <= 1e-7);
  for (const SurfacePlace& place : mesh.sensor.curved->above)
    CHECK(std::abs(place.mean_curvature * 30e-3 - 1.0) <= 1e-3);
  CHECK(off(finger.read(on_mesh("metres.obj", "")), mesh) <= 1e-15);
  CHECK(off(finger.read(on_mesh("text.stl")), mesh) <= 1e-15);
  // As other programs write them: a mark of UTF-8, capitals, blanks, a long name, two bodies.
  const std::string mark = "\xef\xbb\xbf";
  std::string lines = obj_text(cap);
  lines.erase(0, lines.find("v "));
  put(finger, "mark.obj", mark + lines + "v 0 0 0\n");
  CHECK(off(finger.read(on_mesh("mark.obj")), mesh) <= 1e-15);
  const std::string text = stl_text(cap);
  std::string capitals = text;
  for (char& c : capitals) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  const std::size_t middle = text.find("  facet", text.size() / 2);
  for (const std::string& bytes :
       {mark + text, capitals, "\n  " + text,
        "solid " + std::string(3000, 'x') + text.substr(text.find('\n')),
        text.substr(0, middle) + "endsolid\nsolid\n" + text.substr(middle)}) {
    put(finger, "other.stl", bytes);
    CHECK(off(finger.read(on_mesh("other.stl")), mesh) <= 1e-15);
  }
  // Binary ones have seven digits.
  CHECK(off(finger.read(on_mesh("BYTES.STL")), mesh) <= 1e-8);
  // A polygon, and vertices counted from the end.
  std::string quads = obj_text(cap);
  quads.resize(quads.find("f "));
  for (std::size_t i = 0; i < cap.triangles.size(); i += 2) {
    const auto& [a, b, c] = cap.triangles[i];
    quads += "f";
    for (const std::size_t corner : {a, b, c, cap.triangles[i + 1][2]})
      quads += ' ' + std::to_string(static_cast<int>(corner) - 169);
    quads += '\n';
  }
  put(finger, "quads.obj", quads);
  CHECK(off(finger.read(on_mesh("quads.obj")), mesh) <= 1e-15);
}

TEST_CASE("taxels below a mesh need no normals", "[scene][curved][mesh]") {
  const FingerScene finger("name,x,y,z,depth", [](std::size_t i, const std::string& own) {
    std::string row = own;
    for (int field = 0; field < 3; ++field) {  // nx, ny, nz
      const std::size_t depth = row.rfind(',');
      row.erase(row.rfind(',', depth - 1), depth - row.rfind(',', depth - 1));
    }
    return i < 100 ? row : std::string();
  });
  put(finger, "cap.obj", obj_text(cap_mesh()));
  const SkinScene mesh = finger.read(on_mesh("cap.obj"));
  const FingerScene with_normals;
  CHECK(off(mesh, with_normals.read(FingerScene::text())) <= 1e-7);
}

TEST_CASE("what is wrong with a mesh's file is said", "[scene][curved][mesh]") {
  const FingerScene finger;
  const Cap cap = cap_mesh();
  const auto refused = [&](const std::string& file, const std::string& bytes,
                           const std::string& rule) {
    put(finger, file, bytes);
    CHECK_THAT(finger.refusal(on_mesh(file)), ContainsSubstring(rule));
  };
  const std::string obj = obj_text(cap);
  refused("none.obj", "", "holds no face");
  refused("cap.ply", obj, "neither an .obj nor an .stl");
  refused("cap.obj", "v 1 2\n" + obj, "line 1: a vertex needs three finite numbers");
  refused("cap.obj", "v 1 2 nan\n" + obj, "line 1: a vertex needs three finite numbers");
  refused("cap.obj", "v 1 2 1e999\n" + obj, "line 1: a vertex needs three finite numbers");
  refused("cap.obj", obj + "f 1 2\n", "a face names three vertices");
  refused("cap.obj", obj + "f 1 2 0\n", "a face names three vertices");
  refused("cap.obj", obj + "f 1 2 999\n", "triangle 289 names vertex 999 of 169");
  refused("cap.obj", obj + "f 1 2 -999\n", "a face names three vertices");
  refused("cap.obj", obj + "f 1 2 99999999999999999999\n", "a face names three vertices");
  refused("cap.obj", obj + "f 3 3 4\n", "triangle 289 has no area");
  std::string text = stl_text(cap);
  refused("cap.stl", text.substr(0, text.size() - 40), "cut short");
  refused("cap.stl", text.substr(0, text.size() / 2), "cut short");
  refused("cap.stl", "solid nothing\nendsolid nothing\n", "holds no triangle");
  refused("cap.stl", text + text.substr(0, text.find("  facet", text.size() / 2)), "cut short");
  refused("cap.obj", std::string("\xff\xfev\0 \0", 6) + obj, "UTF-16");
  text.erase(text.find("      vertex"),
             text.find('\n', text.find("      vertex")) + 1 - text.find("      vertex"));
  refused("cap.stl", text, "triangle 1 has 2 vertices");
  const auto count = static_cast<std::uint32_t>(cap.triangles.size());
  // A thousand million are announced: nothing is allotted for them.
  refused("cap.stl", stl_bytes(cap, 1'000'000'000), "announces 1000000000 triangles and holds 288");
  refused("cap.stl", stl_bytes(cap, count).substr(0, 9000), "holds 178");
  refused("cap.stl", stl_bytes(cap, count) + "more", "holds 288 and 4 bytes more");
  refused("cap.stl", "short", "84 bytes");
  Cap bad = cap;
  bad.vertices[bad.triangles[20][1]][2] = std::numeric_limits<double>::infinity();
  refused("cap.stl", stl_bytes(bad, count), "triangle 19 has a number that is not finite");

  put(finger, "cap.obj", obj);
  const auto said = [&](const std::string& toml, const std::string& rule) {
    CHECK_THAT(finger.refusal(toml), ContainsSubstring(rule));
  };
  // Millimetres that are taken for metres.
  said(on_mesh("cap.obj", ""), "state the unit");
  said(on_mesh("cap.obj", "unit = \"um\"\n"), "state the unit");
  said(on_mesh("cap.obj", "unit = \"Pa\"\n"), "must be a unit of lengths");
  said(on_mesh("nowhere.obj"), "there is no such file");
  said(on_mesh("../cap.obj"), "beside the scene's");
  said(FingerScene::text("[surface]\nshape = \"mesh\"\n"), "file");
  said(FingerScene::text("[surface]\nfile = \"cap.obj\"\n"), "is of the shape mesh");
  said(on_mesh("cap.obj", "unit = \"mm\"\nradius = 30.0\n"), "a sphere's");
  said(on_mesh("cap.obj") + "[reconstruct]\nmargin = 5.0\n", "smaller margin");
  // Ten times as large.
  said(on_mesh("cap.obj", "unit = \"cm\"\n"), "is open above taxel");
}

TEST_CASE("a kernel of a file may have triangles, in any order", "[scene][curved][triangles]") {
  const FingerScene finger;
  const SkinScene scene = finger.read(FingerScene::text());
  const LinearProblem own = make_problem(scene.sensor, scene.material);
  // Every quadrilateral in two halves, each of which causes half of what it does; the last first.
  Archive archive = kernel_file(scene.sensor, scene.material, false);
  const std::size_t count = own.grid.count();
  std::vector<double> cells;
  std::vector<double> kernel(2 * own.kernel.values.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t cell = count - 1 - i;
    const std::size_t row = cell / own.grid.columns;
    const auto corner = static_cast<double>(cell + row);
    const auto next = corner + static_cast<double>(own.grid.columns) + 1.0;
    cells.insert(cells.end(), {corner, corner + 1.0, next + 1.0, corner, next + 1.0, next});
    for (std::size_t reading = 0; reading < own.kernel.rows; ++reading)
      for (std::size_t u = 0; u < 3; ++u)
        for (std::size_t half = 0; half < 2; ++half)
          kernel[(3 * reading + u) * 2 * count + 2 * i + half] =
              0.5 * own.kernel(reading, u * count + cell);
  }
  archive.add("K", "(" + std::to_string(own.kernel.rows) + ", " + std::to_string(6 * count) + ")",
              kernel);
  archive.add("cells", "(" + std::to_string(2 * count) + ", 3)", cells);
  archive.write(finger.folder() / "k.npz");
  const std::string toml = FingerScene::text("[reconstruct]\nkernel = \"k.npz\"\n");
  const SkinScene given = finger.read(toml);
  REQUIRE(given.sensor.curved->given);
  CHECK(given.sensor.curved->given->rows == 0);
  const LinearProblem found = make_problem(given.sensor, given.material);
  REQUIRE(found.grid.count() == count);
  double largest = 0.0;
  double apart = 0.0;
  for (std::size_t i = 0; i < own.kernel.values.size(); ++i) {
    largest = std::max(largest, std::abs(own.kernel.values[i]));
    apart = std::max(apart, std::abs(own.kernel.values[i] - found.kernel.values[i]));
  }
  CHECK(apart <= 0.02 * largest);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t u = 0; u < 3; ++u)
      CHECK(length(combined(1.0, (*own.cells)[i].force[u], -1.0, (*found.cells)[i].force[u])) <=
            0.03 * (*own.cells)[i].area);
  // The chart's cells are the scene's to choose, as far as the triangles reach.
  CHECK(finger.read(toml + "spacing = 1.0\n").sensor.curved->given);
  // What they leave out far from all taxels bears nothing.
  CHECK(make_problem(finger.read(toml + "margin = 4.0\n").sensor, scene.material,
                     {.grid = {.margin = 4e-3}})
            .cells->front()
            .force == std::array<SpaceVector, 3>{});
}
