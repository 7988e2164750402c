// One frame of a plan: frame write PLAN NUMBERS | frame compare PLAN NUMBERS. Compiled without
// exceptions too, with -ffast-math, and for another processor, whose numbers may differ in the last
// digits alone.
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <tactile_net/realtime/contact_estimator.hpp>
#include <tactile_net/realtime/plan_file.hpp>
#include <vector>

using namespace tactile_net;

namespace {

std::vector<std::byte> bytes_of(const char* path) {
  std::vector<std::byte> bytes;
  std::FILE* file = std::fopen(path, "rb");
  if (file == nullptr) return bytes;
  std::byte block[4096];
  while (const std::size_t size = std::fread(block, 1, sizeof block, file))
    bytes.insert(bytes.end(), block, block + size);
  std::fclose(file);
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const EstimatorPlan plan = decode_plan(bytes_of(argv[2]));
  ContactEstimator estimator(plan);
  std::vector<double> readings(plan.readings());
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double y = static_cast<double>(i % plan.count) / static_cast<double>(plan.count) - 0.4;
    readings[i] = 1.0 / (1.0 + 40.0 * y * y);
  }
  std::vector<double> numbers(plan.tractions());
  ContactEstimate contact;
  contact.tractions = numbers;
  // NaN and the infinities, by their bits: a compiler told that there are none may leave them out.
  constexpr std::uint64_t no_numbers[] = {0x7FF8000000000000, 0x7FF0000000000000,
                                          0xFFF0000000000000};
  for (const std::uint64_t bits : no_numbers) {
    std::vector<double> broken = readings;
    broken[1] = std::bit_cast<double>(bits);
    if (estimator.update(broken, contact) != FrameStatus::not_finite) return 6;
    if (estimator.set_baseline(broken) != FrameStatus::not_finite) return 7;
  }
  if (estimator.update(readings, contact) != FrameStatus::ok) return 3;
  double largest = 0.0;
  for (const double traction : numbers) largest = std::fmax(largest, std::fabs(traction));
  numbers.push_back(contact.normal_force);
  numbers.push_back(contact.centre);

  const bool write = std::strcmp(argv[1], "write") == 0;
  std::FILE* file = std::fopen(argv[3], write ? "wb" : "rb");
  if (file == nullptr || !(largest > 0.0)) return 4;
  double worst = 0.0;
  for (const double number : numbers) {
    double expected = 0.0;
    if (write)
      std::fprintf(file, "%.17g\n", number);
    else if (std::fscanf(file, "%lf", &expected) != 1)
      return 5;
    else
      worst = std::fmax(worst, std::fabs(number - expected));
  }
  std::fclose(file);
  std::printf("%zu numbers, largest %g, difference %g\n", numbers.size(), largest, worst);
  return worst <= 1e-12 * largest ? 0 : 1;
}
