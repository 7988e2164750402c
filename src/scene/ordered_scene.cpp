#include "tactile_net/scene/ordered_scene.hpp"

#include <toml++/toml.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "scene/document.hpp"
#include "scene/edited_text.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/scale_units.hpp"

namespace tactile_net {
namespace {

using KeyText = std::pair<std::string_view, std::string>;

/// What is to be stated of a scene that states something else.
std::vector<KeyText> settings_of(const NetworkOptions& network, const OrderedCircuit& ordered) {
  std::vector<KeyText> settings;
  if (network.realization != ordered.realization)
    settings.emplace_back("realization", '"' + std::string(name(ordered.realization)) + '"');
  if (network.parts.ladder != ordered.ladder)
    settings.emplace_back("ladder", ordered.ladder ? "true" : "false");
  if (network.parts.inverters) settings.emplace_back("inverters", "false");
  if (ordered.siemens) settings.emplace_back("siemens", shortest(*ordered.siemens));
  return settings;
}

/// The first key of a table that is no header of another table.
const toml::key* first_line_of(const toml::table& table) {
  const toml::key* first = nullptr;
  for (const auto& [key, node] : table) {
    const toml::table* const inner = node.as_table();
    const toml::array* const list = node.as_array();
    if ((inner != nullptr && !inner->is_inline()) ||
        (list != nullptr && list->is_array_of_tables() && !list->get(0)->as_table()->is_inline()))
      continue;
    if (first == nullptr || key.source().begin.line < first->source().begin.line) first = &key;
  }
  return first;
}

bool names_files(const std::string& text) {
  try {
    static_cast<void>(parse_any_scene(text, "no such folder/scene.toml"));
    return false;
  } catch (const InputError&) {
    return true;
  }
}

NetworkOptions network_of(const AnyScene& scene) {
  return std::visit([](const auto& one) { return one.network; }, scene);
}

/// Whether a scene states the circuit.
bool states(const NetworkOptions& network, const OrderedCircuit& ordered, double unit) {
  const double siemens = network.parts.scale.siemens / unit;
  return network.realization == ordered.realization && network.parts.ladder == ordered.ladder &&
         !network.parts.inverters &&
         (!ordered.siemens || std::abs(siemens - *ordered.siemens) <= 1e-12 * *ordered.siemens);
}

}  // namespace

std::string ordered_scene(std::string_view toml, const AnyScene& scene,
                          const OrderedCircuit& ordered, std::string_view by) {
  const std::string_view text = without_byte_order_mark(toml);
  const std::string file = std::visit([](const auto& one) { return one.file; }, scene);
  Problems problems(file, text);
  const toml::table root = parse_document(text, file, problems);
  const std::string line_end = text.find("\r\n") == std::string_view::npos ? "\n" : "\r\n";
  const AnyScene stated = parse_any_scene(text, file);
  EditedText edited(text);
  std::string lines;
  std::string inside;  // of a table in one line
  const toml::table* const network = root["network"].as_table();
  for (const auto& [key, value] : settings_of(network_of(stated), ordered)) {
    if (const toml::node* own = network == nullptr ? nullptr : network->get(key)) {
      edited.replace(*own, value);
    } else {
      lines.append(key).append(" = ").append(value).append(line_end);
      inside.append(" ").append(key).append(" = ").append(value).append(",");
    }
  }
  std::string tail;
  const toml::key* const first = network == nullptr ? nullptr : first_line_of(*network);
  const std::size_t begin = network == nullptr ? text.size() : edited.at(network->source().begin);
  const std::size_t header_end = text.find('\n', begin);
  const bool in_one_line = network != nullptr && network->is_inline();
  const bool below_header =
      text.substr(begin).starts_with("[network]") && header_end != std::string_view::npos;
  if (!lines.empty()) {
    const std::size_t behind = 1 + (in_one_line ? begin : header_end);
    if (first != nullptr && !in_one_line)
      edited.insert_line_before(first->source().begin, lines);
    else if (in_one_line || below_header)
      edited.replace(behind, behind, in_one_line ? inside : lines);
    else
      tail = line_end + "[network]" + line_end + lines;
  }
  std::string result = std::move(edited).text();
  if (!tail.empty() && !result.empty() && result.back() != '\n') result += line_end;
  result += tail;
  const std::string name = std::filesystem::path(file).filename().string();
  std::string head = "# " + name + " with the circuit that is ordered" +
                     (by.empty() ? std::string() : ", by " + std::string(by)) + '.';
  if (names_files(result)) head += " It names files: move it into the folder of " + name + '.';
  std::erase_if(head, [](char one) { return static_cast<unsigned char>(one) < 32; });
  const double unit =
      std::visit([](const auto& one) { return scale_units(one).siemens.to_si(1.0); }, stated);
  if (!states(network_of(parse_any_scene(result, file)), ordered, unit))
    throw std::invalid_argument(file + ": let [network] be a table of its own, a key a line");
  return head + line_end + result;
}

std::string ordered_scene_file(const std::string& scene) {
  const std::filesystem::path path(scene);
  return (path.has_extension() ? path.stem().string() : std::string("scene")) + ".ordered.toml";
}

}  // namespace tactile_net
