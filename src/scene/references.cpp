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

}  // namespace tactile_net
