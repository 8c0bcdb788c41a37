#!/bin/sh
# kit.sh PREFIX LIBDIR SCRATCH shared|static WHAT... - one test of what is installed under PREFIX. CC, FLAGS: the compiler, and what the library's
# own sanitizers ask of a program that loads it.
set -eu
prefix=$1 lib=$1/$2 scratch=$3 kind=$4 what=$5
shift 5
export PKG_CONFIG_PATH="$lib/pkgconfig" LD_LIBRARY_PATH="$lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
case2=$prefix/share/hbmcheck/cases/paper/case2.yaml

wrong() { echo "$*" >&2; exit 1; }
static() { [ "$kind" = shared ] || echo --static; }

# One of each kind of thing must be there, and the command must run from there.
prefix() {
  rm -rf "$prefix"
  "$1" --install "$2" --prefix "$prefix" >"$scratch/installed.txt"
  for file in include/hbmcheck.h share/bash-completion/completions/hbmcheck share/doc/hbmcheck/copyright; do
    [ -s "$prefix/$file" ] || wrong "$file is missing"
  done
  "$prefix/bin/hbmcheck" frf "$case2" --at 5 --format csv >"$scratch/frf.csv" || wrong "the installed command fails"
}

# One header, which says itself what it needs, to C and to C++; every macro of it has our prefix.
headers() {
  [ "$(find "$prefix/include" -type f)" = "$prefix/include/hbmcheck.h" ] || wrong "headers: $(find "$prefix/include" -type f)"
  echo '#include <hbmcheck.h>' >"$scratch/header.c"
  $CC -std=c11 -Wall -Wextra -Wpedantic -Werror $(pkg-config --cflags hbmcheck) -fsyntax-only "$scratch/header.c" || wrong "not by itself"
  [ $# -lt 1 ] || "$1" -std=c++98 -Wall -Wextra -Wpedantic -Werror $(pkg-config --cflags hbmcheck) -x c++ -fsyntax-only "$scratch/header.c" ||
    wrong "not C++"
  if grep -E '^ *# *define' "$prefix/include/hbmcheck.h" | grep -vE 'define HBMCHECK_'; then wrong "the macros above have another prefix"; fi
}

# By find_package, as a project of its own.
package() {
  rm -rf "$scratch/package"
  "$1" -S "$2" -B "$scratch/package" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$CC" -DCMAKE_C_FLAGS="$FLAGS" >"$scratch/package.txt" 2>&1 ||
    { cat "$scratch/package.txt"; wrong "the consumer does not configure"; }
  "$1" --build "$scratch/package"
  "$scratch/package/consumer" "$case2"
}

pkgconfig() {
  [ "$(pkg-config --modversion hbmcheck)" = "$("$prefix/bin/hbmcheck" --version | awk 'NR == 1 {print $2}')" ] || wrong "versions differ"
  $CC $FLAGS -std=c11 "$1/main.c" -o "$scratch/by_pkgconfig" $(pkg-config $(static) --cflags --libs hbmcheck) -lm
  "$scratch/by_pkgconfig" "$case2"
}

# The same program through a C++ compiler: the headers are C++ too, and their functions are found under their C names. {0} is C's habit, not a slip.
cxx() {
  [ $# -ge 2 ] || exit 77
  "$2" $FLAGS -std=c++17 -Wall -Wextra -Wno-missing-field-initializers -Werror -x c++ "$1/main.c" -x none -o "$scratch/by_cxx" \
    $(pkg-config $(static) --cflags --libs hbmcheck) -lm
  "$scratch/by_cxx" "$case2"
}

# The functions the installed headers declare, by the preprocessor: our lines, bodies (and structs) cut out, what is left of the first parenthesis.
declared() {
  echo '#include <hbmcheck.h>' | $CC -E $(pkg-config --cflags hbmcheck) -x c - | awk -v ours="$prefix" '
    /^# [0-9]+ "/ { on = index($3, "\"" ours) == 1; next }
    on { text = text " " $0 }
    END {
      while (gsub(/{[^{}]*}/, ";", text)) continue
      n = split(text, statement, ";")
      for (i = 1; i <= n; ++i) {
        if (statement[i] !~ /\(/ || statement[i] ~ /^ *(static|typedef) /) continue
        sub(/ *\(.*/, "", statement[i])
        sub(/.*[ *]/, "", statement[i])
        print statement[i]
      }
    }' | sort -u
}

# What the library exports is what its header declares: nothing more, nothing less, all with our prefix.
abi() {
  declared >"$scratch/declared.txt"
  nm -D --defined-only "$lib/libhbmcheck.so" | awk '{print $NF}' | sed 's/@.*//' | sort -u >"$scratch/exported.txt"
  grep -qx hbmcheck_run "$scratch/declared.txt" || wrong "hbmcheck_run is not seen in the header"
  diff "$scratch/declared.txt" "$scratch/exported.txt" || wrong "< declared, not exported; > exported, not declared"
  if grep -v '^hbmcheck_' "$scratch/declared.txt"; then wrong "the functions above have another prefix"; fi
  echo "$(wc -l <"$scratch/exported.txt") functions"
}

# The examples of that page of SOURCE, as they stand there, by that Python, the installed command and library: cc and pkg-config are as CC, FLAGS and a static library need them.
page() {
  mkdir -p "$scratch/bin"
  printf '#!/bin/sh\nexec %s %s -std=c11 -Wall -Wextra -Werror "$@"\n' "$CC" "$FLAGS" >"$scratch/bin/cc"
  printf '#!/bin/sh\nexec %s %s "$@"\n' "$(command -v pkg-config)" "$(static)" >"$scratch/bin/pkg-config"
  chmod +x "$scratch/bin/cc" "$scratch/bin/pkg-config"
  cd "$scratch"
  PATH="$scratch/bin:$(dirname "$2"):$PATH" "$2" "$1/tests/docs/examples.py" "$prefix/bin/hbmcheck" "$1" "$1/docs/$3"
}

"$what" "$@"
