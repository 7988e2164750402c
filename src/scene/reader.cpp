#include "tactile_net/scene/reader.hpp"

#include "scene/document.hpp"
#include "scene/sections.hpp"
#include "tactile_net/scene/bounded_text.hpp"

namespace tactile_net {

namespace {

AnyScene parse_named(std::string_view text, const std::string& file, bool skins) {
  const std::filesystem::path path{file};
  text = without_byte_order_mark(text);
  Problems problems{file, text};
  const toml::table toml = parse_document(text, file, problems);
  if (!skins && is_skin(toml, path.parent_path()))
    problems.add(place_of(toml.get("sensor")->source().begin),
                 "[sensor] describes a skin, and this works for lines of taxels only",
                 "run, simulate, solve, check, identify, calibrate, plan, tradeoff, gen, relax and "
                 "certify know skins");
  AnyScene scene = scene_in(toml, path, problems);
  problems.throw_if_any();
  return scene;
}

}  // namespace

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
