#include "tactile_net/report/words/confinement_words.hpp"

namespace tactile_net::report {

std::string in_words(const Confinement& confinement) {
  const std::string files = confinement.files
                                ? "writes in its private folder alone (landlock)"
                                : "could write wherever you can (this kernel has no landlock)";
  const std::string processes =
      confinement.processes
          ? "starts no other program and opens no connection (seccomp)"
          : "could start other programs (this kernel or processor has no seccomp filter)";
  return "ngspice runs confined as far as this machine can: it " + files + ", and " + processes +
         ".";
}

}  // namespace tactile_net::report
