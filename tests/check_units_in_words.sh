#!/bin/sh
# The words of sentences, headings and labels name no units: a number and its unit are written together, in the units
# that were asked for (model/quantity.h, report/common/units.h). Strings that do and may are listed below, each with the
# reason; one that is listed and is nowhere any more fails too. src/input and src/cli are left out: they speak of the
# units in which numbers are read.
# usage: check_units_in_words.sh ROOT
cd "$1" || exit 2
exec perl - $(find src -name '*.cpp' -o -name '*.h' -o -name '*.js' | sort) << 'EOF'
use strict;
use utf8;
binmode(STDOUT, ":utf8");
my @units = ("rad/s", "rpm", "r/min", "cycles/min", "Hz", "kHz", "cpm", "m", "mm", "cm", "um", "µm", "mil", "mils", "inch",
    "kg", "g", "lb", "N", "kN", "lbf", "N/m", "N/mm", "kN/mm", "lbf/in", "N s/m", "N m", "Nm", "kg m2", "kg m²", "kg m",
    "g mm", "oz in", "s", "ms", "1/s", "1/kg", "J", "W", "Pa", "MPa", "GPa", "m/s", "m/s2", "m/s²", "kg/m3", "rad", "deg");
my $unit = join "|", map { quotemeta } @units;
# The two tables that units are written from.
my %tables = map { $_ => 1 } ("src/model/quantity.cpp", "src/report/common/units.cpp");
my @allowed = (
    # file, part of the string (all of it, where it is short), reason
    ["src/report/vtk.cpp", "critical {}{} at", "the file for ParaView is in SI whatever is asked for"],
    ["src/report/pictures/scene.cpp", "z (mm)", "numbers of the axis are made for it: small rotors where no length is asked for"],
    ["src/report/pictures/campbell.cpp", "Whirl frequency (cycles/min)", "second axis where no unit is asked for"],
    ["src/report/accuracy.cpp", "ms", "wall times, which no entry of [units] changes"],
    ["src/report/accuracy.cpp", "Wall time (ms)", "the same"],
    ["src/report/show.cpp", "m", "dimensionless masses of a paper"],
    ["src/model/sweep.h", "m", "the same"],
    ["src/rigid/composite_rotor.cpp", "m", "the same"],
    ["src/report/restart_file.cpp", "{}, expected ", "mistakes of a file, which is in SI"],
    ["src/report/common/plot_jobs.cpp", "within {} s", "a limit of gnuplot's patience"],
    ["src/criterion/pendulum.cpp", "expected a radius above 0 m", "mistakes of a case, in the SI of its keys"],
    ["src/criterion/rotor.cpp", "expected spin speeds", "the same"],
    ["src/balancers/balanced_position.cpp", "than all others and the imbalance {} kg m", "the same"],
    ["src/simulation/restart.cpp", "where the interrupted run stopped", "the same"],
    ["src/simulation/equations.cpp", "expected a time in s", "the same"],
    ["src/simulation/dry/dry_scene.cpp", "{}balls that do not overlap", "the same"],
    ["src/simulation/dry/dry_scene.cpp", "{}balls beside the walls", "the same"],
    ["src/model/case.cpp", "expected a section [speeds], as from", "an entry as it may be written"],
    ["src/simulation/equations.cpp", "expected something that moves the rotor", "the same"],
    ["src/analyses/weights.cpp", "expected a section [weights]", "the same"],
    ["src/analyses/modes.cpp", "expected a spin speed, as --speed", "the same"],
    ["src/analyses/response.cpp", "expected at least one [[imbalance]]", "the same"],
    ["src/balancers/ring.cpp", "m e/(m0 R0)", "a formula"],
    ["src/balancers/ball.cpp", "m R/(m0 R0)", "a formula"],
    ["src/balancers/pendulum4.cpp", "m arm/(m0 R0)", "a formula"],
    ["src/report/pictures/composite.cpp", "n m / M_s", "a formula"],
    ["src/report/pictures/labels.cpp", "s", "plural"],
    ["src/linalg/", "N", "LAPACK's letters"],
    ["src/report/common/drawing.cpp", "\$s{}", "a name in a script"],
);
my $bad = 0;
my @used;
for my $file (@ARGV) {
    next if $tables{$file} or $file =~ m{^src/(input|cli)/};
    open(my $handle, "<:utf8", $file) or die "$file: $!";
    local $/;
    my $text = <$handle>;
    $text =~ s{^\s*#include.*$}{}mg;
    # Comments, raw strings, strings in pieces, letters.
    while ($text =~ m{(//[^\n]*)|(/\*.*?\*/)|R"(\w*)\((.*?)\)\3"|"((?:[^"\\\n]|\\.)*)"((?:\s*"(?:[^"\\\n]|\\.)*")*)|'(?:[^'\\\n]|\\.)+'}gs) {
        next if defined $1 or defined $2;
        my $string = defined $4 ? $4 : defined $5 ? $5 : next;
        my $more = $6 // "";
        my $line = 1 + (substr($text, 0, $-[0]) =~ tr/\n//);
        $string .= $1 while $more =~ m{"((?:[^"\\\n]|\\.)*)"}g;
        (my $words = $string) =~ s{\{[^{}]*(\{\}[^{}]*)?\}|%[-.*\d\{\}]*[a-z]}{#}g; # places of values
        $words =~ s{\\n}{ }g;
        next unless $words =~ m{(?<![\w./'])(?:$unit)(?![\w/²³.'-])};
        my ($reason) = grep { my $a = $allowed[$_]; index($file, $a->[0]) == 0 and (length($a->[1]) > 2 ? index($string, $a->[1]) >= 0 : $string eq $a->[1]) } 0 .. $#allowed;
        if (defined $reason) {
            $used[$reason] = 1;
            next;
        }
        print "$file:$line: a unit in words: \"$string\"\n";
        $bad = 1;
    }
}
for (0 .. $#allowed) {
    next if $used[$_];
    print "$allowed[$_][0]: nothing needs \"$allowed[$_][1]\" any more\n";
    $bad = 1;
}
exit $bad;
EOF
