// libFuzzer: any bytes are a plan or a runtime_error; what is a plan is written again as the same
// bytes, of an older version as such bytes of the newest, and its estimator is made in memory of
// the plan's order and answers frames without fault.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tests/realtime/older_plan_bytes.hpp"
#include "tests/realtime/plan_bytes.hpp"
#include "tests/realtime/plans.hpp"
#include "tests/realtime/skin_plans.hpp"

using namespace tactile_net;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

/// Stands in for the FFT, which is not in this library: adds the first spectral value times x.
class Direct : public Convolution {
 public:
  explicit Direct(const ProductPlan& plan)
      : factor_(plan.spectra[0]), size_(std::min(plan.rows, plan.columns)) {}
  void add(const double* x, double* y) noexcept override {
    for (std::size_t i = 0; i < size_; ++i) y[i] += factor_ * x[i];
  }
  [[nodiscard]] std::unique_ptr<Convolution> clone() const override {
    return std::make_unique<Direct>(*this);
  }

 private:
  double factor_;
  std::size_t size_;
};

constexpr std::size_t header = 20;
constexpr std::size_t checksum = 8;
constexpr Structure structures[] = {Structure::dense, Structure::low_rank, Structure::reflections,
                                    Structure::reflections_low_rank};

void require(bool holds, const char* rule) {
  if (holds) return;
  std::fprintf(stderr, "violated: %s\n", rule);
  std::abort();
}

/// What is answered with `ok` is finite, however odd the plan.
void run_frames(const EstimatorPlan& plan, InstructionSet set) {
  ContactEstimator estimator(
      plan, [](const ProductPlan& product) { return std::make_unique<Direct>(product); }, set);
  std::vector<double> readings(estimator.readings());
  std::vector<double> tractions(estimator.tractions());
  ContactEstimate estimate{.tractions = tractions};
  for (const double size : {0.0, 1.0, 1e-310, 1e30, 1e150, 1e300}) {
    for (std::size_t i = 0; i < readings.size(); ++i)
      readings[i] = size * (static_cast<double>((i * 7 + 3) % 11) - 5.0);
    for (const bool dead : {false, true}) {
      if (dead && !estimator.set_dead(plan.count / 2)) break;
      if (estimator.update(readings, estimate) != FrameStatus::ok) continue;
      require(std::all_of(tractions.begin(), tractions.end(),
                          [](double f) { return std::isfinite(f); }),
              "finite tractions");
      require(std::isfinite(estimate.normal_force), "a finite force");
      require(plan.unknowns != 3 || std::isfinite(estimate.tangential_force), "finite drags");
      require(estimate.touching <= plan.values, "cells that touch");
      require(!plan.prediction || std::isfinite(estimate.residual_rms), "a finite residual");
      require(estimate.outlier < static_cast<std::ptrdiff_t>(readings.size()),
              "an outlier's index");
    }
    estimator.revive();
  }
}

/// Puts one size in place of another wherever it stands twice: factors share the rank between them,
/// grids a length, and one alone would only contradict the other.
void change_two_sizes(std::uint8_t* payload, std::size_t size, std::minstd_rand& random) {
  constexpr std::size_t width = sizeof(std::uint64_t);
  if (size < 2 * width) return;
  const auto number_at = [&](std::size_t at) {
    std::uint64_t number = 0;  // little-endian, as the machines that fuzz
    std::memcpy(&number, payload + at, width);
    return number;
  };
  const std::size_t first = random() % (size - width + 1);
  if (number_at(first) > 64) return;
  std::vector<std::size_t> others;
  for (std::size_t at = 0; at + width <= size; ++at)
    if ((at >= first + width || first >= at + width) && number_at(at) == number_at(first))
      others.push_back(at);
  if (others.empty()) return;
  const std::uint64_t number = std::uint64_t{1} << random() % 64;
  for (const std::size_t at : {first, others[random() % others.size()]})
    std::memcpy(payload + at, &number, width);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  EstimatorPlan plan;
  try {
    plan = decode_plan(bytes);
  } catch (const std::runtime_error&) {
    return 0;
  }
  const std::vector<std::byte> again = encode_plan(plan);
  if (bytes[8] == static_cast<std::byte>(newest_plan_version))
    require(std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()), "the same bytes");
  else
    require(encode_plan(decode_plan(again)) == again, "the same bytes when read again");
  run_frames(plan, InstructionSet::baseline);
  run_frames(plan, widest_instruction_set());
  return 0;
}

/// Plans to start from; mutations of the payload, signed anew so that its decoder is reached; now
/// and then of anything else.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  std::minstd_rand random(seed + 1);
  if (size <= header + checksum || random() % 64 == 0) {
    PlanShape shape{.count = 2 + random() % 4, .channels = 1 + random() % 2};
    shape.unknowns = 1 + random() % 2;
    shape.structure = structures[random() % 4];
    shape.precision = static_cast<Precision>(random() % 2);
    shape.diagnostics = random() % 2 == 0;
    EstimatorPlan plan = made_plan(shape, seed);
    if (random() % 4 == 0) {
      shape.structure = Structure::reflections_low_rank;
      shape.precision = Precision::float64;
      plan = made_plan(shape, seed);
      ProductPlan& product = plan.reconstruction;
      product.structure = Structure::fft;
      product.scale = 1.0;
      product.transform_size = 8;
      product.spectra.assign(shape.unknowns * shape.channels * 5, 0.5);
    }
    if (random() % 2 == 0) {
      const std::size_t rows = 1 + random() % 3;
      const bool exchanged = random() % 2 == 0;
      plan = made_skin_plan({.rows = rows,
                             .columns = exchanged ? rows : 1 + random() % 3,
                             .margin = random() % 2,
                             .unknowns = random() % 2 == 0 ? 1U : 3U,
                             .structure = random() % 2 == 0 ? Structure::reflections
                                                            : Structure::reflections_low_rank,
                             .precision = static_cast<Precision>(random() % 2),
                             .exchanged = exchanged,
                             .diagnostics = random() % 2 == 0,
                             .dead = rows > 1 ? random() % 2 : 0},
                            seed);
      if (random() % 2 == 0) plan.cells->deviations.assign(plan.values, 0.5);
      plan.cells->rim_rows = random() % 3;
    }
    const std::vector<std::byte> bytes =
        !plan.cells && random() % 2 == 0 ? older_bytes(plan, 1) : encode_plan(plan);
    if (bytes.size() <= most) {
      std::memcpy(data, bytes.data(), bytes.size());
      return bytes.size();
    }
  }
  if (size <= header + checksum || random() % 16 == 0) return LLVMFuzzerMutate(data, size, most);
  std::size_t payload = size - header - checksum;
  if (random() % 4 == 0)
    change_two_sizes(data + header, payload, random);
  else
    payload = LLVMFuzzerMutate(data + header, payload, most - header - checksum);
  const std::size_t length = header + payload + checksum;
  sign(std::as_writable_bytes(std::span(data, length)));
  return length;
}
