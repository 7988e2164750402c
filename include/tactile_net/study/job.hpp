/// @file
/// The jobs of a study: one per family of methods, one per circuit.
#pragma once

#include <optional>

#include "tactile_net/network/realization.hpp"

namespace tactile_net::study {

struct Job {
  enum class Kind {
    products,          ///< planned products with M
    factorisations,    ///< the closed form, a QR of every frame
    fft,               ///< filters and iterations by FFT
    constraints,       ///< the active set
    fewer_taxels,      ///< coarser arrays of the same aperture
    coarser_surface,   ///< fewer tractions from the same readings
    kronecker,         ///< of skins: sums of Kronecker products
    gradients,         ///< of skins: conjugate gradients, by FFT and with the matrix
    array_sizes,       ///< of skins: what a frame takes on arrays of other sizes
    forward_model,     ///< readings of known tractions
    settling,          ///< the step response of a circuit of `realization`
    circuit_sizes,     ///< of skins: how circuits of arrays of other sizes settle
    parts,             ///< what inaccurate components do to each circuit
    moving,            ///< how circuits and loops follow contacts that move
    operating_points,  ///< what the simulator takes for one frame
  };
  Kind kind = Kind::products;
  std::optional<Realization> realization{};

  bool operator==(const Job&) const = default;
};

}  // namespace tactile_net::study
