/// @file
/// A scene that names every table, to be changed one place at a time.
#pragma once

#include <string_view>

inline constexpr std::string_view good_scene = R"([sensor]
count = 5
pitch = 0.5
depth = 1.5
reads = ["strain_x"]

[material]
youngs_modulus = 1.0
poisson_ratio = 0.45

[[contact]]
shape = "punch"
half_width = 1.0
force = 1.0
edge = 0.1

[noise]
rms = 1e-4
seed = 3

[quantization]
bits = 12
range = [-1.0, 1.0]

[dead_taxels]
indices = [1]

[forward]
model = "exact"

[reconstruct]
methods = ["dft", "tikhonov"]
alpha = 1e-3

[network]
realization = "ideal"
)";
