// Runs a survey as an array of tasks on a cluster with Slurm: the script, and its job.
#pragma once

#include <string>
#include <vector>

namespace vegard::apps {

/// The contents of the script. Names of files are absolute.
struct SlurmScript {
  std::string program, plan, folder, name;
  std::vector<int> tasks;         ///< shards that are not finished yet, in their order
  int shards = 1;                 ///< number of all shards
  int threads = 1;                ///< per task
  int at_once = 0;                ///< largest number of simultaneous tasks; 0: decided by the cluster
  int minutes = 30;               ///< time limit of a task
  std::vector<std::string> more;  ///< further options of sbatch, unchanged: "--partition=long"
};

/// Increasing numbers as ranges: "1-3,7".
std::string task_ranges(const std::vector<int>& tasks);

/// Returns the script's text, which depends on nothing else. Throws Error(usage) for text that cannot stand
/// in a line for sbatch.
std::string slurm_script(const SlurmScript& script);

/// The job to which a folder's shards were last submitted; empty if there is none. If the submitting process
/// was killed before Slurm returned the number, the queue is asked for it. Throws Error(usage) if this fails.
std::string job_of_folder(const std::string& folder);

/// Submits the script to Slurm, and records the job in the folder, an absolute name, before and afterwards.
/// Returns the job's number. Throws Error(usage) with Slurm's message if it is refused.
std::string submit_to_slurm(const std::string& folder, const std::string& script);

/// The number of the job's tasks in each state, "2 running, 5 pending"; empty once the job has left the
/// queue.
std::string state_of_job(const std::string& job);

/// Cancels the job. Throws Error(usage) with Slurm's message if this fails.
void cancel_job(const std::string& job);

}  // namespace vegard::apps
