#pragma once

#include "assembly/discretization.h"
#include "balancers/arrangement.h"
#include "balancers/linear_element.h"
#include "modes/form_matrices.h"
#include "modes/general_spectrum.h"
#include "modes/hill/floquet_spectrum.h"
#include "modes/orbits.h"
#include "modes/refined_spectrum.h"
#include "modes/rotating/rotating_pencil.h"
#include "modes/rotating/rotating_reduced_rotor.h"
#include "modes/rotating_spectrum.h"
#include "modes/spectrum.h"
#include "modes/symmetric_spectrum.h"
#include "modes/zero_modes.h"
#include "results/formulation.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace whirl::modes {

/// What a SpectrumSolver is made of, for its own sources.
struct SpectrumSolver::Data {
    assembly::Discretization d;
    results::Form form;
    bool tables; ///< bearings change with speed: assemble again at every speed
    Stations stations;
    std::unique_ptr<SymmetricSpectrum> symmetric;
    std::unique_ptr<GeneralSpectrum> general;
    std::vector<balancers::BalancerElement> balancers;
    std::unique_ptr<RotatingSpectrum> rotating;
    std::optional<RotatingReducedRotor::Range> reduced_range; ///< asked for
    std::unique_ptr<RotatingReducedRotor> reduced_rotor; ///< form rotating; none: the whole rotor
    std::unique_ptr<RotatingPencil> pencil;              ///< form rotating
    std::unique_ptr<SpectrumSolver> reduced_solver;      ///< the rotor on those shapes
    std::shared_ptr<const Eigen::MatrixXd> shapes;       ///< this rotor is one on these
    std::unique_ptr<FloquetSpectrum> floquet;            ///< form hill; none: by Hill's series
    std::unique_ptr<periodic::WholeRotor> series;        ///< form hill: single motions
    int refinement;
    bool all_unknowns = false;  ///< damped forms of the fixed frame: no shapes
    bool reduced_roots = false; ///< the same: on shapes alone

    Data(const model::Rotor &rotor, results::Form which, int order, int parts, int harmonics,
         std::shared_ptr<const Eigen::MatrixXd> reduction_basis = nullptr)
        : d(rotor, order, parts), form(which), tables(rotor.bearings_depend_on_speed()),
          stations(Stations::for_orbits(d)), shapes(std::move(reduction_basis)), refinement(parts) {
        if (results::in_rotating_axes(form)) {
            balancers =
                balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor));
            rotating = std::make_unique<RotatingSpectrum>(
                shapes && form == results::Form::rotating
                    ? RotatingSpectrum::rough(d, balancers, *shapes)
                    : RotatingSpectrum(d, 0, balancers, form == results::Form::hill ? harmonics : 0,
                                       shapes.get()));
        }
    }

    /// Made when it is asked for first, as all below are.
    template <class Made, class... Arguments>
    static Made &made(std::unique_ptr<Made> &known, const Arguments &...arguments) {
        if (!known)
            known = std::make_unique<Made>(arguments...);
        return *known;
    }

    /// A form of the fixed frame with the bearings of a speed.
    /// @param planar  of SymmetricSpectrum alone
    template <class Form, class... Planar>
    Form &at_speed(std::unique_ptr<Form> &known, double speed, Planar... planar) {
        if (tables)
            known.reset();
        return made(known, d, planar..., tables ? speed : 0.0);
    }

    /// Modes of zero frequency that free rigid motions can have at a speed; in the fixed frame.
    int most_zero_modes(double speed) {
        if (results::in_rotating_axes(form))
            return 0;
        if (!_zero_modes || tables)
            _zero_modes = static_cast<int>(
                zero_modes(d, form == results::Form::planar_damped ? results::Form::general : form,
                           speed, 0)
                    .modes.size());
        return *_zero_modes;
    }

    /// Form rotating: from now on by a reduced rotor, where one suffices.
    void use_reduced_rotor(RotatingReducedRotor::Range range) {
        if (form != results::Form::rotating || tables ||
            (reduced_range && reduced_range->covers(range)))
            return;
        if (reduced_range)
            range = {std::min(range.from, reduced_range->from),
                     std::max(range.to, reduced_range->to),
                     std::max(range.wanted, reduced_range->wanted)};
        reduced_range = range;
        reduced_solver.reset();
        reduced_rotor = RotatingReducedRotor::of(d, balancers, *rotating, range);
    }

    const FormMatrices &matrices() {
        return shapes ? made(_matrices, d, rotating->system())
                      : made(_matrices, d, form, balancers);
    }

    /// Form planar_damped with motions that are free: found in the real form, in which it is known
    /// which of them creep.
    bool planar_as_real() { return form == results::Form::planar_damped && most_zero_modes(0) > 0; }

    /// Damped forms of the fixed frame.
    RefinedSpectrum &refined() {
        if (planar_as_real())
            return made(_refined, d, made(_general_matrices, d, results::Form::general, balancers));
        return made(_refined, d, matrices());
    }

  private:
    std::optional<int> _zero_modes;
    std::unique_ptr<FormMatrices> _matrices, _general_matrices;
    std::unique_ptr<RefinedSpectrum> _refined;
};

} // namespace whirl::modes
