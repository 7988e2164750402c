#include "tactile_net/lab/missing.hpp"

#include <variant>

#include "numeric/named.hpp"

namespace tactile_net::lab {
namespace {

constexpr Named<Missing> policies[] = {
    {Missing::fail, "fail"}, {Missing::skip, "skip"}, {Missing::estimate, "estimate"}};

}  // namespace

std::string_view name(Missing missing) noexcept { return name_in<policies>(missing); }

std::optional<Missing> missing_named(std::string_view text) noexcept {
  return named_in<policies>(text);
}

bool can_leave_out(const AnyProblem& problem, Method method) {
  const auto* line = std::get_if<SceneProblem>(&problem);
  return traits(method).has_bands && (line == nullptr || !line->is_large());
}

}  // namespace tactile_net::lab
