// Plans by FFT: what the convolution leaves wrong, what the correction makes right, and the
// promises of the per-frame call.
#include <array>
#include <bit>
#include <cstring>
#include <thread>

#include "src/control/circulant.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tests/catch.hpp"
#include "tests/control/frames.hpp"
#include "tests/control/pad.hpp"

using namespace tactile_net;

namespace {

/// Fixed pitch: the longer, the more taxels.
LinearProblem long_array(std::size_t count, std::vector<Quantity> reads = {Quantity::stress_x}) {
  const std::size_t unknowns = reads.size();
  return make_problem({count, 0.125, {1.5}, std::move(reads)}, pad,
                      {.unknowns = unknowns, .smoothing_length = 1.0});
}

PlannedEstimator fft_plan(const LinearProblem& problem, double accuracy = 1e-7,
                          bool diagnostics = false) {
  PlannerOptions options{.accuracy = accuracy, .structure = Structure::fft};
  options.diagnostics = diagnostics;
  return plan_estimator(problem, pad_alpha, options);
}

std::vector<double> solved(ContactEstimator& estimator, const std::vector<double>& readings) {
  std::vector<double> f(estimator.tractions());
  ContactEstimate estimate{.tractions = f};
  REQUIRE(estimator.update(readings, estimate) == FrameStatus::ok);
  return f;
}

/// Readings of one round contact, `centre` in taxels.
std::vector<double> round_contact(const LinearProblem& problem, double centre) {
  std::vector<double> f(problem.kernel.columns, 0.0);
  for (std::size_t i = 0; i < problem.grid.count(); ++i) {
    const double z = (static_cast<double>(i) - centre) / 16.0;
    if (std::abs(z) < 1.0) f[i] = std::sqrt(1.0 - z * z);
  }
  std::vector<double> g(problem.kernel.rows, 0.0);
  for (std::size_t i = 0; i < g.size(); ++i)
    for (std::size_t j = 0; j < f.size(); ++j) g[i] += problem.kernel(i, j) * f[j];
  return g;
}

std::size_t total_rank(const PlannedEstimator& planned) {
  const std::vector<std::size_t>& ranks = planned.candidates.front().ranks;
  return ranks.at(0) + ranks.at(1);
}

/// With two unknowns of two channels on a circle that wraps: blocks of both symmetries.
ProductPlan small_convolution() {
  ProductPlan plan{.structure = Structure::fft, .rows = 14, .columns = 14};
  plan.row_grid = plan.column_grid = line_blocks(7, {1, -1});
  for (const std::size_t size : class_sizes(plan.row_grid)) {
    const std::size_t rank = size > 0 ? 1 : 0;
    plan.factors.push_back({rank, size, std::vector<double>(size, 0.0)});
    plan.factors.push_back({size, rank, std::vector<double>(size, 0.0)});
  }
  plan.transform_size = 10;
  plan.spectra = random_values(4 * 6, 5);
  return plan;
}

}  // namespace

TEST_CASE("the convolution alone is percents off at the array's end, and right with its correction",
          "[fft]") {
  const LinearProblem problem = long_array(256);
  const Reconstruction dense = tikhonov(problem, pad_alpha);
  const PlannedEstimator planned = fft_plan(problem);
  EstimatorPlan bare = planned.plan;
  for (Factor& factor : bare.reconstruction.factors)
    std::fill(factor.values.begin(), factor.values.end(), 0.0);
  ContactEstimator corrected(planned.plan, fft_convolutions());
  ContactEstimator uncorrected(bare, fft_convolutions());
  const auto error = [&](ContactEstimator& estimator, double centre) {
    const std::vector<double> g = round_contact(problem, centre);
    std::vector<double> expected(256);
    REQUIRE(dense.solve(g, expected) == FrameStatus::ok);
    return relative_l2_error(solved(estimator, g), expected);
  };
  CHECK(error(uncorrected, 255.0) > 0.05);
  CHECK(error(uncorrected, 127.5) < 0.001);  // far from both ends nothing tells of them
  CHECK(error(corrected, 255.0) < 1e-7);
  CHECK(error(corrected, 127.5) < 1e-7);
}

TEST_CASE("at a fixed pitch the correction's rank does not grow with the array", "[fft]") {
  const auto low_rank = [](std::size_t count) {
    return total_rank(plan_estimator(
        long_array(count), pad_alpha,
        {.structure = Structure::reflections_low_rank, .precision = Precision::float64}));
  };
  // On circles that nothing wraps around, which the finest accuracies need.
  const PlannedEstimator one = fft_plan(long_array(128), 1e-10);
  const PlannedEstimator two = fft_plan(long_array(256), 1e-10);
  REQUIRE(one.candidates.front().transform_size == 256);
  REQUIRE(two.candidates.front().transform_size == 512);
  CHECK(total_rank(two) <= total_rank(one) + 2);
  CHECK(10 * low_rank(256) >= 18 * low_rank(128));
}

TEST_CASE("a plan by FFT keeps its accuracy, proven and measured, on long arrays", "[fft]") {
  const std::size_t count = GENERATE(std::size_t{127}, std::size_t{160});
  const bool two = GENERATE(false, true);
  const double accuracy = GENERATE(1e-3, 1e-6, 1e-9);
  CAPTURE(count, two, accuracy);
  const LinearProblem problem =
      two ? long_array(count, {Quantity::stress_x, Quantity::shear_xy}) : long_array(count);
  const Reconstruction dense = tikhonov(problem, pad_alpha);
  const PlannedEstimator planned = fft_plan(problem, accuracy);
  const Candidate& candidate = planned.candidates.front();
  CHECK(candidate.accurate);
  CHECK(candidate.error_bound <= accuracy);
  ContactEstimator estimator(planned.plan, fft_convolutions());
  std::vector<double> expected(dense.tractions());
  for (unsigned seed = 0; seed < 4; ++seed) {
    const std::vector<double> g =
        seed % 2 == 0 ? contact_readings(problem, seed) : random_values(dense.readings(), seed);
    REQUIRE(dense.solve(g, expected) == FrameStatus::ok);
    const std::vector<double> f = solved(estimator, g);
    const double error = l2_norm(difference(f, expected));
    CHECK(error <= candidate.error_bound * unit_of_error(problem, dense, g, expected));
    CHECK(solved(estimator, g) == f);  // the same bits
  }
}

TEST_CASE("a block that is a convolution is its own circulant", "[fft]") {
  const int sign = GENERATE(1, -1);
  const Eigen::Index n = GENERATE(1, 2, 7, 8);
  const auto size = static_cast<std::size_t>(2 * n);
  const std::vector<double> lags = random_values(static_cast<std::size_t>(n), 3);
  Eigen::MatrixXd block(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const double lag = i == j && sign < 0 ? 0.0 : lags[static_cast<std::size_t>(std::abs(i - j))];
      block(i, j) = i >= j ? lag : sign * lag;
    }
  const Eigen::MatrixXd corner = circulant_corner(circulant_spectrum(block, sign, size), sign, n);
  CHECK((corner - block).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("the FFT convolves as direct sums do, several blocks on a circle that wraps", "[fft]") {
  const ProductPlan plan = small_convolution();
  const auto convolution =
      fft_convolutions(GENERATE(FftEffort::estimate, FftEffort::measure))(plan);
  const std::vector<double> x = random_values(14, 7);
  std::vector<double> y = random_values(14, 8);
  std::vector<double> expected = y;
  for (std::size_t u = 0; u < 2; ++u)
    for (std::size_t c = 0; c < 2; ++c) {
      const auto first = plan.spectra.begin() + static_cast<std::ptrdiff_t>(6 * (2 * u + c));
      const Eigen::MatrixXd t = circulant_corner({first, first + 6}, u == c ? 1 : -1, 7);
      for (Eigen::Index i = 0; i < 7; ++i)
        for (Eigen::Index j = 0; j < 7; ++j)
          expected[7 * u + static_cast<std::size_t>(i)] +=
              t(i, j) * x[7 * c + static_cast<std::size_t>(j)];
    }
  for (int repeat = 0; repeat < 2; ++repeat) {  // what a frame leaves behind disturbs no other
    std::vector<double> sum = y;
    convolution->add(x.data(), sum.data());
    CHECK(l2_norm(difference(sum, expected)) < 1e-14);
  }
}

TEST_CASE("a plan by FFT survives its file, bit by bit", "[fft]") {
  const PlannedEstimator planned = fft_plan(long_array(64), 1e-7, true);
  const std::vector<std::byte> bytes = encode_plan(planned.plan);
  const EstimatorPlan read = decode_plan(bytes);
  CHECK(read.reconstruction.transform_size == planned.plan.reconstruction.transform_size);
  CHECK(read.reconstruction.spectra == planned.plan.reconstruction.spectra);
  CHECK(encode_plan(read) == bytes);
  ContactEstimator before(planned.plan, fft_convolutions());
  ContactEstimator after(read, fft_convolutions());
  const std::vector<double> g = random_values(64, 1);
  CHECK(solved(before, g) == solved(after, g));
}

TEST_CASE("a convolution that does not fit is refused", "[fft]") {
  const auto refused = [](auto&& spoil, const char* why) {
    ProductPlan plan = small_convolution();
    check(plan);
    spoil(plan);
    CHECK_THROWS_WITH(check(plan), ContainsSubstring(why));
  };
  for (const std::size_t size : {std::size_t{0}, std::size_t{6}, std::size_t{9}, std::size_t{22},
                                 std::size_t{1} << 30, ~std::size_t{0}})
    refused([&](ProductPlan& plan) { plan.transform_size = size; }, "the transform's size");
  refused([](ProductPlan& plan) { plan.transform_size = 12; }, "a spectrum for each block");
  refused([](ProductPlan& plan) { plan.spectra.pop_back(); }, "a spectrum for each block");
  refused([](ProductPlan& plan) { plan.spectra[3] = std::nan(""); }, "not finite");
  refused([](ProductPlan& plan) { plan.precision = Precision::float32; }, "float64");
  refused([](ProductPlan& plan) { plan.scale = 2.0; }, "scale 1");
  refused([](ProductPlan& plan) { plan.column_grid = line_blocks(14, {1}); },
          "blocks of one row and one length");
  refused(
      [](ProductPlan& plan) {
        for (GridBlocks* blocks : {&plan.row_grid, &plan.column_grid})
          std::swap(blocks->rows, blocks->columns);
      },
      "blocks of one row and one length");
  refused([](ProductPlan& plan) { plan.factors.pop_back(); }, "number of factors");
}

TEST_CASE("without a convolution a plan by FFT is refused, and the library with one named",
          "[fft]") {
  const EstimatorPlan plan = fft_plan(long_array(32)).plan;
  CHECK_THROWS_WITH(ContactEstimator(plan), ContainsSubstring("tactile_net::spectral"));
  CHECK_THROWS_WITH(ContactEstimator(plan, [](const ProductPlan&) { return nullptr; }),
                    ContainsSubstring("tactile_net::spectral"));
  ProductPlan dense{.rows = 1, .columns = 1};
  dense.factors = {{1, 1, {1.0}}};
  CHECK_THROWS_WITH(fft_convolutions()(dense), ContainsSubstring("structure fft"));
}

TEST_CASE("fft is offered only where it is allowed and the array is symmetric, and why not is said",
          "[fft]") {
  const LinearProblem problem = long_array(256);
  const auto offered = [](const PlannedEstimator& planned) {
    for (const Candidate& candidate : planned.candidates)
      if (candidate.structure == Structure::fft) return true;
    return false;
  };
  PlannerOptions options{.diagnostics = false};
  const PlannedEstimator without = plan_estimator(problem, pad_alpha, options);
  CHECK_FALSE(offered(without));
  CHECK_THAT(without.why(), ContainsSubstring("no fft: it needs an FFT"));

  options.allow_fft = true;
  const PlannedEstimator with = plan_estimator(problem, pad_alpha, options);
  CHECK(offered(with));
  CHECK(with.plan.reconstruction.structure == Structure::fft);  // the cheapest at this length
  CHECK_THAT(with.why(), ContainsSubstring("* fft float64, rank") &&
                             ContainsSubstring("transforms of") && !ContainsSubstring("no fft"));
  const PlannedEstimator short_array = plan_estimator(long_array(40), pad_alpha, options);
  CHECK(offered(short_array));
  CHECK(short_array.plan.reconstruction.structure != Structure::fft);

  const LinearProblem dead = make_problem({40, 0.125, {1.5}, {Quantity::stress_x}}, pad,
                                          {.smoothing_length = 1.0, .dead_taxels = {3}});
  const PlannedEstimator asymmetric = plan_estimator(dead, pad_alpha, options);
  CHECK_FALSE(offered(asymmetric));
  CHECK_THAT(asymmetric.why(), ContainsSubstring("no fft: the array is not mirror symmetric"));

  options.structure = Structure::fft;
  CHECK_THROWS_WITH(plan_estimator(dead, pad_alpha, options),
                    ContainsSubstring("fft cannot be used"));
  options.precision = Precision::float32;
  CHECK_THROWS_WITH(plan_estimator(problem, pad_alpha, options), ContainsSubstring("float64 only"));
}

TEST_CASE("residual and dead taxels are those of the dense plan", "[fft]") {
  const bool two = GENERATE(false, true);
  CAPTURE(two);
  const LinearProblem problem =
      two ? long_array(96, {Quantity::stress_x, Quantity::shear_xy}) : long_array(320);
  const EstimatorPlan plan = fft_plan(problem, 1e-9, true).plan;
  if (!two) REQUIRE(plan.prediction->structure == Structure::fft);
  const EstimatorPlan exact =
      plan_estimator(problem, pad_alpha, {.accuracy = 1e-9, .structure = Structure::dense}).plan;
  ContactEstimator estimator(plan, fft_convolutions());
  ContactEstimator reference(exact);
  std::vector<double> g = contact_readings(problem, 2);
  const std::vector<double> noise = random_values(g.size(), 3);
  for (std::size_t i = 0; i < g.size(); ++i) g[i] += 1e-2 * noise[i];
  for (int round = 0; round < 3; ++round) {
    std::vector<double> f(plan.tractions());
    std::vector<double> expected(plan.tractions());
    ContactEstimate a{.tractions = f};
    ContactEstimate b{.tractions = expected};
    REQUIRE(estimator.update(g, a) == FrameStatus::ok);
    REQUIRE(reference.update(g, b) == FrameStatus::ok);
    CHECK(relative_l2_error(f, expected) < 1e-6);
    CHECK_THAT(a.residual_rms, WithinRel(b.residual_rms, 1e-6));
    CHECK(a.outlier == b.outlier);
    if (round == 1) {  // a copy knows the dead taxel too
      estimator = ContactEstimator(estimator);
      continue;
    }
    REQUIRE(estimator.set_dead(50));
    REQUIRE(reference.set_dead(50));
    for (std::size_t i = 50; i < g.size(); i += problem.grid.count()) g[i] = std::nan("");
  }
}

TEST_CASE("bad frames are reported and leave the output alone; what is answered is finite",
          "[fft]") {
  ContactEstimator estimator(fft_plan(long_array(64), 1e-7, true).plan, fft_convolutions());
  std::vector<double> f(64, 7.0);
  const std::vector<double> untouched = f;
  ContactEstimate estimate{.tractions = f};
  std::vector<double> g = random_values(64, 1);
  g[5] = std::numeric_limits<double>::infinity();
  CHECK(estimator.update(g, estimate) == FrameStatus::not_finite);
  CHECK(estimator.update(std::span(g).first(63), estimate) == FrameStatus::wrong_size);
  g.assign(64, 1e308);
  CHECK(estimator.update(g, estimate) == FrameStatus::too_large);
  CHECK(f == untouched);
  ContactEstimator large(fft_plan(long_array(64)).plan, fft_convolutions());
  int answered = 0;
  for (int exponent = 290; exponent <= 308; ++exponent) {
    g = random_values(64, static_cast<unsigned>(exponent));
    for (double& value : g) value = std::copysign(std::pow(10.0, exponent), value);
    if (large.update(g, estimate) != FrameStatus::ok) continue;
    ++answered;
    for (const double value : f) CHECK(std::isfinite(value));
  }
  CHECK(answered > 5);
  CHECK(answered < 19);
}

TEST_CASE("a convolution much larger than its correction cannot overflow unnoticed", "[fft]") {
  EstimatorPlan plan{
      .count = 7, .channels = 2, .unknowns = 2, .values = 7, .spacing = 1.0, .alpha = 1.0};
  plan.reconstruction = small_convolution();
  for (double& value : plan.reconstruction.spectra) value *= 1e8;
  plan.weights.assign(14, 1.0);
  ContactEstimator estimator(plan, fft_convolutions());
  std::vector<double> f(14);
  ContactEstimate estimate{.tractions = f};
  int answered = 0;
  for (int exponent = 280; exponent <= 308; ++exponent) {
    const std::vector<double> g(14, std::pow(10.0, exponent));
    if (estimator.update(g, estimate) != FrameStatus::ok) continue;
    ++answered;
    for (const double value : f) CHECK(std::isfinite(value));
    CHECK(std::isfinite(estimate.normal_force));
  }
  CHECK(answered > 5);
  CHECK(answered < 21);
}

TEST_CASE("convolutions may be made in several threads", "[fft][threads]") {
  const auto work = [] {
    for (std::size_t size = 8; size <= 4000; size = transform_size(size + 1)) {
      ProductPlan plan = small_convolution();
      plan.transform_size = size;
      plan.spectra.assign(4 * (size / 2 + 1), 1.0);
      for (int i = 0; i < 5; ++i) (void)fft_convolutions()(plan);
    }
  };
  std::array<std::thread, 4> threads;
  for (std::thread& thread : threads) thread = std::thread(work);
  for (std::thread& thread : threads) thread.join();
}

TEST_CASE("copies work in threads of their own, made there, and give the same bits",
          "[fft][threads]") {
  const EstimatorPlan plan = fft_plan(long_array(128), 1e-7, true).plan;
  const FftEffort effort = GENERATE(FftEffort::estimate, FftEffort::measure);
  const ContactEstimator original(plan, fft_convolutions(effort));
  std::vector<std::vector<double>> frames;
  for (unsigned seed = 0; seed < 50; ++seed) frames.push_back(random_values(128, seed));
  std::array<std::vector<double>, 3> sums;
  const auto work = [&](std::vector<double>& sum) {
    ContactEstimator copy = original;
    ContactEstimator assigned(plan, fft_convolutions());  // planned in both threads at once
    assigned = copy;
    std::vector<double> f(128);
    ContactEstimate estimate{.tractions = f};
    for (const std::vector<double>& frame : frames) {
      (void)assigned.update(frame, estimate);
      sum.insert(sum.end(), f.begin(), f.end());
    }
  };
  std::thread first([&] { work(sums[0]); });
  std::thread second([&] { work(sums[1]); });
  first.join();
  second.join();
  work(sums[2]);
  CHECK(sums[0] == sums[2]);
  CHECK(sums[1] == sums[2]);
}
