#include <algorithm>

#include "numeric/named.hpp"
#include "tactile_net/inverse/data_verdict.hpp"

namespace tactile_net {
namespace {

constexpr Named<DataDoubt> doubts[] = {
    {DataDoubt::implausible, "implausible"}, {DataDoubt::pulls, "pulls"},
    {DataDoubt::bad_taxel, "bad_taxel"},     {DataDoubt::offset, "offset"},
    {DataDoubt::misfit, "misfit"},           {DataDoubt::friction_limit, "friction_limit"}};

}  // namespace

std::string_view name(DataDoubt doubt) noexcept { return name_in<doubts>(doubt); }

bool DataVerdict::has(DataDoubt doubt) const noexcept {
  return std::find(doubts.begin(), doubts.end(), doubt) != doubts.end();
}

}  // namespace tactile_net
