#include "tactile_net/scene/reader.hpp"

#include "scene/document.hpp"
#include "scene/sections.hpp"
#include "scene/skin_sections.hpp"
#include "scene/table.hpp"
#include "tactile_net/scene/bounded_text.hpp"

namespace tactile_net {

namespace {

constexpr FileKind skin_file{
    "scene",
    "the smallest scene of a skin is [sensor] with rows, columns, pitch, depth and reads, and "
    "[material] with youngs_modulus and poisson_ratio"};

/// By `read`, which fills a scene of its kind from the document.
template <typename Kind, typename Sections>
Kind parse_as(const toml::table& toml, const std::filesystem::path& path, Problems& problems,
              Sections read) {
  Kind scene;
  scene.file = path.filename().string();
  Table root{toml, "", problems};
  read(root, path.parent_path(), scene);
  problems.throw_if_any();
  return scene;
}

AnyScene parse_named(std::string_view text, const std::string& file, bool skins) {
  const std::filesystem::path path{file};
  text = without_byte_order_mark(text);
  Problems problems{file, text};
  const toml::table toml = parse_document(text, file, problems);
  if (!is_skin(toml, path.parent_path()))
    return parse_as<Scene>(toml, path, problems, read_sections);
  if (!skins) {
    refuse_skin(toml, problems);
    problems.throw_if_any();
  }
  Problems of_skin{file, text, skin_file};
  return parse_as<SkinScene>(toml, path, of_skin, read_skin_sections);
}

}  // namespace

void refuse_skin(const toml::table& scene, Problems& problems) {
  problems.add(place_of(scene.get("sensor")->source().begin),
               "[sensor] is of a skin, and this handles line arrays only",
               "run, simulate, solve, check, identify, calibrate, plan, tradeoff, gen, relax and "
               "certify know skins");
}

Scene read_scene(const std::filesystem::path& path) {
  return std::get<Scene>(parse_named(input_text(path), path.string(), false));
}

Scene parse_scene(std::string_view toml, const std::string& file) {
  return std::get<Scene>(parse_named(toml, file, false));
}

AnyScene read_any_scene(const std::filesystem::path& path) {
  return parse_named(input_text(path), path.string(), true);
}

AnyScene parse_any_scene(std::string_view toml, const std::string& file) {
  return parse_named(toml, file, true);
}

}  // namespace tactile_net
