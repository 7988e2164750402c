/// @file
/// The order in which causes are tried for a frame, whatever the fit is that finds contacts:
/// strain, sign, contacts, one taxel, constants, friction's limit. data_verdict.hpp says why.
/// Private.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "inverse/data/contact_fit.hpp"
#include "inverse/data/single_liar.hpp"

namespace tactile_net {

/// Const: threads may share one.
class FrameJudge {
 public:
  /// @param judged  kept by reference; its problem's kernel is not read
  explicit FrameJudge(const JudgedProblem& judged);

  /// @param fit     of the same problem
  /// @param memory  absent: of no frame before
  /// @throw std::invalid_argument  a size does not fit
  [[nodiscard]] DataVerdict judge(const ContactFit& fit, std::span<const double> readings,
                                  std::span<const double> tractions,
                                  KeptContacts* memory = nullptr) const;

 private:
  struct Frame;
  struct Liar {
    std::size_t taxel = 0;
    double norm = 0.0;  // of what the best contact leaves of the rest
  };

  [[nodiscard]] double strain(std::span<const double> rows,
                              std::span<const double> tractions) const;
  [[nodiscard]] bool is_turned_round(const Frame& frame, DataVerdict& verdict) const;
  void explain(const Frame& frame, KeptContacts* memory, DataVerdict& verdict) const;
  void find_cause(const Frame& frame, const Unexplained& left, DataVerdict& verdict) const;
  [[nodiscard]] bool is_odd(const Frame& frame, Unexplained& found) const;
  [[nodiscard]] std::optional<std::size_t> liar_beside(const Frame& frame,
                                                       const Unexplained& found) const;
  [[nodiscard]] std::optional<Liar> liar_against(const Frame& frame, const Unexplained& left) const;
  [[nodiscard]] std::optional<Liar> sought_liar(
      const Frame& frame, std::vector<std::size_t>& taxels,
      const std::function<std::optional<Unexplained>(std::size_t, double)>& rest_of) const;
  [[nodiscard]] bool explains(double rest, double taken, double gain,
                              const Unexplained& left) const;

  const JudgedProblem& p_;
  std::vector<double> readings_of_;  // each taxel's that count
  SingleLiar liars_;
  double to_rms_;  // makes a residual's norm the rms of a weighted reading
};

}  // namespace tactile_net
