#include "fit/survey/sqlite_file.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <thread>

#include "tests/support/temporary_folder.h"

namespace vegard::fit::sqlite_file_test {
namespace {

// Whoever opens a database in which another one commits waits until that is done, and is not refused.
TEST(SqliteFile, IsOpenedWhenAnotherOneHasCommitted) {
  const tests::TemporaryFolder folder;
  SqliteFile first(folder / "a.sqlite", SqliteFile::Opening::write);
  first.run("CREATE TABLE numbers (number INTEGER); INSERT INTO numbers VALUES (1)");
  first.run("BEGIN EXCLUSIVE; INSERT INTO numbers VALUES (2)");
  const std::future<void> commits = std::async(std::launch::async, [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    first.run("COMMIT");
  });
  for (const SqliteFile::Opening opening : {SqliteFile::Opening::read, SqliteFile::Opening::write})
    EXPECT_EQ(SqliteFile(folder / "a.sqlite", opening).integer("SELECT count(*) FROM numbers"), 2);
}

}  // namespace
}  // namespace vegard::fit::sqlite_file_test
