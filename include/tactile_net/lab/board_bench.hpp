/// @file
/// A scene's circuit, built, on the bench.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/network/board_bench.hpp"

namespace tactile_net::lab {

enum class BenchVerdict { healthy, faulty, not_told_apart, not_explained };

}  // namespace tactile_net::lab

namespace tactile_net {

template <>
struct Enumerators<lab::BenchVerdict> {
  using One = lab::BenchVerdict;
  static constexpr Enumerator<One> all[] = {
      {One::healthy, "healthy", "Tolerances and noise explain the responses."},
      {One::faulty, "faulty", "One fault explains them, and is named."},
      {One::not_told_apart, "not_told_apart", "Several single faults explain them alike."},
      {One::not_explained, "not_explained",
       "No single fault explains them: several faults, another circuit, or another noise."}};
};

}  // namespace tactile_net

namespace tactile_net::lab {

struct BoardBench {
  std::vector<std::string> inputs{}, outputs{}, parts{};  ///< their names
  std::size_t patterns = 0;
  double noise = 0.0;  ///< standard deviation of a voltage that was assumed [V]
  BoardDiagnosis diagnosis{};
  SelfTest self_test{};

  [[nodiscard]] BenchVerdict verdict() const noexcept;
};

/// The scene's circuit as a bench knows it: errors of parts within the scene's tolerances, 1 %
/// where it gives none.
///
/// @throw std::invalid_argument  it is not made of resistors and fully differential amplifiers
[[nodiscard]] BoardModel board_model(const SceneCircuit& circuit);

/// @throw std::invalid_argument, std::domain_error  as `board_model` and `BoardModel::diagnose`
[[nodiscard]] BoardBench bench(const SceneCircuit& circuit, const BoardResponses& responses,
                               Observer& observer = silent);

/// "open:Rk3_4p", "ten_times:Rs1_2n", "swapped:Rk1_2p/Rt0_3n": what is planted.
///
/// @throw std::invalid_argument  there is no such fault or part
[[nodiscard]] BoardFault planted_fault(const Reduction& reduction, std::string_view text);

struct PlantedBoard {
  std::vector<BoardFault> faults{};
  int bits = 12;  ///< of the converter, 4 to 24
  std::uint64_t seed = 1;
};

/// What a bench would measure of a board of the scene's tolerances, its op-amps as the scene has
/// them: each input by itself, the largest output at 0.9 of the converter's range.
[[nodiscard]] BoardResponses simulated_board(const SceneCircuit& circuit,
                                             const PlantedBoard& planted);

}  // namespace tactile_net::lab
