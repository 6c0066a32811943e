#!/bin/sh
# order_functions.sh CORE: core.wasm, linked with its functions' names in it, made smaller in place by binaryen, and its functions put
# side by side that are one template for several types. What is alike is packed once, but only within the 32 KB that gzip looks back: in
# the linker's order it was a tenth more. No function changes by it but in its number.
set -eu
core=$1
features='--enable-bulk-memory --enable-simd --enable-sign-ext --enable-mutable-globals --enable-nontrapping-float-to-int'
tab=$(printf '\t')
# As text a function is what stands from "(func" to ")" below the module: each of its lines is led by its name without the types, then
# by the line's number. What stands before the first keeps its place, and so does what stands behind the last.
wasm-dis $features "$core" | awk '
  function without_types(name,   at, depth, letter, plain) {
    sub(/\\28.*/, "", name)  # its arguments
    for (at = 1; at <= length(name); at++) {
      letter = substr(name, at, 1)
      if (letter == "<") depth++
      else if (letter == ">") depth--
      else if (depth == 0) plain = plain letter
    }
    sub(/.*\\20/, "", plain)  # what it returns
    return plain
  }
  /^ \(func / { key = without_types($2) }
  { print key "\t" NR "\t" $0 }
  /^ \)$/ { key = "~" }' | LC_ALL=C sort -t "$tab" -k1,1 -k2,2n | cut -f3- > "$core.wat"
# From -O2 on it is smaller, but packed larger: it puts its functions into an order of its own.
wasm-opt $features -O1 "$core.wat" -o "$core"
rm "$core.wat"
