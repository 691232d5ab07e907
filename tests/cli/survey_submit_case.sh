# Shards for a cluster: the script, what is told to a stand-in that answers as Slurm does, and the refusals. A real Slurm is in
# tests/slurm.
source "$(dirname "$0")/case.sh"
mkdir night programs
cp "$SCENES/fit.toml" night/scene.toml
expect_exit 0 render "$SCENES/small.toml" -o night/frame.png
for i in 0 1 2 3; do echo "frame.png 2019-03-01T22:10:0${i}Z"; done >night/list.txt
printf '[survey]\nname = "night"\nwork = ["border"]\nscene = "scene.toml"\nblock_frames = 1\n[[camera]]\nname = "a"\nframes = ["list.txt"]\n' \
  >night/survey.toml
expect_exit 0 survey plan night/survey.toml -o plan.json

expect_exit 0 survey submit plan.json --out shards --shards 4 --at-once 2 --sbatch=--partition=long --sbatch=--mem=2G --dry-run
expect_stdout "#SBATCH --array=1-4%2"
expect_stdout "#SBATCH --partition=long"
expect_stdout "#SBATCH --mem=2G"
# shellcheck disable=SC2016
expect_stdout '--shard "$SLURM_ARRAY_TASK_ID/4"'
[[ ! -e shards ]] || fail "a dry run has written something"
# Shards that are finished are not handed over.
expect_exit 0 survey run plan.json --out shards --shard 2/4
expect_exit 0 survey submit plan.json --out shards --dry-run
expect_stdout "#SBATCH --array=1,3-4"
expect_exit 2 survey submit plan.json --out shards --shards 5 --dry-run
expect_stderr "is cut into 4"
expect_exit 5 survey status shards
expect_stdout "night: 1 of 4 | 1 done | 0 skipped | 0 missing | 0 unreadable | 1 of 4 shards"

# No Slurm, one that will not, one that will.
PATH=$PWD/programs expect_exit 2 survey submit plan.json --out shards
expect_stderr "no such program"
expect_one_message
printf '#!/bin/bash\necho "sbatch: error: invalid partition specified: long" >&2\nexit 1\n' >programs/sbatch
printf '#!/bin/bash\nexit 0\n' >programs/squeue
printf '#!/bin/bash\necho "$@" >scancelled\n' >programs/scancel
chmod +x programs/*
PATH=$PWD/programs:$PATH
expect_exit 2 survey submit plan.json --out shards --sbatch=--partition=long
expect_stderr "invalid partition specified: long"
expect_exit 2 survey cancel shards
# Killed between Slurm's taking the job and the note of its number: the queue knows it by its comment.
printf '#!/bin/bash\ncp "$2" submitted\nkill -9 "$PPID"\necho 4710\n' >programs/sbatch
printf '#!/bin/bash\ncase "$*" in *%%k*) echo "11 mine"; echo "4710 $(sed -n "s/^#SBATCH --comment=//p" submitted)" ;; *) echo RUNNING ;; esac\n' \
  >programs/squeue
"$VEGARD" survey submit plan.json --out shards >/dev/null 2>&1 && fail "it was not killed"
expect_exit 2 survey submit plan.json --out shards
expect_stderr "job 4710 | 1 running"
expect_exit 5 survey status shards
expect_stdout "job 4710: 1 running"
expect_exit 0 survey cancel shards
[[ $(cat scancelled) == 4710 ]] || fail "another job is cancelled"
printf '#!/bin/bash\nexit 0\n' >programs/squeue
printf '#!/bin/bash\ncp "$2" submitted\necho "4711;cluster"\n' >programs/sbatch
expect_exit 0 survey submit plan.json --out shards
expect_stdout "job 4711: 3 of 4 shards"
expect_same submitted shards/survey.sbatch
[[ -d shards/log ]] || fail "no folder for the tasks' words"
# What Slurm would do with it.
for task in 1 3 4; do SLURM_ARRAY_TASK_ID=$task bash submitted >/dev/null; done
expect_exit 0 survey status shards
expect_stdout "job 4711"
expect_exit 0 survey submit plan.json --out shards
expect_stdout "all 4 shards"
rm shards/shard-0003-of-0004.sqlite
printf '#!/bin/bash\nprintf "RUNNING\\nPENDING\\nPENDING\\n"\n' >programs/squeue
expect_exit 2 survey submit plan.json --out shards
expect_stderr "job 4711 | 2 pending | 1 running"
expect_exit 5 survey status shards
expect_stdout "job 4711: 2 pending, 1 running"
expect_exit 0 survey cancel shards
[[ $(cat scancelled) == 4711 ]] || fail "another job is cancelled"
# A scene that has changed is found out before a thousand tasks are.
printf '#!/bin/bash\nexit 0\n' >programs/squeue
sed -i 's/^bands = 4/bands = 5/' night/scene.toml
expect_exit 2 survey submit plan.json --out shards
expect_stderr "not what"
echo mine >shards/survey.sbatch
sed -i 's/^bands = 5/bands = 4/' night/scene.toml
expect_exit 2 survey submit plan.json --out shards
expect_stderr "vegard wrote"
expect_exit 2 survey status night
