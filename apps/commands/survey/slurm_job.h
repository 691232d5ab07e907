// A survey as an array of tasks of a cluster that has Slurm: the script, and the job that was made of it.
#pragma once

#include <string>
#include <vector>

namespace vegard::apps {

/// What the script is to have in it. Names of files are absolute.
struct SlurmScript {
  std::string program, plan, folder, name;
  std::vector<int> tasks;         ///< shards that are not finished yet, in their order
  int shards = 1;                 ///< that there are
  int threads = 1;                ///< of a task
  int at_once = 0;                ///< tasks; 0: as many as the cluster likes
  int minutes = 30;               ///< that a task may take
  std::vector<std::string> more;  ///< options of sbatch, as they are: "--partition=long"
};

/// "1-3,7": of increasing numbers.
std::string task_ranges(const std::vector<int>& tasks);

/// The same gives the same text. Throws Error(usage) for what cannot stand in a line of sbatch's.
std::string slurm_script(const SlurmScript& script);

/// The job that a folder's shards were last handed to; empty if there is none. Where whoever handed them over
/// was killed before Slurm gave the number, the queue is asked for it. Throws Error(usage) if it cannot be.
std::string job_of_folder(const std::string& folder);

/// Hands the script to Slurm, and notes the job in the folder, an absolute name, before and after. The job's
/// number. Throws Error(usage) with Slurm's words if it will not take it.
std::string submit_to_slurm(const std::string& folder, const std::string& script);

/// How many tasks of the job are in which state, "2 running, 5 pending"; empty once it has left the queue.
std::string state_of_job(const std::string& job);

/// Throws Error(usage) with Slurm's words.
void cancel_job(const std::string& job);

}  // namespace vegard::apps
