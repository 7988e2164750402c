/// @file
/// A sweep on a cluster: one job array of Slurm, a task a shard.
#pragma once

#include <cstddef>
#include <string>

namespace tactile_net::sweep {

struct SlurmJob {
  std::string study{};           ///< path of the study, as its tasks find it
  std::string folder{};          ///< where every task finds the same one
  std::size_t tasks = 1;         ///< shards
  std::string time = "1:00:00";  ///< of a task, as Slurm takes it: minutes, or D-HH:MM:SS
  std::string program = "tactile-net";
};

/// A job file: `sbatch FILE` runs it, `sbatch --array=3,7 FILE` some of its tasks again.
///
/// @throw std::invalid_argument  tasks is 0; the time is none
[[nodiscard]] std::string slurm_script(const SlurmJob& job);

}  // namespace tactile_net::sweep
