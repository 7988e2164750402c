// How Python spells what messages advise to ask for: "columns='2-42'", "force=True".
#include "tactile_net/scene/option_words.hpp"

#include "rooms.hpp"

namespace tactile_net::python {
namespace {

std::string spelled(Option option, std::string_view value) {
  switch (option) {
    case Option::allow_outside:
    case Option::force:
    case Option::robust:
      return std::string(name(option)) + "=True";
    case Option::no_diagnostics:
      return "diagnostics=False";
    case Option::json:
      return "to_dict()";
    default:
      return std::string(name(option)) + "=" +
             (value.empty() ? "" : "'" + std::string(value) + "'");
  }
}

}  // namespace

void bind_option_words() { spell_options(spelled); }

}  // namespace tactile_net::python
