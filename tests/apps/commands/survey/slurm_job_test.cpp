// The script that a cluster is handed, and folders of shards.
#include "apps/commands/survey/slurm_job.h"

#include <gtest/gtest.h>

#include "apps/commands/survey/shard_folder.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::apps::slurm_job_test {
namespace {

TEST(SlurmJob, WritesNeighboursAsRanges) {
  EXPECT_EQ(task_ranges({1}), "1");
  EXPECT_EQ(task_ranges({1, 2, 3, 7, 9, 10}), "1-3,7,9-10");
}

TEST(SlurmJob, QuotesWhatAShellOrSlurmWouldTakeApart) {
  SlurmScript script;
  script.program = "/opt/my vegard";
  script.plan = "/data/it's/plan.json";
  script.folder = "/data/50%/a b";
  script.name = "night";
  script.tasks = {2, 3};
  script.shards = 7;
  script.at_once = 4;
  script.minutes = 90;
  script.more = {"--partition=long"};
  EXPECT_EQ(slurm_script(script),
            "#!/bin/bash\n"
            "# Written by vegard survey submit: each task is a shard, and goes on where it was if it is "
            "begun again.\n"
            "#SBATCH --job-name=vegard-night\n"
            "#SBATCH --array=2-3%4\n"
            // The first sixteen digits of the SHA-256 of the folder's name, as sha256sum has it.
            "#SBATCH --comment=vegard-2c1d516024e845e4\n"
            "#SBATCH --requeue\n"
            "#SBATCH --open-mode=append\n"
            "#SBATCH --output=\"/data/50%%/a b/log/shard-%a.txt\"\n"
            "#SBATCH --cpus-per-task=1\n"
            "#SBATCH --time=90\n"
            "#SBATCH --partition=long\n"
            "exec '/opt/my vegard' survey run '/data/it'\\''s/plan.json' --out '/data/50%/a b' --shard "
            "\"$SLURM_ARRAY_TASK_ID/7\" --threads 1\n");
  script.folder = "/data/a\"b";
  tests::expect_error(sim::ErrorKind::usage, [&] { slurm_script(script); });
  script.folder = "/data";
  for (const char* option : {"partition=long", "--a\nrm"}) {
    script.more = {option};
    tests::expect_error(sim::ErrorKind::usage, [&] { slurm_script(script); });
  }
}

TEST(ShardFolder, KnowsShardsByTheirNames) {
  const tests::TemporaryFolder folder;
  for (const char* name :
       {"shard-0002-of-0012.sqlite", "shard-0012-of-0012.sqlite", "shard-0013-of-0012.sqlite",
        "shard-2-of-0012.sqlite", "shard-0001-of-0012.sqlite-journal", "shard-0000-of-0012.sqlite"})
    tests::put(folder / name, "");
  const std::vector<ShardFile> files = shard_files(folder / ".");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].shard, 2);
  EXPECT_EQ(files[1].shard, 12);
  EXPECT_EQ(files[1].shards, 12);
  EXPECT_TRUE(shard_files(folder / "none").empty());
  begin_shard_folder(folder / ".", 12);
  tests::expect_error(sim::ErrorKind::existing_output, [&] { begin_shard_folder(folder / ".", 7); });
}

TEST(ShardFolder, ReadsWhichShardOfHowMany) {
  EXPECT_EQ(shard_words("3/120"), std::pair(3, 120));
  for (const char* words :
       {"", "3", "3/", "/3", "0/3", "4/3", "-1/3", "1/3 ", "1/3/5", "1,3", "99999999999/3"})
    tests::expect_error(sim::ErrorKind::usage, [&] { shard_words(words); });
}

}  // namespace
}  // namespace vegard::apps::slurm_job_test
