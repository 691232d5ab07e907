#include "apps/studio/studio_jobs.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <fmt/format.h>

#include "apps/options/refusals.h"
#include "apps/studio/studio_folder.h"
#include "sim/base/error.h"

namespace vegard::apps {
namespace {

constexpr std::size_t kMostSaid = 4u << 20, kMostRunning = 8;
constexpr auto kPatience = std::chrono::seconds(10);

/// Those that read photographs, scenes and runs and write beside them.
const std::vector<std::string>& allowed() {
  static const std::vector<std::string> words = {"measure", "describe", "mask",   "calibrate",
                                                 "horizon", "border",   "map",    "fit",
                                                 "render",  "preview",  "params", "export"};
  return words;
}

}  // namespace

struct StudioJobs::Job {
  std::vector<std::string> words;
  std::string picture;  // that it writes outside of the folder; empty: none
  pid_t process = -1;
  std::thread reader;
  std::mutex mutex;
  std::condition_variable news;
  std::string said, output;
  bool runs = true, was_stopped = false;
  int exit_code = 0;

  ~Job() {
    if (reader.joinable()) reader.join();
  }

  void start();
  void read(int out, int err);
  void keep(const char* bytes, std::size_t count, bool is_output) {
    const std::lock_guard<std::mutex> lock(mutex);
    if (said.size() < kMostSaid) said.append(bytes, count);
    if (is_output && output.size() < kMostSaid) output.append(bytes, count);
    news.notify_all();
  }
};

void StudioJobs::Job::start() {
  int out[2], err[2];
  if (::pipe2(out, O_CLOEXEC) != 0)
    throw usage_error("the studio", "no pipe can be made", "fewer commands at once");
  if (::pipe2(err, O_CLOEXEC) != 0) {
    ::close(out[0]);
    ::close(out[1]);
    throw usage_error("the studio", "no pipe can be made", "fewer commands at once");
  }
  std::vector<std::string> copies = {"vegard"};
  copies.insert(copies.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int nowhere = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  // What stops it right away must not meet the handlers of the studio, which the new process has until it is
  // the command.
  sigset_t stops, before;
  ::sigemptyset(&stops);
  ::sigaddset(&stops, SIGINT);
  ::sigaddset(&stops, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &stops, &before);
  process = ::fork();
  if (process == 0) {
    // Of its own group, so that Ctrl-C at the terminal reaches it once, through stop().
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::dup2(nowhere, STDIN_FILENO);
    ::dup2(out[1], STDOUT_FILENO);
    ::dup2(err[1], STDERR_FILENO);
    ::signal(SIGINT, SIG_DFL);
    ::signal(SIGTERM, SIG_DFL);
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    ::execv("/proc/self/exe", arguments.data());
    ::_exit(127);
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (nowhere >= 0) ::close(nowhere);
  ::close(out[1]);
  ::close(err[1]);
  if (process < 0) {
    ::close(out[0]);
    ::close(err[0]);
    throw usage_error("the studio", "no process can be begun", "fewer commands at once");
  }
  ::setpgid(process, process);
  reader = std::thread([this, from = out[0], messages = err[0]] { read(from, messages); });
}

void StudioJobs::Job::read(int out, int err) {
  pollfd ends[2] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
  char block[1 << 14];
  for (int open = 2; open > 0;) {
    if (::poll(ends, 2, -1) < 0 && errno != EINTR) break;
    for (int i = 0; i < 2; ++i) {
      if (ends[i].fd < 0 || ends[i].revents == 0) continue;
      const ssize_t count = ::read(ends[i].fd, block, sizeof block);
      if (count > 0) {
        keep(block, static_cast<std::size_t>(count), i == 0);
      } else if (count == 0 || errno != EINTR) {
        ::close(ends[i].fd);
        ends[i].fd = -1;
        --open;
      }
    }
  }
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  const std::lock_guard<std::mutex> lock(mutex);
  exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  runs = false;
  news.notify_all();
}

void StudioJobs::remove_picture(Job& job) {
  const std::lock_guard<std::mutex> lock(job.mutex);
  if (job.runs || job.picture.empty()) return;
  std::error_code trouble;
  std::filesystem::remove(job.picture, trouble);
  job.picture.clear();
}

StudioJobs::StudioJobs() = default;

StudioJobs::~StudioJobs() {
  for (const auto& one : jobs_) {
    const std::lock_guard<std::mutex> lock(one->mutex);
    if (one->runs) ::kill(-one->process, SIGTERM);
  }
  jobs_.clear();            // which waits
  std::error_code trouble;  // a folder that stays is no loss
  if (!scratch_.empty()) std::filesystem::remove_all(scratch_, trouble);
}

const std::string& StudioJobs::scratch() {
  if (!scratch_.empty()) return scratch_;
  std::error_code trouble;
  std::string name = (std::filesystem::temp_directory_path(trouble) / "vegard-studio-XXXXXX").string();
  if (trouble || ::mkdtemp(name.data()) == nullptr)
    throw sim::Error(sim::ErrorKind::unwritable_output, "no temporary folder can be made");
  return scratch_ = name;
}

int StudioJobs::begin(const std::vector<std::string>& words, Output output) {
  if (words.empty() || std::find(allowed().begin(), allowed().end(), words[0]) == allowed().end())
    throw usage_error("the studio", "this command is not run from a page",
                      "one of measure, fit, render, ...");
  for (const std::string& word : words)
    if (!stays_inside(word) || word.find('\0') != std::string::npos)
      throw usage_error("the studio", "'" + word + "' is outside of the studio's folder",
                        "names inside of the folder");
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto running = std::count_if(jobs_.begin(), jobs_.end(), [](const std::shared_ptr<Job>& one) {
    const std::lock_guard<std::mutex> its(one->mutex);
    return one->runs;
  });
  if (static_cast<std::size_t>(running) >= kMostRunning)
    throw usage_error("the studio", "too many commands run at once", "fewer: wait for one, or stop it");
  auto one = std::make_shared<Job>();
  one->words = words;
  if (output == Output::shown) {
    const bool is_preview = words[0] == "preview", is_page = words[0] == "export";
    const std::string out = fmt::format("{}/{}{}", scratch(), jobs_.size(),
                                        is_preview ? ""
                                        : is_page  ? ".html"
                                                   : ".png");
    one->picture = is_preview ? out + "/frame_0000.png" : out;
    one->words.insert(one->words.end(), {is_page ? "--web" : "-o", out});
    // One that is looked at no more.
    for (const auto& older : jobs_) remove_picture(*older);
  }
  one->start();
  jobs_.push_back(std::move(one));
  return static_cast<int>(jobs_.size()) - 1;
}

std::shared_ptr<StudioJobs::Job> StudioJobs::job(int number) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return number >= 0 && static_cast<std::size_t>(number) < jobs_.size()
             ? jobs_[static_cast<std::size_t>(number)]
             : nullptr;
}

std::string StudioJobs::picture(int number) {
  const std::shared_ptr<Job> one = job(number);
  if (one == nullptr) return {};
  const std::lock_guard<std::mutex> lock(one->mutex);
  return one->runs || one->exit_code != 0 ? std::string() : one->picture;
}

bool StudioJobs::look(int number, std::size_t from, StudioJobState& state) {
  const std::shared_ptr<Job> one = job(number);
  if (one == nullptr) return false;
  std::unique_lock<std::mutex> lock(one->mutex);
  one->news.wait_for(lock, kPatience, [&] { return !one->runs || one->said.size() > from; });
  state.words = one->words;
  state.said = from < one->said.size() ? one->said.substr(from) : "";
  state.end = std::max(from, one->said.size());
  state.runs = one->runs;
  state.exit_code = one->exit_code;
  if (!one->runs) state.output = one->output;
  return true;
}

bool StudioJobs::stop(int number) {
  const std::shared_ptr<Job> one = job(number);
  if (one == nullptr) return false;
  const std::lock_guard<std::mutex> lock(one->mutex);
  if (one->runs) ::kill(-one->process, one->was_stopped ? SIGTERM : SIGINT);
  one->was_stopped = true;
  return true;
}

}  // namespace vegard::apps
