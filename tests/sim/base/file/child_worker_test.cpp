// Work in a process of its own: its answers, and what becomes of a crash, a hang and a hunger for memory.
#include "sim/base/file/child_worker.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <string>
#include <vector>

#include "sim/base/error.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::child_worker_test {
namespace {

using tests::expect_words;

std::string answer(std::string_view request) {
  static int asked = 0;
  if (request == "crash") ::raise(SIGSEGV);
  if (request == "killed") ::raise(SIGKILL);
  if (request == "quit") ::raise(SIGQUIT);
  if (request == "hang")
    for (volatile int i = 0;; i = 1 - i) {
    }
  if (request == "refuse") throw unreadable("x", "this is bad").expected("better").hint("try again");
  if (request == "much") return std::string(2000, 'x');
  if (request == "memory") {
    std::vector<char> room(std::size_t{1} << 32, 'x');
    return {room.begin(), room.begin() + 3};
  }
  return std::string(request) + " " + std::to_string(++asked);
}

ChildLimits small_limits() {
  ChildLimits limits;
  limits.memory_bytes = std::uint64_t{1} << 28;
  limits.answer_bytes = 1000;
  limits.seconds = 30.0;
  return limits;
}

TEST(ChildWorker, AnswersAndKeepsWhatItHas) {
  ChildWorker worker("file", "a library", answer);
  EXPECT_EQ(worker.ask("a"), "a 1");
  EXPECT_EQ(worker.ask(""), " 2");
  EXPECT_EQ(worker.ask("much").size(), 2000u);
  expect_words(ErrorKind::unreadable_input, {"file", "this is bad", "better", "try again"},
               [&] { worker.ask("refuse"); });
  EXPECT_EQ(worker.ask("b"), "b 3");
}

TEST(ChildWorker, TellsOfACrash) {
  ChildWorker worker("file", "a library", answer);
  expect_words(ErrorKind::unreadable_input, {"file", "damaged", "library fails"},
               [&] { worker.ask("crash"); });
}

TEST(ChildWorker, IsNotTheFilesFaultWhereItIsKilled) {
  for (const char* signal : {"killed", "quit"}) {
    const std::string text = tests::expect_error(
        ErrorKind::unreadable_input, [&] { ChildWorker("file", "a library", answer).ask(signal); });
    EXPECT_NE(text.find("was killed (signal "), std::string::npos) << text;
    EXPECT_EQ(text.find("damaged"), std::string::npos) << text;
  }
}

TEST(ChildWorker, EndsWhatDoesNotEnd) {
  ChildLimits limits;
  limits.seconds = 0.2;
  ChildWorker worker("file", "a library", answer, limits);
  expect_words(ErrorKind::unreadable_input, {"file", "an end"}, [&] { worker.ask("hang"); });
}

TEST(ChildWorker, BoundsMemoryAndAnswers) {
  ChildWorker worker("file", "a library", answer, small_limits());
  expect_words(ErrorKind::unreadable_input, {"file", "more memory"}, [&] { worker.ask("much"); });
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // theirs is not bounded
  ChildWorker hungry("file", "a library", answer, small_limits());
  expect_words(ErrorKind::unreadable_input, {"file", "more memory"}, [&] { hungry.ask("memory"); });
#endif
}

}  // namespace
}  // namespace vegard::sim::child_worker_test
