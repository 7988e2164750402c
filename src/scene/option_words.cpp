#include "tactile_net/scene/option_words.hpp"

#include <atomic>

#include "numeric/named.hpp"

namespace tactile_net {
namespace {

constexpr Named<Option> option_names[] = {
    {Option::accuracy, "accuracy"},
    {Option::allow_outside, "allow_outside"},
    {Option::columns, "columns"},
    {Option::force, "force"},
    {Option::frame, "frame"},
    {Option::json, "json"},
    {Option::missing, "missing"},
    {Option::no_diagnostics, "no_diagnostics"},
    {Option::quantity, "quantity"},
    {Option::readings, "readings"},
    {Option::realization, "realization"},
    {Option::resume, "resume"},
    {Option::robust, "robust"},
    {Option::time_limit, "time_limit"},
};

std::string neutral(Option option, std::string_view value) {
  std::string text(name(option));
  if (!value.empty()) text.append(" = ").append(value);
  return text;
}

std::atomic<OptionWords> spelling = neutral;

}  // namespace

std::string_view name(Option option) noexcept { return name_in<option_names>(option); }

void spell_options(OptionWords words) noexcept { spelling = words != nullptr ? words : neutral; }

std::string option(Option option, std::string_view value) { return spelling.load()(option, value); }

}  // namespace tactile_net
