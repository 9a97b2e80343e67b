#pragma once

#include "broken_case.h"

namespace whirl::tests {

/// Mistakes in correction weights and their tables.
inline std::vector<BrokenCase> broken_weights() {
    // Lines 1 to 3, planes on 4 to 7; what is added starts on line 8.
    const std::string start = "format = 1\n[weights]\nreadings = \"r.csv\"\n"
                              "[[plane]]\nname = \"a\"\n[[plane]]\nname = \"b\"\n";
    const std::string one = "format = 1\n[weights]\nreadings = \"r.csv\"\n"
                            "[[plane]]\nname = \"a\"\n"; // next is line 6
    const std::string trial = "[[trial]]\nrun = \"t\"\nplane = \"a\"\nmr = 1e-4\n";
    const std::string head = "speed,probe,run,amplitude [um],phase [deg]\n";
    const std::string initial = head + "100,p,initial,5,10\n"; // next is line 3
    const std::string both = initial + "100,p,t,6,20\n";
    const auto readings = [](const std::string &text) {
        return std::vector<std::pair<std::string, std::string>>{{"r.csv", text}};
    };
    const std::string table = "speed,probe,plane,amplitude [um/(g mm)],phase [deg]\n";
    const std::string of_table = "format = 1\n[weights]\nreadings = \"r.csv\"\n"
                                 "influence = \"i.csv\"\n[[plane]]\nname = \"a\"\n";
    const auto with_table = [&](const std::string &text) {
        return std::vector<std::pair<std::string, std::string>>{{"r.csv", initial},
                                                                {"i.csv", text}};
    };
    const std::string base = sound_case; // next is line 8
    return {
        {"weights without planes", 1, "plane", "expected at least one [[plane]]",
         base + "[weights]\n"},
        {"weights of a plane without a name", 4, "plane[0].name", "missing, expected a name",
         "format = 1\n[weights]\nreadings = \"r.csv\"\n[[plane]]\nz = 1\n[[plane]]\nname = "
         "\"a\"\n" +
             trial,
         readings(both)},
        {"weights of a plane named twice", 7, "plane[1].name", "each name once, got \"a\" twice",
         one + "[[plane]]\nname = \"a\"\n" + trial, readings(both)},
        {"weights without readings", 2, "weights.readings", "missing, expected a table of readings",
         "format = 1\n[weights]\n[[plane]]\nname = \"a\"\n"},
        {"weights of a table that is not there", 3, "weights.readings",
         "r.csv: there is no such file", one + trial},
        {"weights by another method", 3, "weights.method", "\"least-squares\" or \"minimax\"",
         "format = 1\n[weights]\nmethod = \"mini-max\"\nreadings = \"r.csv\"\n"
         "[[plane]]\nname = \"a\"\n" +
             trial,
         readings(both)},
        {"stock for planes without a radius", 4, "weights.stock", "a [[plane]] with a radius",
         "format = 1\n[weights]\nreadings = \"r.csv\"\nstock = [0.01]\n"
         "[[plane]]\nname = \"a\"\n" +
             trial,
         readings(both)},
        {"readings without a column", 1, "run", "expected a column of that name", one + trial,
         readings("probe,amplitude,phase\np,1,2\n"), "r.csv"},
        {"reading that is no number", 2, "amplitude", "expected an amplitude in m", one + trial,
         readings(head + "100,p,initial,NaN,10\n100,p,t,6,20\n"), "r.csv"},
        {"reading of negative amplitude", 2, "amplitude", "0 or more, got \"-5\"", one + trial,
         readings(head + "100,p,initial,-5,10\n100,p,t,6,20\n"), "r.csv"},
        {"reading of an unknown run", 4, "run", "did you mean \"t\"?", one + trial,
         readings(both + "100,p,tt,6,20\n"), "r.csv"},
        {"readings without an initial run", 1, "run", "expected readings of the run \"initial\"",
         one + trial, readings(head + "100,p,t,6,20\n"), "r.csv"},
        {"readings without a trial run", 1, "run", "got none of \"t\" for probe \"p\" at 100 rad/s",
         one + trial, readings(initial), "r.csv"},
        {"trial at another speed", 4, "speed", "has a reading of the run \"initial\"", one + trial,
         readings(both + "101,p,t,6,20\n"), "r.csv"},
        {"readings from peak to peak, coefficients of who knows what",
         1,
         "amplitude",
         "expected a unit that says how the vibration was read",
         of_table,
         {{"r.csv", "speed,probe,run,amplitude [um pk-pk],phase [deg]\n100,p,initial,5,10\n"},
          {"i.csv", table + "100,p,a,1,2\n"}},
         "i.csv"},
        {"coefficients from peak to peak, readings of who knows what",
         1,
         "amplitude",
         "expected a unit that says how the vibration was read",
         of_table,
         {{"r.csv", initial},
          {"i.csv", "speed,probe,plane,amplitude [um pk-pk/(g mm)],phase [deg]\n100,p,a,1,2\n"}},
         "r.csv"},
        {"trial at nearly the same speed", 4, "speed", "the nearest is 100 rad/s (954.9297 rpm)",
         one + trial, readings(both + "101,p,t,6,20\n"), "r.csv"},
        {"trial in an unknown plane", 8, "trial[0].plane", "did you mean \"a\"?",
         one + "[[trial]]\nrun = \"t\"\nplane = \"aa\"\nmr = 1e-4\n" + trial, readings(both)},
        {"trial of no weight", 9, "trial[0].mr", "other than 0",
         one + "[[trial]]\nrun = \"t\"\nplane = \"a\"\nmr = 0\n", readings(both)},
        {"trial of a mass without a radius", 9, "trial[0].mass", "the plane has no radius",
         one + "[[trial]]\nrun = \"t\"\nplane = \"a\"\nmass = 0.1\n", readings(both)},
        {"trial in the initial run", 7, "trial[0].run", "expected a run with trial weights",
         one + "[[trial]]\nrun = \"initial\"\nplane = \"a\"\nmr = 1e-4\n" + trial, readings(both)},
        {"plane that was never tried", 6, "plane[1]", "its influence is not known", start + trial,
         readings(both)},
        {"weights without coefficients", 2, "weights.influence", "missing, expected a table of",
         one, readings(initial)},
        {"trials without weights", 8, "trial", "expected a section [weights]", base + trial},
        {"factor of an unknown probe", 7, "weights.probe.q", "expected the name of a probe",
         "format = 1\n[weights]\nreadings = \"r.csv\"\n[[plane]]\nname = \"a\"\n"
         "[weights.probe]\nq = 2\n" +
             trial,
         readings(both)},
        {"trials and coefficients",
         4,
         "weights.influence",
         "got both",
         of_table + trial,
         {{"r.csv", both}, {"i.csv", table + "100,p,a,1,2\n"}}},
        {"coefficient of an unknown plane", 3, "plane", "expected the name of a [[plane]]",
         of_table, with_table(table + "100,p,a,1,2\n100,p,z,1,2\n"), "i.csv"},
        {"coefficient given twice", 3, "plane", "each coefficient once", of_table,
         with_table(table + "100,p,a,1,2\n100,p,a,1,2\n"), "i.csv"},
        {"coefficient that is missing", 1, "plane", "got none of plane \"a\" for probe \"p\"",
         of_table, with_table(table + "200,p,a,1,2\n"), "i.csv"},
        {"grade of measurements without a mass", 2, "weights.mass", "missing, expected the mass",
         "format = 1\n[weights]\ngrade = \"G 2.5\"\nreadings = \"r.csv\"\n"
         "[[plane]]\nname = \"a\"\n" +
             trial,
         readings(both)},
        {"plane with one hole", 6, "plane[0].holes", "from 2 to", one + "holes = 1\n" + trial,
         readings(both)},
        {"stations of readings alone", 3, "weights.stations", "got readings alone",
         "format = 1\n[weights]\nstations = [0.1]\nreadings = \"r.csv\"\n"
         "[[plane]]\nname = \"a\"\n" +
             trial,
         readings(both)},
        {"station beside the shaft", 9, "weights.stations[1]", "expected a place on the shaft",
         base + "[weights]\nstations = [0.1, 1.2]\n[[plane]]\nz = 0.5\n"},
        {"rotor made of something else", 9, "weights.body", "expected",
         base + "[weights]\nbody = \"blades\"\n[[plane]]\nz = 0.5\n"},
        {"runout at speeds of others", 4, "run", "expected runout of probe \"p\" at one speed",
         one + trial, readings(both + "20,p,runout,1,0\n30,p,runout,1,0\n"), "r.csv"},
    };
}

} // namespace whirl::tests
