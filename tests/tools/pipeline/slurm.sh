# A Slurm of three nodes on this machine, for the tests beside it: started by start_slurm, ended when the
# test does. Nothing of a Slurm that the machine may have is touched.
PATH=$PATH:/usr/sbin
for program in munged slurmctld slurmd sbatch squeue scontrol scancel sinfo setsid ps; do
  command -v $program >/dev/null || skip "needs $program (Debian packages slurm-wlm and munge)"
done

# The folder is short, since names of sockets are, and closed to other users, as munged wants it.
start_slurm() {
  cluster=$(mktemp -d /tmp/talus-slurm.XXXXXX)
  trap stop_slurm EXIT
  chmod 755 "$cluster"
  host=$(hostname -s)
  owner=$(id -un)
  mkdir "$cluster/munge" "$cluster/socket" "$cluster/state" "$cluster/log"
  head -c 128 /dev/urandom >"$cluster/munge/munge.key"
  chmod 400 "$cluster/munge/munge.key"
  chmod 700 "$cluster/munge"
  as_munge=
  if [ "$(id -u)" -eq 0 ]; then
    chown -R munge: "$cluster/munge" "$cluster/socket"
    as_munge="runuser -u munge --"
  fi
  chmod 755 "$cluster/socket"
  $as_munge munged --key-file="$cluster/munge/munge.key" --socket="$cluster/socket/munge.socket" \
    --pid-file="$cluster/munge/munged.pid" --log-file="$cluster/munge/munged.log" --seed-file="$cluster/munge/seed" ||
    fail "munged does not start"
  # Ports of this process: several tests may run at once.
  port=$((20000 + $$ % 20000))
  for node in n1 n2 n3; do mkdir "$cluster/$node"; done
  cat >"$cluster/slurm.conf" <<END
ClusterName=talus
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$owner
SlurmdUser=$owner
AuthInfo=socket=$cluster/socket/munge.socket,cred_expire=5
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/%n
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/%n.pid
SlurmctldLogFile=$cluster/log/slurmctld.log
SlurmdLogFile=$cluster/log/%n.log
SlurmctldPort=$port
ProctrackType=proctrack/linuxproc
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=2
ReturnToService=2
SlurmdTimeout=10
KillWait=5
MailProg=/bin/true
NodeName=n[1-3] NodeHostname=$host NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + 3))] CPUs=1
PartitionName=main Nodes=n[1-3] Default=YES MaxTime=INFINITE State=UP
END
  # from 23 on it asks for control groups, which a container may not have
  case $(slurmd -V) in *' 22.'*) ;; *) echo CgroupPlugin=disabled >"$cluster/cgroup.conf" ;; esac
  export SLURM_CONF="$cluster/slurm.conf"
  setsid slurmctld -i -D >"$cluster/log/slurmctld.out" 2>&1 &
  controller=$!
  for node in n1 n2 n3; do
    setsid slurmd -D -N $node >"$cluster/log/$node.out" 2>&1 &
    eval "daemon_$node=$!"
  done
  n=0
  until [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 3 ]; do
    n=$((n + 1))
    [ $n -lt 300 ] || { tail "$cluster"/log/* >&2; fail "the three nodes do not come up"; }
    sleep 0.1
  done
}

# processes_of TEXT: those that were started with this line in their environment and in this cluster
processes_of() {
  for process in /proc/[0-9]*; do
    { tr '\0' '\n' <"$process/environ"; } 2>/dev/null >"$cluster/environment" || continue
    if grep -qxF "SLURM_CONF=$SLURM_CONF" "$cluster/environment" && grep -qxF "$1" "$cluster/environment"; then
      echo "${process#/proc/}"
    fi
  done
}

# kill_all PROCESS...
kill_all() {
  for process in "$@"; do
    [ "$process" -le 1 ] || kill -9 "$process" 2>/dev/null || true
  done
}

# The node dies: its daemon, the steps that it started (which are children of process 1), and theirs.
kill_node() {
  eval "daemon=\$daemon_$1"
  below=$(processes_of "SLURMD_NODENAME=$1")
  steps=$(for process in $below; do
    # shellcheck disable=SC2046  # a number with blanks before it
    ps -o pid=,args= -p $(ps -o ppid= -p "$process") 2>/dev/null
  done | sed -n 's/^ *\([0-9]*\) slurmstepd: .*/\1/p')
  # shellcheck disable=SC2086,SC2154  # lists of numbers
  kill_all $daemon $steps $below
}

stop_slurm() {
  trap - EXIT
  { scancel -u "$owner" || true; } 2>/dev/null
  n=0
  until [ -z "$(squeue -h -o %i 2>/dev/null)" ] || [ $n -ge 50 ]; do
    n=$((n + 1))
    sleep 0.2
  done
  # shellcheck disable=SC2154  # daemon_*: start_slurm
  for process in "$daemon_n1" "$daemon_n2" "$daemon_n3" "$controller"; do kill "$process" 2>/dev/null || true; done
  sleep 1
  kill_node n1
  kill_node n2
  kill_node n3
  kill_all "$controller"
  kill "$(cat "$cluster/munge/munged.pid" 2>/dev/null)" 2>/dev/null || true
  rm -rf slurm_log
  cp -r "$cluster/log" slurm_log  # to look at when a test fails
  rm -rf "$cluster"
}
