/// @file
/// Private. The families of arithmetic, one file each; an exception fails the whole family.
#pragma once

#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/study/study.hpp"

namespace tactile_net::study {

/// Planned products with M: dense, by classes, of low rank, by FFT; in double and in single.
[[nodiscard]] StudySection products(const StudyInput& input, const lab::Clock& clock);

// Of lines.

/// The closed form, and a QR of every frame.
[[nodiscard]] StudySection factorisations(const StudyInput& input, const lab::Clock& clock);

/// Filters and iterations by FFT.
[[nodiscard]] StudySection by_fft(const StudyInput& input, const lab::Clock& clock);

/// Tractions under constraints, the search stopped after more and more exchanges.
[[nodiscard]] StudySection constrained(const StudyInput& input, const lab::Clock& clock);

/// The same aperture with fewer taxels: every second, third, ... of them.
[[nodiscard]] StudySection fewer_taxels(const StudyInput& input, const lab::Clock& clock);

/// The same readings on coarser grids: steps of twice, four times, ... the scene's.
[[nodiscard]] StudySection coarser_surface(const StudyInput& input, const lab::Clock& clock);
/// Whether there is one: tractions on a grid whose steps can be doubled.
[[nodiscard]] bool has_coarser_surface(const Scene& scene);

/// What the integral's accuracy costs, and what the discrete sum makes of it.
[[nodiscard]] StudySection forward_models(const StudyInput& input, const lab::Clock& clock);

// Of skins.

/// The decomposition that every alpha shares, and a QR of every frame.
[[nodiscard]] StudySection skin_factorisations(const StudyInput& input, const lab::Clock& clock);

/// Sums of more and more Kronecker products.
[[nodiscard]] StudySection kronecker_sums(const StudyInput& input, const lab::Clock& clock);

/// Conjugate gradients stopped after more and more steps, by FFT and with the matrix.
[[nodiscard]] StudySection skin_gradients(const StudyInput& input, const lab::Clock& clock);

/// Tractions under constraints, the iteration stopped after more and more steps.
[[nodiscard]] StudySection skin_constrained(const StudyInput& input, const lab::Clock& clock);

/// The same readings on fewer cells a taxel.
[[nodiscard]] StudySection coarser_cells(const StudyInput& input, const lab::Clock& clock);
/// Whether there are fewer: cells narrower than the pitch.
[[nodiscard]] bool has_coarser_cells(const lab::SkinSceneProblem& skin);

/// A frame's time on arrays of the same taxels, fewer and more. @pre  the skin is even
[[nodiscard]] StudySection array_sizes(const StudyInput& input, const lab::Clock& clock);

}  // namespace tactile_net::study
