#include "numeric/gauss_rule.hpp"

#include <boost/math/quadrature/gauss.hpp>

namespace tactile_net {

template <std::size_t points>
GaussRule gauss_rule() noexcept {
  using Rule = boost::math::quadrature::gauss<double, points>;
  return {Rule::abscissa(), Rule::weights()};
}

template GaussRule gauss_rule<4>() noexcept;
template GaussRule gauss_rule<5>() noexcept;
template GaussRule gauss_rule<6>() noexcept;
template GaussRule gauss_rule<7>() noexcept;
template GaussRule gauss_rule<8>() noexcept;
template GaussRule gauss_rule<9>() noexcept;
template GaussRule gauss_rule<10>() noexcept;
template GaussRule gauss_rule<12>() noexcept;
template GaussRule gauss_rule<16>() noexcept;
template GaussRule gauss_rule<20>() noexcept;

}  // namespace tactile_net
