#!/usr/bin/env bash
# A page of all cases: each with its drawing, its verdict and its report.
# Usage: gallery.sh WHIRL CASES FOLDER
set -euo pipefail
whirl="$1" cases="$2" folder="$3"

mkdir -p "$folder"
escaped() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }

page="$(mktemp "$folder/.index.XXXXXX")"
trap 'rm -f "$page"' EXIT
{
  echo '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Cases</title><style>'
  echo 'body{font:15px/1.4 "DejaVu Sans",sans-serif;color:#1d2733;margin:2em}'
  echo 'main{display:grid;grid-template-columns:repeat(auto-fill,minmax(22em,1fr));gap:1.5em}'
  echo 'a{color:inherit;text-decoration:none;border:1px solid #d5dbe1;border-radius:6px;padding:1em;display:block}'
  echo 'a:hover{border-color:#0072b2}img{width:100%;height:9em;object-fit:contain}h2{font-size:1em;margin:.5em 0}'
  echo 'p{font-size:.85em;color:#5a6673;margin:0}</style></head><body><h1>Cases</h1><main>'
} > "$page"

failed=0
for case in "$cases"/*/; do
  name="$(basename "$case")"
  [[ -f "$case/case.toml" ]] || continue
  # Without a shaft there are measurements alone.
  command=report picture=show.svg
  grep -q '^\[shaft\]' "$case/case.toml" || { command=weights picture=weights.svg; }
  if ! text="$("$whirl" "$command" "$case" --out "$folder/$name" 2> "$folder/$name.errors")"; then
    echo "gallery: $name: $(head -1 "$folder/$name.errors")" >&2
    failed=1
    continue
  fi
  rm "$folder/$name.errors"
  [[ "$command" == weights ]] || "$whirl" show "$case" --out "$folder/$name/show" --quiet
  [[ "$command" == weights ]] || picture="show/$picture"
  title="$(head -1 <<< "$text" | escaped)"
  verdict="$(sed -n 2p <<< "$text" | escaped)"
  printf '<a href="%s/report.html"><img src="%s/%s" alt="" loading="lazy"><h2>%s</h2><p>%s</p><p>%s</p></a>\n' \
    "$name" "$name" "$picture" "$title" "$verdict" "$name" >> "$page"
  echo "gallery: $name" >&2
done
echo '</main></body></html>' >> "$page"
mv "$page" "$folder/index.html"
chmod 644 "$folder/index.html"
echo "$folder/index.html"
exit "$failed"
