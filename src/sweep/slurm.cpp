#include "tactile_net/sweep/slurm.hpp"

#include <filesystem>
#include <stdexcept>

#include "tactile_net/numeric/text.hpp"

namespace tactile_net::sweep {

std::string slurm_script(const SlurmJob& job) {
  if (job.tasks < 1 || job.tasks > 100'000)
    throw std::invalid_argument("a job array has from 1 to 100000 tasks (got " +
                                std::to_string(job.tasks) + ')');
  if (job.jobs < 1) throw std::invalid_argument("a task computes at least 1 point at once");
  if (job.time.empty() || job.time.find_first_not_of("0123456789:-") != job.time.npos)
    throw std::invalid_argument(
        "'" + job.time + "' is not a time of Slurm's: minutes as 90, or 1:30:00, or 2-12:00:00");
  const std::string tasks = std::to_string(job.tasks);
  const std::string jobs = std::to_string(job.jobs);
  std::string options;
  for (const std::string& word : job.options) options += ' ' + shell_word(word);
  const std::string shown = std::filesystem::path(job.study).stem().string();
  // The count stands in the script: of an array of which some tasks are run again, Slurm's own
  // count is that of these.
  return "#!/bin/sh\n"
         "# One task a shard. To run some again: sbatch --array=3,7 THIS_FILE\n"
         "#SBATCH --job-name=" +
         shell_word(shown) + "\n#SBATCH --array=1-" + tasks + "\n#SBATCH --time=" + job.time +
         "\n#SBATCH --cpus-per-task=" + jobs +
         "\n"
         "exec " +
         shell_word(job.program) + " sweep " + shell_word(job.study) + " --out " +
         shell_word(job.folder) + " --shard \"$SLURM_ARRAY_TASK_ID/" + tasks +
         "\" --jobs \"${SLURM_CPUS_PER_TASK:-" + jobs + "}\"" + options + "\n";
}

}  // namespace tactile_net::sweep
