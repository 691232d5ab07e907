// The commands that a studio runs: each is this program once more, with the words that the page shows.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace vegard::apps {

/// What a command has said and how it ended.
struct StudioJobState {
  std::vector<std::string> words;
  std::string said;     ///< both streams as they came, from the position that was asked for
  std::string output;   ///< standard output alone, once the command has ended
  std::size_t end = 0;  ///< position behind `said`
  bool runs = false;
  int exit_code = 0;
};

class StudioJobs {
 public:
  StudioJobs();
  /// Ends what still runs and waits for it.
  ~StudioJobs();
  StudioJobs(const StudioJobs&) = delete;
  StudioJobs& operator=(const StudioJobs&) = delete;

  /// Begins `vegard WORDS...` and returns its number. Throws Error(usage) for a command that a page may not
  /// run, a word that names what is outside of the folder, and if too many run. With `shown`,
  /// render, preview and export write their picture or page outside of the folder, to be shown only:
  /// picture() has its path.
  enum class Output { kept, shown };
  int begin(const std::vector<std::string>& words, Output output = Output::kept);

  /// The path of the picture of a job that has ended well; empty if there is none.
  std::string picture(int number);

  /// Returns false if there is no such job. With `from` at the end of what was said, it waits up to some
  /// seconds for more.
  bool look(int number, std::size_t from, StudioJobState& state);

  /// As Ctrl-C does; a second time as SIGTERM. Returns false if there is no such job.
  bool stop(int number);

 private:
  struct Job;
  std::shared_ptr<Job> job(int number);

  const std::string& scratch();
  static void remove_picture(Job& job);

  std::mutex mutex_;
  std::vector<std::shared_ptr<Job>> jobs_;
  std::string scratch_;  ///< folder of shown pictures; empty: none yet
};

}  // namespace vegard::apps
