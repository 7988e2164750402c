/// @file
/// The structures and precisions of planned products, told. Private.
#pragma once

#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/realtime/product_plan.hpp"

namespace tactile_net {

template <>
struct Enumerators<Structure> {
  static constexpr Enumerator<Structure> all[] = {
      {Structure::dense, name(Structure::dense), "One matrix."},
      {Structure::low_rank, name(Structure::low_rank), "Two factors of low rank."},
      {Structure::fft, name(Structure::fft),
       "A circulant, by FFT, and a correction of its ends; of lines."},
      {Structure::reflections, name(Structure::reflections),
       "A matrix for each class of patterns that the array's mirror images keep or negate."},
      {Structure::reflections_low_rank, name(Structure::reflections_low_rank),
       "Two factors of low rank for each such class."}};
};

template <>
struct Enumerators<Precision> {
  static constexpr Enumerator<Precision> all[] = {
      {Precision::float64, name(Precision::float64), "Numbers of 64 bits."},
      {Precision::float32, name(Precision::float32), "Numbers of 32 bits."}};
};

}  // namespace tactile_net
