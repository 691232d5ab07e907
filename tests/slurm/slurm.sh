# shellcheck shell=bash
# A real Slurm of two nodes on this machine, on loopback, with all of its files in one folder and its own munge: to be sourced.
# `slurm_start FOLDER`, `slurm_stop`; in between SLURM_CONF is set. `slurm_missing` says what is not there for it; empty: nothing.

slurm_missing() {
  local program
  for program in slurmctld slurmd sbatch squeue scontrol munged; do
    PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || {
      echo "no $program (packages slurm-wlm and munge)"
      return
    }
  done
  [[ $(id -u) -eq 0 ]] || echo "not root, which the node daemons want"
}

slurm_free_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

slurm_daemon() { # ctld | n1 | n2
  case $1 in
    ctld) slurmctld -f "$SLURM_CONF" >>"$slurm_folder/start.log" 2>&1 ;;
    *) slurmd -f "$SLURM_CONF" -N "$1" >>"$slurm_folder/start.log" 2>&1 ;;
  esac
}

slurm_pid() { cat "$slurm_folder/$1.pid" 2>/dev/null || true; } # ctld | n1 | n2 | munge

slurm_start() { # FOLDER
  slurm_folder=$1
  PATH=$PATH:/usr/sbin
  mkdir -p "$slurm_folder/state"
  chmod 755 "$slurm_folder"
  (umask 077 && head -c 128 /dev/urandom >"$slurm_folder/munge.key")
  munged --force --socket="$slurm_folder/munge.socket" --key-file="$slurm_folder/munge.key" --pid-file="$slurm_folder/munge.pid" \
    --log-file="$slurm_folder/munge.log" --seed-file="$slurm_folder/munge.seed" >>"$slurm_folder/start.log" 2>&1
  export SLURM_CONF=$slurm_folder/slurm.conf
  cat >"$SLURM_CONF" <<CONF
ClusterName=t
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$slurm_folder/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$slurm_folder/state
SlurmdSpoolDir=$slurm_folder/spool.%n
SlurmctldPidFile=$slurm_folder/ctld.pid
SlurmdPidFile=$slurm_folder/%n.pid
SlurmctldLogFile=$slurm_folder/ctld.log
SlurmdLogFile=$slurm_folder/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
KillWait=2
MinJobAge=10
SlurmctldPort=$(slurm_free_port)
SlurmdParameters=config_overrides
NodeName=n1 NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=$(slurm_free_port) CPUs=1 RealMemory=1000
NodeName=n2 NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=$(slurm_free_port) CPUs=1 RealMemory=1000
PartitionName=p Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  slurm_daemon ctld
  sleep 2
  slurm_daemon n1
  slurm_daemon n2
  for _ in $(seq 60); do
    [[ $(sinfo -h -o %t 2>/dev/null | sort -u) != idle ]] || return 0
    sleep 1
  done
  echo "the nodes do not come up" >&2
  cat "$slurm_folder"/start.log "$slurm_folder"/*.log >&2
  return 1
}

slurm_stop() {
  local name pid
  scancel --user=root 2>/dev/null || true
  for name in n1 n2 ctld munge; do
    pid=$(slurm_pid "$name")
    [[ -z $pid ]] || kill "$pid" 2>/dev/null || true
  done
  for _ in $(seq 40); do
    pid=
    for name in n1 n2 ctld munge; do
      [[ -z $(slurm_pid "$name") ]] || ! kill -0 "$(slurm_pid "$name")" 2>/dev/null || pid=alive
    done
    [[ -n $pid ]] || return 0
    sleep 0.25
  done
  for name in n1 n2 ctld munge; do
    pid=$(slurm_pid "$name")
    [[ -z $pid ]] || kill -KILL "$pid" 2>/dev/null || true
  done
}
