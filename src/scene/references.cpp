#include "scene/references.hpp"

#include <system_error>

namespace tactile_net {

bool References::allow(const std::filesystem::path& path) const {
  if (allow_outside) return true;
  std::error_code error;
  const auto home = std::filesystem::weakly_canonical(folder, error);
  if (error) return false;
  // A link that points elsewhere is elsewhere.
  const auto place = std::filesystem::weakly_canonical(folder / path, error);
  if (error) return false;
  const auto relative = place.lexically_relative(home);
  return !relative.empty() && *relative.begin() != "..";
}

std::optional<std::filesystem::path> path_beside(const Value& value,
                                                 const std::filesystem::path& folder,
                                                 std::string_view example) {
  const References references{folder.empty() ? "." : folder};
  const std::string file = value.text().value_or("");
  if (file.empty()) {
    if (value.is_text()) value.problem("must name a file", std::string(example));
  } else if (references.allow(file)) {
    return references.folder / file;
  } else {
    value.misfit("must name a file beside the scene's or below its folder",
                 "or else a scene that you did not write could read any of your files");
  }
  return std::nullopt;
}

}  // namespace tactile_net
