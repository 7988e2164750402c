#include "commands/input.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "failure.hpp"
#include "tactile_net/scene/bounded_text.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::tool {

bool is_standard_input(const std::string& path) {
  constexpr std::array<std::string_view, 4> names = {"-", "/dev/stdin", "/dev/fd/0",
                                                     "/proc/self/fd/0"};
  return std::find(names.begin(), names.end(), path) != names.end();
}

InputText input_text(const std::string& path, std::istream& in) {
  if (!is_standard_input(path)) return {tactile_net::input_text(path), path};
  const std::string name = "<stdin>";
  return {tactile_net::input_text(in, name), name};
}

Scene read_scene(const std::string& path, std::istream& in) {
  const InputText input = input_text(path, in);
  return parse_scene(input.text, input.name);
}

AnyScene read_any_scene(const std::string& path, std::istream& in) {
  const InputText input = input_text(path, in);
  return parse_any_scene(input.text, input.name);
}

AnyHand read_any_hand(const std::string& path, std::istream& in, const HandOptions& options) {
  const InputText input = input_text(path, in);
  return parse_any_hand(input.text, input.name, options);
}

void check_one_standard_input(const std::string& scene, const std::string& readings) {
  if (is_standard_input(scene) && is_standard_input(readings))
    throw WrongUsage("--readings",
                     "standard input is the scene already, and it holds one of the two: give the "
                     "scene or the readings as a file");
}

}  // namespace tactile_net::tool
