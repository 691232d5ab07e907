# For the scripts beside it that compare with Blender's Cycles; to be sourced. Wants $here, the folder of the scripts.

# cycles GRID.vdb OUT KEY=VALUE...: renders by blender_check.py; prints the seconds of each frame but the first
cycles() {
  local grid=$1 out=$2
  shift 2
  blender -b -t 2 --python-exit-code 1 --python "$here/blender_check.py" -- "$grid" "$out" "$@" >blender.log 2>&1 ||
    { cat blender.log; exit 1; }
  awk '/ Sample [0-9]+\/[0-9]+ *$/ {
         match($0, /Fra:[0-9]+/); frame = substr($0, RSTART + 4, RLENGTH - 4)
         match($0, /Time:[0-9:.]+/); split(substr($0, RSTART + 5, RLENGTH - 5), part, ":")
         seconds = part[1] * 60 + part[2]
         split($NF, sample, "/")
         if (sample[1] == 0) start[frame] = seconds
         else if (sample[1] == sample[2] && frame > 1) printf "%.2f\n", seconds - start[frame]
       }' blender.log
}
median() { sort -g | awk '{ x[NR] = $1 } END { print NR % 2 ? x[(NR + 1) / 2] : (x[NR / 2] + x[NR / 2 + 1]) / 2 }'; }
