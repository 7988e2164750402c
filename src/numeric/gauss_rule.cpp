#include "numeric/gauss_rule.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cassert>

namespace tactile_net {
namespace {

template <unsigned points>
GaussRule of_boost() noexcept {
  using Rule = boost::math::quadrature::gauss<double, points>;
  return {Rule::abscissa(), Rule::weights()};
}

}  // namespace

GaussRule gauss_rule(std::size_t points) noexcept {
  switch (points) {
    case 4: return of_boost<4>();
    case 5: return of_boost<5>();
    case 7: return of_boost<7>();
    case 9: return of_boost<9>();
    case 10: return of_boost<10>();
    case 12: return of_boost<12>();
    case 16: return of_boost<16>();
  }
  assert(points == 20);
  return of_boost<20>();
}

}  // namespace tactile_net
