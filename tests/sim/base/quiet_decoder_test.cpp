#include "sim/base/quiet_decoder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>

#include "tests/support/temporary_folder.h"

namespace vegard::sim::quiet_decoder_test {
namespace {

void say(const char* word) { ASSERT_EQ(::write(STDERR_FILENO, word, 2), 2); }

TEST(QuietDecoder, WordsAreLostWhileThereIsOneAndNoLonger) {
  const tests::TemporaryFolder folder;
  const std::string heard = folder / "heard";
  const int before = ::dup(STDERR_FILENO);
  const int file = ::open(heard.c_str(), O_WRONLY | O_CREAT, 0600);
  ::dup2(file, STDERR_FILENO);
  say("a ");
  {
    // Not in the order of a stack, as threads would.
    auto first = std::make_unique<QuietDecoder>();
    const QuietDecoder second;
    say("b ");
    first.reset();
    say("c ");
  }
  say("d ");
  {
    const QuietDecoder again;
    say("e ");
  }
  ::dup2(before, STDERR_FILENO);
  ::close(before);
  ::close(file);
  EXPECT_EQ(tests::bytes_of(heard), "a d ");
}

}  // namespace
}  // namespace vegard::sim::quiet_decoder_test
