#include "tactile_net/scene/reader.hpp"

#include "scene/document.hpp"
#include "scene/sections.hpp"
#include "scene/table.hpp"
#include "tactile_net/scene/bounded_text.hpp"

namespace tactile_net {

namespace {

Scene parse_named(std::string_view text, const std::string& file) {
  const std::filesystem::path path{file};
  text = without_byte_order_mark(text);
  Problems problems{file, text};
  const toml::table toml = parse_document(text, file, problems);

  Scene scene;
  scene.file = path.filename().string();
  Table root{toml, "", problems};
  read_sections(root, path.parent_path(), scene);
  problems.throw_if_any();
  return scene;
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
  return parse_named(input_text(path), path.string());
}

Scene parse_scene(std::string_view toml, const std::string& file) {
  return parse_named(toml, file);
}

}  // namespace tactile_net
