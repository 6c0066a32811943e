#!/bin/sh
# pack_page.sh OUT PAGE CORE: the page's files and core.wasm as a C++ file that has them in it (server/web/page_files.h).
# The modules are joined into few (esbuild): eighty small ones cost a stranger a dozen round trips, and a quarter more bytes. What the first picture does without
# stays apart (whole.js), what only recordings, the laboratory and the error figure want (later.js), and each worker has its own. index.html names its scripts and styles below the version of all files together, which
# are therefore good for ever, and what the first picture wants at once: else a browser learns of it one after the other.
# Packed by zopfli where it is installed: a twentieth less than gzip, for any gunzip.
set -eu
out=$1 page=$2 core=$3
rm -rf "$out/files"
mkdir -p "$out/files"
pack='gzip -9nc'
! command -v zopfli > /dev/null || pack='zopfli -c'
small="--minify --charset=utf8 --target=es2022 --log-level=warning"
join="esbuild --bundle --format=esm $small --outbase=. --outdir=$out/files"
(cd "$page" && $join page.js --splitting --chunk-names='parts/[name]-[hash]' && $join picture/bake.js core/recording_worker.js)
for name in $(cd "$page" && find . -type f \( -name '*.html' -o -name '*.css' -o -name '*.svg' -o -name '*.png' \) | sed 's#^\./##'); do
  mkdir -p "$(dirname "$out/files/$name")"
  case $name in
    *.css) esbuild $small --loader=css < "$page/$name" > "$out/files/$name" ;;
    *) cp "$page/$name" "$out/files/$name" ;;
  esac
done
cp "$core" "$out/files/core.wasm"
names=$(cd "$out/files" && find . -type f | sed 's#^\./##' | LC_ALL=C sort)
version=$(cd "$out/files" && sha256sum $names | sha256sum | cut -c1-16)
# What page.js imports at once: without what import() loads behind the first picture.
modules=$({ echo page.js; grep -oE '(from|import)"\./parts/[^"]*' "$out/files/page.js" | sed 's#.*/parts#parts#'; } | sed 's#.*#<link rel="modulepreload" href="&">#' | tr -d '\n')
sed -E -e "s#^<script type=\"module\"#$modules\n&#" -e "s#(href|src)=\"(\./)?([A-Za-z0-9_][A-Za-z0-9_./-]*\.(js|css|svg|png|wasm))\"#\1=\"/$version/\3\"#g" "$page/index.html" > "$out/files/index.html"

{
  echo '// Made by cmake/pack_page.sh.'
  echo '#include "server/web/page_files.h"'
  number=0
  table=
  for name in $names; do
    file=$out/files/$name
    size=$(wc -c < "$file")
    $pack "$file" > "$file.gz"
    packed=$(wc -c < "$file.gz")
    for form in "" .gz; do
      printf 'asm(".pushsection .rodata; .globl %s; %s: .incbin \\"%s\\"; .popsection");\n' \
        "woodlouse_page_$number${form:+_packed}" "woodlouse_page_$number${form:+_packed}" "$file$form"
    done
    echo "extern \"C\" const char woodlouse_page_$number[], woodlouse_page_${number}_packed[];"
    [ "$packed" -lt "$size" ] || packed=0
    table="$table    {\"$name\", {woodlouse_page_$number, $size}, {woodlouse_page_${number}_packed, $packed}},
"
    number=$((number + 1))
  done
  printf 'namespace woodlouse::server {\nEmbeddedPage embedded_page() {\n  static const EmbeddedFile kFiles[] = {\n%s  };\n  return {"%s", kFiles};\n}\n}  // namespace woodlouse::server\n' "$table" "$version"
} > "$out/embedded_page.cpp"
