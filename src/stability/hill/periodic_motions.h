#pragma once

#include "balancers/linear_element.h"
#include "periodic/monodromy.h"
#include "periodic/neutral.h"
#include "periodic/system.h"
#include "periodic/whole_root.h"
#include "reduction/planar_shapes.h"
#include "stability/rotor_at_speeds.h"

#include <Eigen/Core>

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace whirl::stability {

/// A whole rotor whose equations stay periodic, and what it refers to.
struct OwnWholeRotor {
    assembly::Discretization discretization;
    periodic::WholeRotor rotor;

    OwnWholeRotor(const StabilityModel &model, const balancers::Arrangement &arrangement)
        : discretization(model.rotor, model.order),
          rotor(discretization, balancers::balancer_elements(model.rotor, arrangement)) {}
    OwnWholeRotor(const OwnWholeRotor &) = delete; // the rotor refers to the discretization
    OwnWholeRotor &operator=(const OwnWholeRotor &) = delete;
};

/// The reach of motions, and the factor on the usual number of steps in time, as learnt from
/// earlier speeds.
struct StepExperience {
    double density = 1;          ///< over the rule
    double settled_at = 0;       ///< |speed| at which that was seen last, rad/s
    double top = 0;              ///< largest |speed|, rad/s, that the reach is for
    std::map<int, double> reach; ///< frequency of the fastest motions listed, by octaves below it
};

/// Free motions of a rotor whose equations stay periodic in time, by its monodromy matrix.
///
/// Which motions: at every speed those of frequencies up to one bound for an octave of the range,
/// four times its largest speed or more, and of a rigid rotor all. The steps in time are as many as
/// these need, and more until the multipliers do not change any more. Motions up to four times the
/// spin speed may meet: pairs of them resonate at twice and four times the spin speed.
///
/// An elastic rotor is reduced to few planar shapes, to which the shapes of the whole rotor's own
/// motions (whole_root.h) are added wherever its roots differ; the motions that grow most are given
/// as the whole rotor has them.
class PeriodicMotions {
  public:
    /// @param driven  bearings can feed energy into any motion
    /// @param top     largest |speed| that will be asked for, rad/s; 0: not known
    /// @param shapes  planar shapes that are good for the range, or none: they are found
    /// @param experience  of rotors that hardly differ, or none
    PeriodicMotions(const assembly::Discretization &discretization,
                    std::vector<balancers::BalancerElement> balancers, bool driven, double top,
                    std::shared_ptr<const Eigen::MatrixXd> shapes,
                    std::shared_ptr<StepExperience> experience);

    /// @throws linalg::SolverError, model::AnalysisFailure
    [[nodiscard]] std::vector<Motion> at(double speed) const;

    /// All motions of the reduced rotor, with states over its present shapes; at() gives states
    /// over all unknowns, as shapes can be added.
    [[nodiscard]] std::vector<Motion> reduced_at(double speed) const;

    /// Shapes with which every motion at these speeds is that of the whole rotor; none where the
    /// whole rotor is as small.
    [[nodiscard]] std::shared_ptr<const Eigen::MatrixXd>
    good_shapes(const std::vector<double> &speeds) const;

    /// A motion of the reduced rotor and how fast it is, whatever its place on the strip.
    struct Listed {
        Motion motion;
        double frequency = 0; ///< that it is fastest at, rad/s
        Eigen::VectorXcd shape;
    };
    /// The one that grows most; valid until the next call of any of these.
    [[nodiscard]] const Listed &fastest_growing(double speed) const;

    /// Up to this speed some motion that grows most is that of the reduced rotor, as the whole
    /// one's was not found from it, rad/s; 0: none.
    [[nodiscard]] double unconfirmed() const { return _unconfirmed; }

    /// The rotor with all its unknowns, once shapes were looked for; none where it is as small.
    [[nodiscard]] const periodic::WholeRotor *whole() const { return _whole.get(); }

    /// Where the motion that grows most next to the end of a band of the reduced rotor is neutral
    /// in a whole one, of this mesh or another.
    /// @param reach  how far from the end of the reduced one at most, rad/s
    /// @returns nothing where it is not found, or there is no reduced rotor
    [[nodiscard]] std::optional<periodic::Neutral>
    neutral_next_to(double end, double reach, const periodic::WholeRotor *other = nullptr) const;

  private:
    using List = std::vector<Listed>;

    const assembly::Discretization &_discretization;
    std::vector<balancers::BalancerElement> _balancers;
    bool _driven;
    mutable double _top;
    mutable bool _reduced; ///< to shapes of its own
    bool _grows;           ///< was so to begin with
    mutable std::unique_ptr<reduction::PlanarShapes> _planar;
    mutable std::shared_ptr<const Eigen::MatrixXd> _shapes;
    mutable periodic::KeptSystem _system;
    mutable std::map<double, double> _steady_reach; ///< at |speed|, of the fastest steady motions
    std::shared_ptr<StepExperience> _experience;
    mutable std::unique_ptr<periodic::WholeRotor> _whole;
    mutable std::map<double, List> _known; ///< of the reduced rotor, at speeds asked for
    mutable std::map<double, std::vector<Motion>> _corrected; ///< of the whole one

    /// A motion of the whole rotor that the shapes must have.
    struct Wanted {
        std::complex<double> value;
        double noise = 0;
        Eigen::MatrixXd parts; ///< its planar shapes, N x any number
    };
    /// At speeds that the shapes were found to be good for.
    mutable std::map<double, std::vector<Wanted>> _good_at;

    mutable double _unconfirmed = 0;

    void set_top(double speed) const;
    void set_shapes() const;
    void use_planar() const;
    [[nodiscard]] const periodic::System &system(double speed) const;
    [[nodiscard]] double octave_reach(double speed) const;
    [[nodiscard]] double steady_reach(double speed) const;
    [[nodiscard]] double reach(double speed) const;
    [[nodiscard]] int steps(double speed, double reach, double density) const;
    [[nodiscard]] std::vector<periodic::FloquetMotion> settled(double speed, double reach) const;
    [[nodiscard]] List listed(double speed) const;
    [[nodiscard]] const List &known(double speed) const;
    [[nodiscard]] std::optional<periodic::WholeRotor::Root> whole_root(double speed,
                                                                       const Listed &one) const;
    [[nodiscard]] Eigen::MatrixXd planar_parts_above(double part,
                                                     const Eigen::VectorXcd &terms) const;
    /// @param wanted  where to say which of the whole rotor's motions were looked at, or none
    [[nodiscard]] std::optional<List> corrected(double speed, bool all,
                                                std::vector<Wanted> *wanted = nullptr) const;
    void keep_principal() const;
    [[nodiscard]] bool has_wanted() const;
};

} // namespace whirl::stability
