// Sums of Kronecker products against the matrix that they are sums of.
#include "study/kronecker_sum.hpp"

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tests/catch.hpp"
#include "tests/control/skins.hpp"

using namespace tactile_net;
using namespace tactile_net::study;

namespace {

constexpr double skin_alpha = 1e-3;

double product_error(KroneckerSum& sum, const Reconstruction& inverse,
                     const std::vector<double>& readings) {
  std::vector<double> f(inverse.tractions());
  std::vector<double> exact(inverse.tractions());
  sum.apply(readings, f);
  REQUIRE(inverse.solve(readings, exact) == FrameStatus::ok);
  double error = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    error = std::hypot(error, f[i] - exact[i]);
    size = std::hypot(size, exact[i]);
  }
  return error / size;
}

std::vector<double> noise(std::size_t count) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  std::vector<double> readings(count);
  for (double& reading : readings) reading = normal(generator);
  return readings;
}

/// |M - the sum|_F / |M|_F, reading by reading.
double matrix_error(KroneckerSum& sum, const Reconstruction& inverse) {
  double error = 0.0;
  double size = 0.0;
  std::vector<double> f(inverse.tractions());
  for (std::size_t j = 0; j < inverse.readings(); ++j) {
    std::vector<double> readings(inverse.readings());
    readings[j] = 1.0;
    sum.apply(readings, f);
    for (std::size_t i = 0; i < f.size(); ++i) {
      error = std::hypot(error, f[i] - inverse.transposed()(j, i));
      size = std::hypot(size, inverse.transposed()(j, i));
    }
  }
  return error / size;
}

}  // namespace

TEST_CASE("all Kronecker products together are the matrix itself", "[kronecker]") {
  for (const Skin& skin :
       {square(4), rectangle(3, 5), rectangle(1, 6), square(5, 1, {7}), two_depths(4)}) {
    CAPTURE(skin.name);
    const Reconstruction inverse = TikhonovFamily(skin.problem).reconstruction(skin_alpha);
    KroneckerSum sum = KroneckerTerms(skin.problem, inverse).sum(1e-15);
    CHECK(product_error(sum, inverse, noise(inverse.readings())) < 1e-12);
  }
}

TEST_CASE("a sum's error is what it says, below what was asked for, and falls with its terms",
          "[kronecker]") {
  const Skin skin = rectangle(4, 6);
  const Reconstruction inverse = TikhonovFamily(skin.problem).reconstruction(skin_alpha);
  const KroneckerTerms terms(skin.problem, inverse);
  double before = 1.0;
  std::size_t terms_before = 0;
  for (const double accuracy : {0.3, 0.1, 1e-2, 1e-3}) {
    CAPTURE(accuracy);
    KroneckerSum sum = terms.sum(accuracy);
    CHECK(sum.error() <= accuracy);
    CHECK(sum.error() < before);
    CHECK(sum.terms() > terms_before);
    CHECK_THAT(matrix_error(sum, inverse), WithinRel(sum.error(), 1e-6));
    before = sum.error();
    terms_before = sum.terms();
  }
  CHECK(terms.sum(0.1).multiplications() < terms.sum(1e-3).multiplications());
}

TEST_CASE("Kronecker products are of even skins, of their own inverse, and of a bounded size",
          "[kronecker]") {
  const Skin skin = square(4);
  const Reconstruction inverse = TikhonovFamily(skin.problem).reconstruction(skin_alpha);
  CHECK_THROWS_AS(KroneckerTerms(square(5).problem, inverse), std::invalid_argument);
  CHECK_THROWS_AS(KroneckerTerms(skin.problem, inverse).sum(0.0), std::invalid_argument);
  std::vector<Taxel> taxels;
  for (int i = 0; i < 5; ++i)
    taxels.push_back({"", 2e-3 * i, 1e-3 * i * i, 3e-3, {Quantity::stress_x}});
  const Skin uneven = skin_of("uneven", uneven_skin(taxels), {.components = 1});
  CHECK_THROWS_WITH(
      KroneckerTerms(uneven.problem, TikhonovFamily(uneven.problem).reconstruction(skin_alpha)),
      ContainsSubstring("rows and columns"));
}
