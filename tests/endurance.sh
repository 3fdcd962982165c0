#!/usr/bin/env bash
# endurance.sh [-t SECONDS] [-p PART] [-l] [STEP...]
#
# What takes hours, step by step: all steps, or those whose names begin with the words given; -l lists them. A finished part of a step is
# a line of build/endurance/log: step, part, time, seconds, passed or failed, counts. What has passed is not run again, so that the script
# goes on where it was stopped; remove the log, or lines of it, to run it again. What a part printed is in build/endurance/STEP-PART.txt.
#
#   -t SECONDS   how long each fuzzer runs (default 1800)
#   -p PART      only the parts whose names begin so, as a test program
set -euo pipefail
cd "$(dirname "$0")/.."
source=$PWD
folder=$source/build/endurance
programs=(RhombicCommon Sandbox SurfaceIO ScanIO LabelMaps PictureIO PageDrawing InteractivePage Pipelines DrawingPipelines
          AgreementPipelines BatchPipelines apps) # what has to do with text, files and time
sanitized=(ScanIO SurfaceIO SurfaceEditing LabelSurfaces FCCIsosurface Pipelines apps) # before the others
steps=(together locale-tr_TR locale-de_DE host-de_DE zone blanks lines home user)
for file in tests/fuzz/*Fuzz.cxx; do
  name=${file##*/rhombic}
  steps+=("fuzz-${name%Fuzz.cxx}")
done
declare -A flags=([no-slp]="-O3 -fno-tree-slp-vectorize" [O1]=-O1 [O2]=-O2 [avx2]="-O3 -mavx2 -mfma" [clang]=-O3) # of compilers
for variant in no-slp O1 O2 avx2 clang; do
  steps+=("compiler-$variant")
done
steps+=(malformed options chaos faults)
steps+=(asan tsan)

seconds=1800
chosen=
while getopts t:p:l option; do
  case $option in
    t) seconds=$OPTARG ;;
    p) chosen=$OPTARG ;;
    l)
      printf '%s\n' "${steps[@]}"
      exit
      ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
mkdir -p "$folder"
log=$folder/log
touch "$log"
status=0

part() { # STEP PART COUNTS COMMAND...: runs a part that has not passed yet; the function COUNTS tells what its output says
  local key=$1$'\t'$2 output="$folder/$1-$2.txt" result=passed begin=$SECONDS line
  [[ $2 == "$chosen"* ]] || return 0
  grep -q "^$key"$'\t.*\tpassed\t' "$log" && return
  echo "$1 $2 ..."
  "${@:4}" >"$output" 2>&1 </dev/null || result=failed
  line="$key"$'\t'"$(date -u +%FT%RZ)"$'\t'"$((SECONDS - begin))"$'\t'"$result"$'\t'"$("$3" "$output")"
  echo "$line" | tee -a "$log"
  [ $result = passed ] || status=1
}

count_tests() { # of GoogleTest; with the names of those that failed
  echo "$(grep -c '^\[       OK' "$1") passed, $(grep -c '^\[  SKIPPED.*ms)' "$1") skipped" \
       "$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*ms)$/, failed: \1/p' "$1" | tr -d '\n')"
}
count_ctest() {
  grep -E '^[0-9]+% tests passed' "$1" | tr '\n' ' '
  sed -n '/The following tests FAILED/,$s/^[\t ]*[0-9]* - \([^ ]*\).*/; failed: \1/p' "$1" | tr -d '\n'
}
count_groups() { # of same-bytes.sh
  echo "$(grep -c '^same' "$1") groups the same$(sed -n 's/^DIFFERS/, not/p' "$1" | tr -d '\n')"
}
count_inputs() { # of libFuzzer
  echo "$(sed -n 's/^stat::number_of_executed_units: *//p' "$1") inputs," \
       "$(sed -n 's/.* cov: \([0-9]*\) ft: \([0-9]*\).*/\1 edges, \2 features/p' "$1" | tail -n 1)"
}

as_nobody() { # the command, not as root
  [ "$(id -u)" -ne 0 ] || set -- setpriv --reuid=65534 --regid=65534 --clear-groups "$@"
  "$@"
}

environment() { # STEP VARIABLE=VALUE... [as_nobody]: the test programs, where TMPDIR and the working directory are a new folder
  local step=$1 place who=() program left_out='*.AThousand*:*.TwentyVariants*'
  shift
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
  place=$scratch
  [ "$step" != blanks ] && [ "$step" != together ] || place+='/with  blanks'
  [ "$step" != lines ] || place+=$'/of two\nlines'
  mkdir -p "$place/home"
  chmod 755 "$scratch"
  chmod 777 "$place"
  chmod "$([ "$step" = home ] || [ "$step" = together ] && echo 555 || echo 777)" "$place/home"
  case $step in home | user | together) who=(as_nobody) ;; esac
  [ "$step" != lines ] || left_out+=':*GUIDE_md' # a page with a batch: a table of cases cannot hold such paths
  for program in "${programs[@]}"; do
    [ "$step $program" != 'lines BatchPipelines' ] || continue
    (cd "$place" && part "$step" "$program" count_tests "${who[@]}" env TMPDIR="$place" HOME="$place/home" "$@" \
       "$source/build/dev/bin/${program}Tests" --gtest_filter="-$left_out" && exit $status) || status=1
  done
  rm -rf "$scratch"
}

has_locale() { # LOCALE
  LC_ALL=$1 locale charmap 2>/dev/null | grep -q UTF-8 ||
    { echo "skipped: the locale $1 is missing; package locales, then localedef -i ${1%.*} -f UTF-8 $1" >&2; return 1; }
}

host() { # STEP LOCALE: the program's files are the same in a process that has set the locale, as graphical programs do
  has_locale "$2" || return 0
  mkdir -p "$folder/host"
  c++ -shared -fPIC tests/support/rhombicHostLocale.cxx -o "$folder/host/locale.so"
  printf '#!/bin/sh\nLC_ALL=%s LD_PRELOAD="%s" exec "%s" "$@"\n' "$2" "$folder/host/locale.so" "$source/build/dev/bin/rhombic" \
    >"$folder/host/rhombic"
  chmod +x "$folder/host/rhombic"
  # The others give the program numbers with a point, which CLI11 reads as the locale says.
  part "$1" same-bytes count_groups tests/same-bytes.sh build/dev/bin/rhombic "$folder/host/rhombic" -j 1 \
    mesh- labels- picture-names picture-files picture-formats picture-styles
}

fuzz() { # STEP
  local name=rhombic${1#fuzz-}Fuzz known=tests/fuzz/seeds corpus
  corpus=$folder/corpus/$name
  mkdir -p "$corpus"
  ./pipelines/build.sh fuzz rhombicFuzzSeeds "$name"
  [ -d build/fuzz/seeds ] || build/fuzz/bin/rhombicFuzzSeeds build/fuzz/seeds
  local inputs=("$corpus")
  [ ! -d "build/fuzz/seeds/$name" ] || inputs+=("$source/build/fuzz/seeds/$name")
  [ ! -d "$known/$name" ] || inputs+=("$source/$known/$name")
  (cd "$folder" && part "$1" "$seconds-s" count_inputs "$source/build/fuzz/bin/$name" -max_total_time="$seconds" -timeout=100 \
     -malloc_limit_mb=512 -print_final_stats=1 -artifact_prefix="$folder/$name-" "${inputs[@]}" && exit $status) || status=1
}

compiler() { # STEP VARIANT: the program that is built otherwise writes the same meshes
  local build=$folder/$1 options=("-DCMAKE_CXX_FLAGS_RELEASE=${flags[$2]} -DNDEBUG")
  [ "$2" != clang ] || options+=(-DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++
                                 "-DCMAKE_CXX_FLAGS=-include $source/tests/fuzz/itkClang.h")
  cmake --preset release -B "$build" "${options[@]}" >"$build.txt"
  cmake --build "$build" --target rhombic >>"$build.txt"
  part "$1" same-bytes count_groups tests/same-bytes.sh build/dev/bin/rhombic "$build/bin/rhombic" -j 1 mesh- labels-
}

tail_of() { # what prints its counts at the end
  tail -n 1 "$1"
}

malformed() { # 14 kinds of files, 100,000 mutants; those of VTP, which VTK reads in child processes, are fewer
  ./pipelines/build.sh dev rhombicFuzzSeeds rhombicReadMutants
  build/dev/bin/rhombicFuzzSeeds "$folder/seeds"
  part malformed 100000 tail_of tests/fuzz/malformed.py -n 107000 -p 5000 -k "$folder/malformed" build/dev/bin "$folder/seeds"
}

sanitizer() { # PRESET: CTest's tests, those of each prefix by themselves; the programs that matter most as soon as they are built
  local prefix
  for prefix in "${sanitized[@]}"; do
    [[ $prefix == "$chosen"* ]] || continue
    ./pipelines/build.sh "$1" rhombic "${prefix}Tests"
    part "$1" "$prefix" count_ctest ctest --preset "$1" -R "^$prefix\\."
  done
  [[ -z $chosen || " ${sanitized[*]} " != *" $chosen "* ]] || return 0
  ./pipelines/build.sh "$1"
  ctest --preset "$1" -N | sed -n 's/^ *Test *#[0-9]*: \([^.]*\)\..*/\1/p' | sort -u >"$folder/$1-parts"
  while read -r prefix; do
    [[ " ${sanitized[*]} " == *" $prefix "* ]] || part "$1" "$prefix" count_ctest ctest --preset "$1" -R "^$prefix\\."
  done <"$folder/$1-parts"
}

for step in "${steps[@]}"; do
  wanted=$([ $# -eq 0 ] && echo yes || true)
  for word in "$@"; do
    [[ $step != "$word"* ]] || wanted=yes
  done
  [ -n "$wanted" ] || continue
  case $step in
    locale-*) has_locale "${step#locale-}.UTF-8" && environment "$step" LC_ALL="${step#locale-}.UTF-8" || true ;;
    together) has_locale de_DE.UTF-8 && environment together LC_ALL=de_DE.UTF-8 TZ=Pacific/Kiritimati || true ;; # as zone, blanks and home
    host-*) host "$step" "${step#host-}.UTF-8" ;;
    zone) environment zone TZ=Pacific/Kiritimati ;;
    blanks | lines | home | user) environment "$step" ;;
    fuzz-*) fuzz "$step" ;;
    compiler-*) compiler "$step" "${step#compiler-}" ;;
    malformed) malformed ;;
    options)
      [ -d "$folder/phantom" ] || build/dev/bin/rhombic -q phantom -o "$folder/phantom" --spacing 6
      part options 1000-runs tail_of tests/fuzz/options.py -n 1000 build/dev/bin/rhombic "$folder/phantom"
      ;;
    chaos) part chaos 300-cases tail_of tests/faults/chaos.py build/dev/bin/rhombic -c 300 -r 3 ;;
    faults)
      for command in $(tests/faults/inject-faults.py -l); do
        part faults "$command" tail_of tests/faults/inject-faults.py build/dev/bin/rhombic testdata/phantom 12 "$command"
      done
      ;;
    *) sanitizer "$step" ;;
  esac
done
exit $status
