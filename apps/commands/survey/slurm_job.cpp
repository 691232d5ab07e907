#include "apps/commands/survey/slurm_job.h"

#include <algorithm>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "apps/commands/survey/local_processes.h"
#include "apps/options/command.h"
#include "apps/options/refusals.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/shown_text.h"

namespace vegard::apps {
namespace {

constexpr const char* kScriptName = "/survey.sbatch";
constexpr const char* kJobName = "/survey.job";
constexpr const char* kMark = "# Written by vegard survey submit";

/// By which Slurm's queue tells the job of a folder, an absolute name, from all others.
std::string comment_of(const std::string& folder) {
  constexpr std::size_t kDigits = 16;
  return "vegard-" + sim::sha256(folder).substr(0, kDigits);
}

/// Slurm reads these lines itself, without a shell: quotes keep blanks, and % begins its own words.
std::string for_directive(const std::string& key, const std::string& word) {
  if (word.find_first_of("\"\n\r\\") != std::string::npos)
    throw usage_error(
        key, "'" + word + "' has a quote, a backslash or a line's end in it, which sbatch cannot read",
        "another name");
  std::string text;
  for (const char c : word) text += c == '%' ? std::string("%%") : std::string(1, c);
  return text;
}

bool is_number(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

sim::Error slurm_error(const std::string& program, const ProgramEnd& end) {
  constexpr int kNoProgram = 127;
  if (end.exit_code == kNoProgram)
    return usage_error(program, "there is no such program on this machine", "Slurm",
                       "--dry-run shows the script, and vegard survey run --local needs no cluster");
  std::string words = end.words;
  words.erase(words.find_last_not_of(" \n") + 1);
  std::replace(words.begin(), words.end(), '\n', ' ');
  return usage_error(program, "ended with exit code " + std::to_string(end.exit_code) + ": " + words, "", "");
}

/// A file of ours may be replaced, any other not.
void write_own(const std::string& file, const std::string& text) {
  const std::string old = sim::read_input(file).bytes;
  if (!old.empty() && old.find(kMark) == std::string::npos)
    throw sim::Error(sim::ErrorKind::existing_output, "is in the way, and none that vegard wrote")
        .file(file)
        .hint("move it away");
  sim::write_whole(file, text, true);
}

/// What the folder's job is called: its number, or its comment as long as that is all that is known.
void note_job(const std::string& folder, const std::string& job) {
  write_own(folder + kJobName, std::string(kMark) + ": the job of the shards in this folder\n" + job + "\n");
}

/// Its number, if it is one of ours in the queue.
std::string job_with_comment(const std::string& comment) {
  if (comment.empty()) return "";
  const ProgramEnd end = run_program({"squeue", "--noheader", "--me", "--format", "%F %k"});
  if (end.exit_code != 0) throw slurm_error("squeue", end);
  std::istringstream lines(end.words);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string job, of_job;
    words >> job >> of_job;
    if (of_job == comment && is_number(job)) return job;
  }
  return "";
}

}  // namespace

std::string task_ranges(const std::vector<int>& tasks) {
  std::string text;
  for (std::size_t i = 0; i < tasks.size();) {
    std::size_t last = i;
    while (last + 1 < tasks.size() && tasks[last + 1] == tasks[last] + 1) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(tasks[i]);
    if (last > i) text += "-" + std::to_string(tasks[last]);
    i = last + 1;
  }
  return text;
}

std::string slurm_script(const SlurmScript& s) {
  std::string text = "#!/bin/bash\n";
  text += std::string(kMark) + ": each task is a shard, and goes on where it was if it is begun again.\n";
  text += "#SBATCH --job-name=vegard-" + s.name + "\n";
  text += "#SBATCH --array=" + task_ranges(s.tasks) + (s.at_once > 0 ? "%" + std::to_string(s.at_once) : "") +
          "\n";
  text += "#SBATCH --comment=" + comment_of(s.folder) + "\n";
  text += "#SBATCH --requeue\n#SBATCH --open-mode=append\n";
  text += "#SBATCH --output=\"" + for_directive("--out", s.folder) + "/log/shard-%a.txt\"\n";
  text += "#SBATCH --cpus-per-task=" + std::to_string(s.threads) + "\n";
  text += "#SBATCH --time=" + std::to_string(s.minutes) + "\n";
  for (const std::string& option : s.more) {
    if (option.rfind("--", 0) != 0 || option.find_first_of("\n\r") != std::string::npos)
      throw usage_error("--sbatch", "'" + option + "' is no option of sbatch", "--sbatch=--partition=long");
    text += "#SBATCH " + option + "\n";
  }
  text += "exec " + sim::in_shell_quotes(s.program) + " survey run " + sim::in_shell_quotes(s.plan) +
          " --out " + sim::in_shell_quotes(s.folder) + " --shard \"$SLURM_ARRAY_TASK_ID/" +
          std::to_string(s.shards) + "\" --threads " + std::to_string(s.threads) + "\n";
  return text;
}

std::string job_of_folder(const std::string& folder) {
  std::istringstream lines(sim::read_input(folder + kJobName).bytes);
  std::string mark, job;
  std::getline(lines, mark);
  std::getline(lines, job);
  if (mark.rfind(kMark, 0) != 0) return "";
  if (is_number(job)) return job;
  // Whoever handed it over was killed before its number was known.
  const std::string found = job_with_comment(job);
  if (!found.empty()) note_job(folder, found);
  return found;
}

std::string submit_to_slurm(const std::string& folder, const std::string& script) {
  write_own(folder + kScriptName, script);
  // Before Slurm has it: what is killed meanwhile leaves a job that can be found.
  note_job(folder, comment_of(folder));
  const ProgramEnd end = run_program({"sbatch", "--parsable", folder + kScriptName});
  // "123" or "123;cluster", the last line: warnings may stand before it.
  std::istringstream lines(end.words);
  std::string job;
  for (std::string line; std::getline(lines, line);)
    if (is_number(line.substr(0, line.find(';')))) job = line.substr(0, line.find(';'));
  // The note stays: Slurm may have taken the job all the same, and then it is found by its comment.
  if (end.exit_code != 0 || job.empty()) throw slurm_error("sbatch", end);
  note_job(folder, job);
  return job;
}

std::string state_of_job(const std::string& job) {
  const ProgramEnd end = run_program({"squeue", "--noheader", "--array", "--jobs", job, "--format", "%T"});
  // A job that has left the queue for long is not known any more.
  if (end.exit_code != 0 && end.words.find("Invalid job id") == std::string::npos)
    throw slurm_error("squeue", end);
  std::map<std::string, int> counts;
  if (end.exit_code == 0) {
    std::istringstream lines(end.words);
    for (std::string line; std::getline(lines, line);) {
      std::transform(line.begin(), line.end(), line.begin(),
                     [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
      if (!line.empty()) ++counts[line];
    }
  }
  std::string text;
  for (const auto& [state, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, state);
  return text;
}

void cancel_job(const std::string& job) {
  const ProgramEnd end = run_program({"scancel", job});
  if (end.exit_code != 0) throw slurm_error("scancel", end);
}

}  // namespace vegard::apps
