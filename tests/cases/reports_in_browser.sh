#!/bin/sh
# Opens reports in a headless browser: no error on the console, the diagram drawn, tables and contents there.
# usage: reports_in_browser.sh WHIRL CASES SCRATCH; status 77 where no browser is installed
whirl=$1
cases=$2
scratch=$3
for browser in chromium chromium-browser google-chrome none; do
    command -v "$browser" > /dev/null 2>&1 && break
done
if [ "$browser" = none ]; then
    echo "no browser is installed"
    exit 77
fi
rm -rf "$scratch"
mkdir -p "$scratch"
failed=0
look() { # name of the folder, arguments of whirl: in the usual units, and with others asked for
    name=$1
    shift
    look_at "$scratch/$name" "$@"
    look_at "$scratch/${name}_us" "$@" --units us --peak-to-peak
}
look_at() { # folder, arguments of whirl
    out=$1
    shift
    if ! "$whirl" "$@" --quiet --out "$out"; then
        echo "$out: whirl $* failed"
        failed=1
        return
    fi
    "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$scratch/profile" --enable-logging=stderr --dump-dom \
        "file://$out/report.html" > "$out/dom.html" 2> "$out/log"
    if grep -E 'CONSOLE.*(Error|error|Uncaught)|Uncaught' "$out/log"; then
        echo "$out: an error on the console"
        failed=1
    fi
    for wanted in 'href="#section-1"' 'aria-sort='; do
        grep -q "$wanted" "$out/dom.html" || { echo "$out: no $wanted"; failed=1; }
    done
    # Where the page has a place for the diagram, it must be drawn.
    if grep -q '<div id="plot"' "$out/report.html" && ! grep -q 'class="main-svg"' "$out/dom.html"; then
        echo "$out: the diagram was not drawn"
        failed=1
    fi
    # Shapes in space: as many as there are modes, each with all its lines.
    if grep -q '<div id="space"' "$out/report.html"; then
        drawn=$(grep -o 'aria-label="Mode [0-9ce]' "$out/dom.html" | wc -l)
        wanted=$(grep -c '"x_real"' "$out/modes.json")
        [ "$drawn" = "$wanted" ] || { echo "$out: $drawn of $wanted shapes drawn in space"; failed=1; }
        if grep -qE 'points="[^"]*(NaN|Infinity)' "$out/dom.html"; then
            echo "$out: a shape in space without places"
            failed=1
        fi
    fi
}
# A script at the end of a page: what it writes into the attribute data-found must be "true".
ask() { # name of the folder, what is asked in words, script
    page=$scratch/$1/asked.html
    sed '$d' "$scratch/$1/report.html" > "$page" # the last line: </html>
    printf '<script>%s</script></html>\n' "$3" >> "$page"
    "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$scratch/profile" --virtual-time-budget=10000 --dump-dom \
        "file://$page" 2> /dev/null | grep -q 'data-found="true"' || { echo "$scratch/$1: not so: $2"; failed=1; }
}
jeffcott=$cases/runup_jeffcott
look show show "$cases/nelson_mcvaugh"
look campbell campbell "$cases/friswell_5_9_5" --set speeds.count=11
look critical critical "$cases/friswell_5_9_2"
look stability stability "$cases/keyway_shaft" --set speeds.count=11
look response response "$jeffcott" --set speeds.count=11
look gravity response "$cases/keyway_gravity" --set speeds.count=11
look forces response "$cases/harmonic_forces" --set speeds.count=11
look balance balance "$cases/pendulum_planar" --set speeds.count=11 --set balance.balanced_position=false
look rigid-limit rigid-limit "$cases/rigid_limit"
look simulate simulate "$jeffcott" --set speeds.count=1 --set simulate.time=13
look balls simulate "$cases/rodrigues_two_plane" --set simulate.time=0.5
ask balls "amplitudes at the balancers stand above the angles of the balls" '
    const layout = document.getElementById("plot").layout;
    document.body.setAttribute("data-found", layout.yaxis.domain[0] >= layout.yaxis2.domain[1]);'
look samples samples "$cases/uncertain_jeffcott" --set samples.count=12
look modes modes "$cases/friswell_5_9_2"
ask modes "a zoom of one mode's diagram is one of all" '
    const panes = Array.from(document.querySelectorAll("#plot .panel")), ranges = () => panes.map(p => p.layout.xaxis.range.join());
    Plotly.relayout(panes[1], {"xaxis.range[0]": 0.1, "xaxis.range[1]": 0.2}).then(() => setTimeout(() => {
      const zoomed = panes.length > 1 && ranges().every(r => r === "0.1,0.2");
      Plotly.relayout(panes[0], {"xaxis.autorange": true}).then(() => setTimeout(() => {
        document.body.setAttribute("data-found", zoomed && ranges().every(r => r === ranges()[0] && r !== "0.1,0.2"));
      }, 500));
    }, 500));'
look modes_of_balls modes "$cases/extractor_two_plane"
# On paper nothing of a diagram is cut off: what stands at its right end is on the page.
if command -v pdftotext > /dev/null 2>&1; then
    "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$scratch/profile" --virtual-time-budget=5000 \
        --print-to-pdf="$scratch/campbell/report.pdf" "file://$scratch/campbell/report.html" 2> /dev/null
    pdftotext -bbox "$scratch/campbell/report.pdf" "$scratch/campbell/words.html"
    # The last number above the words "Spin speed" stands past the middle of the page, and right of it the legend,
    # which ends on the page.
    awk -F'"' '/<page /{wide = $2} /<word /{
            text = $0; gsub(/<[^>]*>/, "", text); gsub(/[ \t]/, "", text)
            left[++words] = $2; right[words] = $6; top[words] = $4; what[words] = text
        } END {
            for (i = 1; i <= words; ++i) if (what[i] == "Spin" && !legend)
                for (k = 1; k < i; ++k)
                    if (what[k] ~ /^[0-9]+$/ && top[k] < top[i] && top[k] > top[i] - 25 && right[k] > last) last = right[k]
                    else if (what[k] == "backward" && left[k] > legend) legend = left[k]
                    else if (what[k] == "damped" && top[k] > 60 && right[k] > end) end = right[k]
            exit !(last > 0.55 * wide && last < legend && end > 0.75 * wide && end < wide)
        }' "$scratch/campbell/words.html" ||
        { echo "$scratch/campbell: the diagram does not fill the paper, or is cut off"; failed=1; }
fi
look compare compare critical "$jeffcott" "$jeffcott@bearing[*].k=1e5"
exit $failed
