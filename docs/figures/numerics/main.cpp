// Writes docs/internals/numerics.md: what every method makes of every hard case, beside 50 digits.
#include <charconv>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "coverage_table.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tests/hard/outcomes.hpp"

namespace {

using namespace tactile_net::hard;

constexpr const char* introduction = R"(# The hard cases, one by one

What they mean for a user: [numerics.md](../numerics.md). Written by `tactile-net-numerics docs/internals/numerics.md` (target
`tactile_net_numerics`) from the cases of `tests/hard`, which the test suite runs too: no number here is typed in.

Every method solves one of two systems.

- **P f = b**, the minimiser of |W (K f - g)|^2 + alpha (|f|^2 + l^2/D^2 sum of squared differences), with an array that
  ends where it ends: `tikhonov` (its matrix, its direct solve, and its family for all alpha at once), `closed_form`, and
  conjugate gradients, which multiply by FFT and are used from 1024 tractions on. P is never formed to solve: all work on
  the stacked matrix [W K; sqrt(alpha) L], whose condition number is the root of P's.
- **The circular system**, an array closed to a ring: `dft`, plain or regularised. It is a different problem, and up to
  its own size away from the first where a contact touches the end; here it is compared with itself.

*error* is |f - f*| / |f*| with f* in 50 digits by another way (kernels from complex potentials or from a layer's boundary
conditions, the minimiser from the normal equations). *bound* is what the library itself says for that frame: the
first-order bound of least squares (Wedin 1973) with the error of the kernel's entries and of the factorisation as the
perturbation. It holds rounding, not what alpha smooths away nor what noise adds: those are the bands of `run` and
`solve --uncertainty`. *kappa* is the condition number of the system solved. For each system the method with the largest
error over its bound is shown, with how many methods there are; `all` at the end of a row: every one of them stays within
its bound.

A half plane's kernels are known to some ulp, a layer's to 1e-13 of the half plane's peak, which is why bounds of layers
are larger than their errors.
)";

std::string number(double value) {
  if (value == 0.0) return "0";
  char text[32];
  return {text,
          std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 0).ptr};
}

bool circular(const Outcome& outcome) { return outcome.method.substr(0, 3) == "dft"; }

struct Refusal {
  std::string name, method, words;
};

/// One row per system: the worst of its methods.
void add_rows(std::ostream& out, const std::string& name, const std::vector<Outcome>& outcomes,
              std::vector<Refusal>& refusals) {
  for (const bool ring : {false, true}) {
    const Outcome* worst = nullptr;
    int methods = 0;
    bool all = true;
    for (const Outcome& outcome : outcomes) {
      if (circular(outcome) != ring) continue;
      if (!outcome.answered) {
        refusals.push_back({name, outcome.method, outcome.verdict});
        continue;
      }
      ++methods;
      all = all && outcome.finite && outcome.error <= outcome.bound;
      const auto share = [](const Outcome& o) { return o.bound > 0.0 ? o.error / o.bound : 0.0; };
      if (worst == nullptr || share(outcome) > share(*worst)) worst = &outcome;
    }
    if (worst == nullptr) continue;
    out << "| " << name << " | " << (ring ? "ring" : "P f = b") << " | " << worst->method << " of "
        << methods << " | " << number(worst->condition) << " | " << number(worst->error) << " | "
        << number(worst->bound) << " | "
        << (worst->bound >= 1.0 && worst->verdict == "ok" ? "no digit" : worst->verdict) << " | "
        << (all ? "all" : "**NOT ALL**") << " |\n";
  }
}

std::string page() {
  std::ostringstream out;
  std::vector<Refusal> refusals;
  out << introduction
      << "\n| case | system | worst method | kappa | error | bound | verdict | within |\n"
         "|---|---|---|---|---|---|---|---|\n";
  for (const Case& hard_case : cases()) {
    std::cerr << hard_case.name << '\n';
    add_rows(out, hard_case.name, outcomes(hard_case), refusals);
  }
  for (const Case& hard_case : large_cases()) {
    std::cerr << hard_case.name << '\n';
    add_rows(out, hard_case.name, large_outcomes(hard_case), refusals);
  }
  out << "\n`no digit`: the bound itself says that nothing is left. `not_converged`: conjugate "
         "gradients stopped early and say so; smaller arrays do not "
         "use them. `null_mode`: a\ncombination of tractions that no reading shows is set to zero "
         "and named. `cut_off`: the readings have not died away\nwhere the ring closes.\n";
  out << "\n## What double precision cannot deliver\n\nThese were refused with the reason, "
         "instead of an answer:\n\n";
  for (const Refusal& refusal : refusals)
    out << "- " << refusal.name << ", " << refusal.method << ": " << refusal.words << '\n';
  out << coverage_section() << constrained_coverage_section();
  return out.str();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: tactile-net-numerics FILE.md\n";
    return 2;
  }
  try {
    tactile_net::frames::write_file(argv[1], page());
  } catch (const std::exception& error) {
    std::cerr << "tactile-net-numerics: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
