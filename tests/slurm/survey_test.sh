#!/usr/bin/env bash
# A survey as an array of tasks of a real Slurm (tests/slurm/slurm.sh): the same bytes as without it; also while the controller, the
# nodes' daemons and the tasks themselves are killed at random moments, and tasks are put back into the queue.
# usage: survey_test.sh VEGARD SOURCE [KILLS]
# Exit code 77, with the reason, where Slurm is missing.
set -euo pipefail
vegard=$(realpath "$1")
source_folder=$2
kills=${3:-10}
RANDOM=7 # the moments and the victims are drawn by it

# shellcheck source=tests/slurm/slurm.sh
source "$(dirname "${BASH_SOURCE[0]}")/slurm.sh"
missing=$(slurm_missing)
if [[ -n $missing ]]; then
  echo "skipped: $missing"
  exit 77
fi

folder=$(mktemp -d "${TMPDIR:-/tmp}/vegard-slurm-XXXXXX")
finish() {
  slurm_stop
  rm -rf "$folder"
}
trap finish EXIT
cd "$folder"

fail() {
  echo "FAILED: $*" >&2
  tail -n 20 "$folder"/*/log/*.txt "$folder"/slurm/*.log >&2 || true
  exit 1
}

mkdir night
cp "$source_folder/tests/cli/scenes/fit.toml" night/scene.toml
for i in 0 1 2 3; do
  "$vegard" render "$source_folder/tests/cli/scenes/small.toml" -o "night/$i.png" --set "sheet.main.energy_kev=3.$i" >/dev/null
done
for i in $(seq 0 59); do
  printf '%d.png 2019-03-01T22:%02d:%02dZ\n' $((i % 4)) $((i / 20)) $((3 * (i % 20)))
done >night/list.txt
cat >night/survey.toml <<'TOML'
[survey]
name = "night"
work = ["border", "fit"]
scene = "scene.toml"
block_frames = 5
[[camera]]
name = "a"
frames = ["list.txt"]
set = ["fit.scan_points=4", "fit.overall_trials=16"]
TOML
"$vegard" survey plan night/survey.toml -o plan.json
"$vegard" survey run plan.json --out alone
"$vegard" survey merge alone -o alone.sqlite

slurm_start "$folder/slurm"

tasks() { pgrep -f "^$vegard survey run $folder/plan.json --out $folder/" || true; }

# After a minute what whoever runs a cluster does: nodes that were taken for broken are put to work again, and so is a task that
# Slurm believes to run and that no node has.
wait_for_queue() {
  local waited id
  for waited in $(seq 480); do
    [[ -n $(squeue -h 2>/dev/null || echo waiting) ]] || return 0
    if ((waited % 120 == 0)); then
      scontrol update NodeName=n1,n2 State=RESUME 2>/dev/null || true
      if [[ -z $(tasks) ]]; then
        for id in $(squeue -h -t running -o %i); do scontrol requeue "$id" || true; done
      fi
    fi
    sleep 0.5
  done
  squeue >&2
  sinfo -R >&2
  fail "the queue is never empty"
}

# Undisturbed.
"$vegard" survey submit plan.json --out calm --shards 6 --dry-run | grep -qF -- '--array=1-6' || fail "another array"
[[ ! -e calm ]] || fail "a dry run has written something"
"$vegard" survey submit plan.json --out calm --shards 6 --sbatch=--mem=200 >submitted
grep -q '^#SBATCH --mem=200$' submitted || fail "an option is lost"
wait_for_queue
"$vegard" survey status calm >status || fail "$(cat status)"
grep -q '60 of 60 frames: 60 done' status || fail "$(cat status)"
"$vegard" survey merge calm -o calm.sqlite
cmp alone.sqlite calm.sqlite || fail "other bytes by Slurm"
"$vegard" survey submit plan.json --out calm >submitted
grep -q 'all 6 shards are finished' submitted || fail "finished shards are submitted again"
[[ -s calm/log/shard-1.txt ]] || fail "a task has no log"

# Cancelled: what is finished stays.
"$vegard" survey submit plan.json --out cut --shards 12 --at-once 1 >/dev/null
status=0
"$vegard" survey submit plan.json --out cut 2>messages >/dev/null || status=$?
[[ $status -eq 2 ]] || fail "submitted twice"
grep -q 'still at it' messages || fail "$(cat messages)"
sleep 2
"$vegard" survey cancel cut
wait_for_queue
"$vegard" survey submit plan.json --out cut >/dev/null
wait_for_queue
"$vegard" survey merge cut -o cut.sqlite || fail "frames are lacking"
cmp alone.sqlite cut.sqlite || fail "other bytes after cancelling"

# Killed. The tasks run for some seconds; whatever is left of them is submitted again.
submit() {
  for _ in $(seq 60); do
    ! "$vegard" survey submit plan.json --out wild --shards 12 >submitted 2>&1 || return 0
    ! grep -q 'still at it' submitted || return 0
    sleep 1
  done
  fail "cannot be submitted"
}
same_bytes() {
  "$vegard" survey merge wild -o wild.sqlite --overwrite >/dev/null || fail "frames are lacking"
  cmp alone.sqlite wild.sqlite || fail "other bytes after kills"
}
submit
done_kills=0
declare -A hit
while ((done_kills < kills)); do
  sleep "0.$((RANDOM % 10))$((RANDOM % 10))"
  if [[ -z $(squeue -h 2>/dev/null || echo busy) ]]; then
    if "$vegard" survey status wild >/dev/null; then # before enough was killed: from the beginning
      same_bytes
      rm -rf wild
    fi
    submit
    continue
  fi
  case $((RANDOM % 6)) in
    0)
      victim=controller
      kill -KILL "$(slurm_pid ctld)" 2>/dev/null || true
      sleep 0.3
      slurm_daemon ctld
      ;;
    1)
      victim="a node's daemon"
      node=n$((1 + RANDOM % 2))
      kill -KILL "$(slurm_pid $node)" 2>/dev/null || true
      sleep 0.3
      slurm_daemon $node
      ;;
    2 | 3)
      victim=task
      pid=
      for _ in $(seq 50); do
        pid=$(tasks | head -n 1)
        [[ -z $pid ]] || break
        sleep 0.1
      done
      [[ -n $pid ]] || continue
      sleep "0.$((RANDOM % 10))"
      kill -KILL "$pid" 2>/dev/null || continue
      ;;
    4 | 5)
      victim="put back into the queue"
      id=$(squeue -h -t running -o %i 2>/dev/null | head -n 1)
      [[ -n $id ]] || continue
      scontrol requeue "$id" 2>/dev/null || continue
      ;;
  esac
  hit[$victim]=$((${hit[$victim]:-0} + 1))
  done_kills=$((done_kills + 1))
done
for _ in $(seq 20); do
  wait_for_queue
  ! "$vegard" survey status wild >/dev/null || break
  submit
done
same_bytes
for victim in "${!hit[@]}"; do echo "$victim: ${hit[$victim]} times"; done
echo "the same bytes"
