/// @file
/// A sweep on a cluster: one job array of Slurm, a task a shard.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tactile_net::sweep {

struct SlurmJob {
  std::string study{};           ///< path of the study, as its tasks find it
  std::string folder{};          ///< where every task finds the same one
  std::size_t tasks = 1;         ///< shards
  std::string time = "1:00:00";  ///< of a task, as Slurm takes it: minutes, or D-HH:MM:SS
  std::string program = "tactile-net";
  std::size_t jobs = 1;                ///< points of a task at once, on a processor each
  std::vector<std::string> options{};  ///< further words for the program, of every task
};

/// A job file: `sbatch FILE` runs it, `sbatch --array=3,7 FILE` some of its tasks again.
///
/// @throw std::invalid_argument  tasks or jobs is 0; the time is none
[[nodiscard]] std::string slurm_script(const SlurmJob& job);

}  // namespace tactile_net::sweep
