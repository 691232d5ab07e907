// Runs a fuzz target without a fuzzing engine, so that any compiler will do: fuzz_image --seconds 30.
//
// The same --seed gives the same inputs in the same order. An input that ends the process is first written to
// the folder of --findings; so is one after which the process has held more than --memory-mb. Names of files
// among the words are inputs to be run instead.
#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/target.h"

namespace {

using namespace vegard::tests;

struct Options {
  std::uint64_t seed = 1;
  double seconds = 10.0;
  std::uint32_t inputs = 0xffffffffu;
  unsigned max_seconds_per_input =
      10;  ///< of the processor; by the clock sixty times that, on a busy machine
  long memory_mb = 2048;
  std::string findings = ".", source = ".", corpus;
  std::vector<std::string> files;
};

// What a signal handler may touch.
std::string* input_at_hand = nullptr;
char finding_path[4096];
int terminal = 2;

void keep_input() {
  const int file = open(finding_path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0) return;
  std::size_t at = 0;
  while (at < input_at_hand->size()) {
    const ssize_t written = write(file, input_at_hand->data() + at, input_at_hand->size() - at);
    if (written <= 0) break;
    at += static_cast<std::size_t>(written);
  }
  close(file);
}

void say(const char* words) {
  if (write(terminal, words, std::strlen(words)) < 0) return;
}

[[noreturn]] void give_up(const char* why) {
  keep_input();
  say("fuzz: ");
  say(why);
  say("; the input is ");
  say(finding_path);
  say("\n");
  _exit(1);
}

void on_signal(int number) {
  give_up(number == SIGALRM || number == SIGPROF ? "an input took too long" : "an input ended the process");
}

void catch_signals() {
  // A stack that has run over cannot hold the handler.
  static char stack[1 << 16];
  stack_t other = {};
  other.ss_sp = stack;
  other.ss_size = sizeof stack;
  sigaltstack(&other, nullptr);
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_ONSTACK;
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGPROF})
    sigaction(number, &action, nullptr);
}

/// Decoders complain to the terminal by themselves. What they write goes to memory, and is counted.
class Quiet {
 public:
  Quiet() : memory_(memfd_create("words", 0)) {
    terminal = dup(2);
    dup2(memory_, 1);
    dup2(memory_, 2);
  }
  /// Whether anything was written since the last call.
  bool had_words() {
    std::fflush(stdout);
    struct stat state = {};
    if (fstat(memory_, &state) != 0 || state.st_size == 0) return false;
    lseek(memory_, 0, SEEK_SET);
    return ftruncate(memory_, 0) == 0;
  }

 private:
  int memory_;
};

long held_mb() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

Options options_of(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word.compare(0, 2, "--") != 0) {
      options.files.push_back(word);
      continue;
    }
    const std::string value = ++i < count ? words[i] : "";
    if (word == "--seed")
      options.seed = std::strtoull(value.c_str(), nullptr, 10);
    else if (word == "--seconds")
      options.seconds = std::strtod(value.c_str(), nullptr);
    else if (word == "--inputs")
      options.inputs = static_cast<std::uint32_t>(std::strtoul(value.c_str(), nullptr, 10));
    else if (word == "--memory-mb")
      options.memory_mb = std::strtol(value.c_str(), nullptr, 10);
    else if (word == "--findings")
      options.findings = value;
    else if (word == "--source")
      options.source = value;
    else if (word == "--write-corpus")
      options.corpus = value;
    else {
      std::fprintf(stderr, "fuzz: unknown option %s\n", word.c_str());
      std::exit(2);
    }
  }
  return options;
}

void write_corpus(const std::string& folder, const std::vector<std::string>& seeds) {
  for (std::size_t i = 0; i < seeds.size(); ++i)
    std::ofstream(folder + "/seed-" + std::to_string(i), std::ios::binary) << seeds[i];
  std::ofstream words(folder + ".dictionary");
  for (const std::string& word : fuzz_dictionary()) {
    words << '"';
    for (const unsigned char c : word) {
      char text[8];
      std::snprintf(text, sizeof text, "\\x%02x", c);
      words << text;
    }
    words << "\"\n";
  }
}

/// SIGPROF after so many seconds of work, SIGALRM for whoever sleeps; 0: neither.
void limit_time(unsigned seconds) {
  itimerval work = {};
  work.it_value.tv_sec = seconds;
  setitimer(ITIMER_PROF, &work, nullptr);
  alarm(60 * seconds);
}

void run(const Options& options, std::string& input) {
  input_at_hand = &input;
  limit_time(options.max_seconds_per_input);
  // From here on as it comes: an exception that escapes ends the process.
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  limit_time(0);
  if (held_mb() > options.memory_mb) give_up("more memory was held than --memory-mb allows");
}

}  // namespace

int main(int count, char** words) {
  const Options options = options_of(count, words);
  const std::string path = options.findings + "/finding-" + std::to_string(options.seed);
  std::strncpy(finding_path, path.c_str(), sizeof finding_path - 1);
  std::vector<std::string> corpus;
  for (const std::string& file : options.files) {
    std::ifstream stream(file, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  const bool replay = !corpus.empty();
  if (!replay) corpus = fuzz_seeds(options.source);
  if (!options.corpus.empty()) {
    write_corpus(options.corpus, corpus);
    return 0;
  }
  Quiet quiet;
  catch_signals();
  std::uint32_t ran = 0, with_words = 0;
  for (std::string& seed : corpus) {
    run(options, seed);
    ++ran;
    with_words += quiet.had_words();
  }
  Mutation mutation;
  mutation.seed = options.seed;
  mutation.dictionary = fuzz_dictionary();
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  std::string input;
  for (std::uint32_t i = 0; !replay && i < options.inputs && seconds() < options.seconds; ++i) {
    input = mutated(mutation, corpus, i);
    // Half of them as they are: a wrong checksum is a fault as well.
    if (i % 2 == 0) mend_after_mutation(input);
    run(options, input);
    ++ran;
    with_words += quiet.had_words();
  }
  char report[256];
  std::snprintf(
      report, sizeof report,
      "fuzz: %u inputs from %zu seeds in %.0f s, at most %ld MB held, no finding; of %u a library wrote to "
      "the terminal\n",
      ran, corpus.size(), seconds(), held_mb(), with_words);
  say(report);
  return 0;
}
