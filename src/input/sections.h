#pragma once

#include "input/checked_table.h"
#include "input/size.h"
#include "model/case.h"

#include <complex>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace whirl::input {

/// Materials of a case by name; a modulus or density that was wrong is nan.
using Materials = std::map<std::string, model::Material>;

/// Reads [material.*]: E, rho, and G or nu (both: they must agree within 1e-3, and G counts).
[[nodiscard]] Materials read_materials(CheckedTable &root);

/// The one that the entry `material` of a table names, or without that entry the only one there
/// is; an empty one and a mistake where that does not say which.
[[nodiscard]] model::Material material_of(CheckedTable &table, const Materials &materials);

/// Reads [shaft] with its segments or its station table. A shaft without segments is one that had
/// mistakes, which are collected.
[[nodiscard]] model::Shaft read_shaft(CheckedTable &root, const Materials &materials);

/// Reads [[disc]], [[bearing]] and so on into the rotor; the shaft must be there already.
void read_discs(CheckedTable &root, const Materials &materials, model::Rotor &rotor);
void read_bearings(CheckedTable &root, model::Rotor &rotor);
void read_seals(CheckedTable &root, model::Rotor &rotor); ///< after the bearings
void read_anisotropies(CheckedTable &root, model::Rotor &rotor);
void read_balancers(CheckedTable &root, model::Rotor &rotor);
void read_planes(CheckedTable &root, model::Rotor &rotor);
/// Rules for imbalances want the mass of the rotor and [speeds]: both must be there.
void read_imbalances(CheckedTable &root, model::Case &scene);
void read_forces(CheckedTable &root, model::Rotor &rotor);
void read_probes(CheckedTable &root, model::Rotor &rotor);

/// Read a section of that name; last [map], [samples] and [sweep], which may name any numeric entry
/// read before.
void read_speeds(CheckedTable &table, model::Case &scene);
void read_units(CheckedTable &table, model::Case &scene);
void read_critical_map(CheckedTable &table, model::Case &scene); ///< the bearings must be there
void read_operation(CheckedTable &table, model::Case &scene);
void read_limits(CheckedTable &table, model::Case &scene);
void read_level1(CheckedTable &table, model::Case &scene);
void read_standard(CheckedTable &table, model::Case &scene); ///< bearings and balancers are there
void read_campbell(CheckedTable &table, model::Case &scene);
void read_modes(CheckedTable &table, model::Case &scene);
void read_response(CheckedTable &table, model::Case &scene);
void read_simulate(CheckedTable &table, model::Case &scene);
void read_balance(CheckedTable &table, model::Case &scene);
void read_states(CheckedTable &table, model::Case &scene);
void read_map(CheckedTable &table, model::Case &scene);
void read_samples(CheckedTable &table, model::Case &scene);
void read_sweep(CheckedTable &table, model::Case &scene);

/// Reads [weights], the tables it names and [[trial]]; planes and probes must be there.
void read_weights(CheckedTable &root, model::Case &scene);
/// `mr`, or `mass` at the radius of the plane, and `phase`, as a complex number, kg m.
[[nodiscard]] std::complex<double> read_weight(CheckedTable &table,
                                               const std::optional<double> &radius);
/// A case of measurements alone: it has [weights] and no [shaft].
[[nodiscard]] bool measured_alone(CheckedTable &root);
/// Grade of a text such as "G 2.5" or of a number, mm/s; empty with a mistake.
[[nodiscard]] std::optional<double> read_grade(CheckedTable &table);

/// Reads of [simulate] what acts on the rotor from outside, and how it starts: start,
/// [[simulate.imbalance]], [[simulate.force]], [simulate.base]. The rotor must be there already.
void read_outside(CheckedTable &simulate, model::Case &scene);

/// Numbers of a case that a path speaks of in the words of --set: one, or those of several items.
struct NumericEntries {
    std::vector<std::string> paths; ///< with the index of every item
    Quantity quantity = Quantity::number;
};

/// The support that an entry names by its place (from 0) or its name; none with a mistake.
[[nodiscard]] std::optional<std::size_t> support_of(const CheckedEntry &entry,
                                                    const model::Rotor &rotor);

/// What the entry `path` of a table of [map], [samples] or [sweep] names: all that --set can set to
/// a number, whether the case gives it or leaves it at its default. None, with a mistake, where it
/// is nothing of that kind.
/// @param besides  a word that may stand for one: "speed", or empty
[[nodiscard]] std::optional<NumericEntries>
numeric_entries(CheckedTable &table, const std::string &path, const std::string &besides);

/// An axis of [map]: entries that change together as those of [sweep], or the spin speed, over
/// evenly spaced values.
/// @param rotor  whose dimensionless numbers the values may be of
[[nodiscard]] model::SweepAxis read_map_axis(CheckedTable &table, const model::Rotor &rotor);
/// A mistake where axes change the same entry.
void refuse_twice(CheckedTable &table, const std::vector<model::SweepAxis> &axes);

/// The value that the case gives all of the entries. NaN where one is no number, which is told
/// where it stands; none where one is not given, or they differ.
[[nodiscard]] std::optional<double> value_in_case(const NumericEntries &entries, const Node &tree);

/// Which answers [samples] or [sweep] wants: `of` and `at`.
void read_wanted(CheckedTable &table, const model::Case &scene, model::WantedAnswers &wanted);

/// Reads all of a case, the last [map], [samples] and [sweep].
[[nodiscard]] model::Case read_case(CheckedTable &root);

} // namespace whirl::input
