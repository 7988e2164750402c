/// @file
/// Scenes as the command reads them, and what it answers.
///
///     const Scene scene = read_scene("scenes/thesis/cylinder.toml");
///     Ngspice ngspice;
///     const lab::Experiment experiment = lab::run(scene, ngspice);
///     report::print_experiment(std::cout, experiment);
#pragma once

#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/simulator/ngspice.hpp"
