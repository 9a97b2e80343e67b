# Copies the files named on standard input (separated by NUL) from one root to another, with the faults of a list
# in them, each behind a switch; prints number, name, file and tests of each, with tabs between. What else is in the
# other root, of an earlier list, goes.
# Usage: git ls-files -z | perl seed.pl LIST FROM TO
use strict;
use warnings;
use Digest::MD5 qw(md5_hex);
use File::Basename qw(dirname);
use File::Find qw(find);
use File::Path qw(make_path);

my ($list, $from, $to) = @ARGV;

sub content {
    my ($path) = @_;
    open(my $file, '<:raw', $path) or return undef;
    local $/;
    my $text = <$file>;
    return $text;
}

# Blocks of lines "key: value" with empty lines between. The number of a fault is made of its name, so that another
# one more or less leaves the sources of the rest as they are.
my (%named, %in_file);
for my $block (split /\n\s*\n/, content($list) // die "no $list\n") {
    my %fault;
    for my $line (split /\n/, $block) {
        next if $line =~ /^\s*(#|$)/;
        $line =~ /^(fault|file|from|to|tests):\s*(.*?)\s*$/ or die "$list: not understood: $line\n";
        $fault{$1} = $2;
    }
    next unless %fault;
    defined $fault{$_} or die "$list: a fault without '$_': " . join(' ', %fault) . "\n" for qw(fault file from to tests);
    $fault{number} = hex substr(md5_hex($fault{fault}), 0, 7);
    die "$list: two faults named '$fault{fault}', or of one number\n" if $named{$fault{number}}++;
    push @{$in_file{$fault{file}}}, \%fault;
    print join("\t", @fault{qw(number fault file tests)}), "\n";
}

# Declared in each source that has a fault: sources may be compiled in one piece.
my $switch = <<'END';
#ifndef WHIRL_MUTANT_SWITCH
#define WHIRL_MUTANT_SWITCH
#include <cstdlib>
inline bool whirl_mutant(int number) {
    static const int on = [] {
        const char *text = std::getenv("WHIRL_MUTANT");
        return text ? std::atoi(text) : 0;
    }();
    return on == number;
}
#endif
END

my %copied;
for my $path (split /\0/, do { local $/; <STDIN> }) {
    my $text = content("$from/$path");
    next unless defined $text; # deleted, or a folder
    $copied{"$to/$path"} = 1;
    if (my $faults = delete $in_file{$path}) {
        for my $fault (@$faults) {
            my $count = () = $text =~ /\Q$fault->{from}\E/g;
            $count == 1 or die "$path: '$fault->{from}' stands there $count times, not once ($fault->{fault})\n";
            my $mutated = $fault->{to};
            $mutated =~ s/\bMUTANT\b/whirl_mutant($fault->{number})/g or die "$fault->{fault}: no MUTANT in '$mutated'\n";
            $text =~ s/\Q$fault->{from}\E/$mutated/;
        }
        $text =~ s{\A(#pragma once\n)?}{($1 // "") . $switch}e;
    }
    my $old = content("$to/$path");
    next if defined $old && $old eq $text;
    make_path(dirname("$to/$path"));
    open(my $file, '>:raw', "$to/$path") or die "$to/$path: $!\n";
    print $file $text;
    close $file;
    chmod 0755, "$to/$path" if -x "$from/$path";
}
die "no such file: $_\n" for sort keys %in_file;
find({no_chdir => 1, wanted => sub { unlink if -f && !$copied{$_} }}, $to);
