#!/usr/bin/env bash
# check-budget.sh SOURCE: compares the code with the table of lines in modules/README.md. Fails if a module has more lines than the
# table allows, or much fewer, so that the table is true; if a function has more than 80 lines; and if a module, or a test of another
# module, takes the folder of a module's sources. Counted are lines of .h, .hxx and .cxx files.
set -euo pipefail
cd "$1"
mistakes=0
say() {
  echo "$1"
  mistakes=$((mistakes + 1))
}

lines_of() {
  find "$1" \( -name '*.h' -o -name '*.hxx' -o -name '*.cxx' \) -exec cat {} + | wc -l
}

declare -A allowed
while IFS='|' read -r _ module lines _; do
  allowed[${module// /}]=${lines// /}
done < <(sed -n '/^| lines of | at most |$/,/^$/p' modules/README.md | grep '[0-9] |$')
for folder in modules/*/*/ pipelines/ apps/; do
  folder=${folder%/}
  lines=$(lines_of "$folder")
  limit=${allowed[$folder]:-0}
  if [ "$lines" -gt "$limit" ]; then
    say "$folder has $lines lines, and modules/README.md allows $limit: remove some, or raise the limit and say why"
  elif [ "$lines" -lt $((limit - limit / 20 - 100)) ]; then
    say "$folder has $lines lines: lower its limit of $limit in modules/README.md"
  fi
  unset "allowed[$folder]"
done
for folder in "${!allowed[@]}"; do
  say "modules/README.md has a limit for $folder, which does not exist"
done

# A function begins with a brace alone in its line, at the beginning of the line or, in a class, behind two spaces, and ends with the
# next one like it. Braces of namespaces and classes follow their names.
long_functions() {
  find modules pipelines apps \( -name '*.h' -o -name '*.hxx' -o -name '*.cxx' \) -print0 | xargs -0 awk '
    FNR == 1 { start = 0; inClass = 0; head = "" }
    /^$/ { if (!start) head = "" }
    !start && /^[^ {}#\/]/ { head = /;$/ ? "" : head $0 }
    start && $0 == end ";" { start = 0; head = ""; next } # a class in a class, or an array
    start && $0 == end { if (FNR - start + 1 > 80) print FILENAME ":" start ": " FNR - start + 1 " lines"; start = 0; head = ""; next }
    !start && $0 == "{" {
      if (head ~ /^(inline )?namespace/) { head = "" }
      else if (head ~ /(^|[ >])(class|struct|enum|union)( |$)/) { inClass = 1; head = "" }
      else { start = FNR; end = "}" }
      next
    }
    !start && inClass && $0 == "  {" { start = FNR; end = "  }" }
    !start && /^};/ { inClass = 0; head = "" }'
}
while read -r function; do
  say "a function of more than 80 lines: $function"
done < <(long_functions)

while read -r place; do
  say "a source folder of another module is taken: $place"
done < <(grep -rnE 'RHOMBIC_SOURCE_FOLDERS|(modules|pipelines)/[A-Za-z/]*src\b' --include=CMakeLists.txt --include='*.cmake' modules pipelines apps |
           grep -v '^modules/RhombicModule.cmake' || true)

while read -r place; do
  say "a sentence of a module names an option, which users of ITK do not have; name the setting (pipelines/src/rhombicOptionNames.cxx): $place"
done < <(grep -rnE '"([^"]* )?--[a-z]' --include='*.h' --include='*.hxx' --include='*.cxx' modules | grep -vE '^[^:]*:[0-9]*:\s*(//|\*)' || true)

# Sentences and the table of options agree, setting by setting: a setting that one of them renames is found here.
settings_in() {
  grep -rhoE '"[^"]*(ScanReadOptions|LabelMapSource|Denoising|SurfaceFinish)::[A-Za-z:]+' "$@" --include='*.h' --include='*.hxx' --include='*.cxx' |
    grep -oE '[A-Za-z]+::[A-Za-z:]+$' | sort -u
}
while read -r setting; do
  say "$setting stands only in sentences of modules or only in pipelines/src/rhombicOptionNames.cxx"
done < <(comm -3 <(settings_in modules) <(settings_in pipelines/src/rhombicOptionNames.cxx) | tr -d '\t')
exit $((mistakes > 0))
