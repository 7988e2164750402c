/// @file
/// report.html of `certify`.
#pragma once

#include <optional>

#include "figure.hpp"
#include "relaxation.hpp"

namespace tactile_net::tool {

/// What `certify` found of a scene's circuit.
struct Certification {
  Scene scene;
  CircuitPlan plan;
  Certificate certificate{};
  std::optional<ToleranceResult> tolerance{};
  Recommendation recommendation{};

  /// Whether there is an answer for the circuit to settle to.
  [[nodiscard]] bool loaded() const noexcept;
};

/// What the draws say, and where the certificate's poles contradict it. @pre  there are draws
[[nodiscard]] std::vector<std::string> tolerance_in_words(const Certification& certification);

[[nodiscard]] Report certificate_html(const Certification& certification);

}  // namespace tactile_net::tool
