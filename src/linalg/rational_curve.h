#pragma once

#include <Eigen/Core>

#include <complex>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace whirl::linalg {

/// Many functions of a real variable that have their poles in common, as all deflections of a rotor
/// over the spin speed: rational functions through values that someone solves for. They are
/// interpolated in barycentric form with one set of weights (the AAA algorithm: Nakatsukasa, Sete,
/// Trefethen, SIAM J. Sci. Comput. 40 (2018), A1494), and solved for at more places until what they
/// say beforehand is confirmed everywhere in between.
class RationalCurve {
  public:
    struct Values {
        /// A row a quantity, whose norm is its size; columns that one place has less than another
        /// are zero.
        Eigen::MatrixXcd numbers;
        Eigen::VectorXd rounding; ///< of each quantity
    };
    /// The values at a place; nothing where there is no solution.
    using Solve = std::function<std::optional<Values>(double)>;

    /// Functions with so many poles that the places do not do are left as they are then: misfit().
    /// @param enough  misfit at new places, relative to the size of a quantity, that is accepted
    ///                beyond rounding
    /// @param most    places
    /// @throws SolverError where nothing is solved, or eigenvalues do not converge
    RationalCurve(double from, double to, Solve solve, double enough, std::size_t most = 150);

    [[nodiscard]] double from() const { return _from; }
    [[nodiscard]] double to() const { return _to; }

    /// The interpolated values.
    [[nodiscard]] Eigen::MatrixXcd at(double place) const { return with_slope(place).first; }
    /// Their derivatives.
    [[nodiscard]] Eigen::MatrixXcd slope(double place) const { return with_slope(place).second; }
    [[nodiscard]] std::pair<Eigen::MatrixXcd, Eigen::MatrixXcd> with_slope(double place) const;
    /// Where the functions have no limit: complex places about the range; those far off are what
    /// the sum of all others looks like from it.
    [[nodiscard]] const std::vector<std::complex<double>> &poles() const { return _poles; }
    /// Largest misfit at places when they were solved for last, relative to the size of a quantity.
    [[nodiscard]] double misfit() const { return _misfit; }
    /// It is what was asked for, or what rounding of the values leaves: small, and more places make
    /// it no less.
    [[nodiscard]] bool settled() const { return _settled; }
    /// Solves at these places too. @returns the largest misfit that was there
    double take_in(const std::vector<double> &places);
    /// The values of a quantity are, by their geometric mean, no more than what rounding leaves.
    [[nodiscard]] bool only_rounding(std::size_t quantity) const;

  private:
    double _from, _to;
    Solve _solve;
    double _enough;
    std::map<double, Values> _solved; ///< by place
    std::set<double> _none;           ///< places without a solution
    std::vector<double> _support;     ///< where the functions are interpolated
    Eigen::VectorXcd _weights;        ///< of the support
    Eigen::MatrixXcd _values;         ///< there: a column each, numbers of all quantities
    std::vector<std::complex<double>> _poles;
    double _misfit = 0;
    bool _settled = false;

    bool solve(double place);
    void fit();
    void find_poles(const Eigen::VectorXd &usual);
    [[nodiscard]] std::complex<double> refined_pole(std::complex<double> pole) const;
    [[nodiscard]] bool felt(std::complex<double> pole, const Eigen::VectorXd &usual) const;
    [[nodiscard]] Eigen::VectorXcd weights(const std::vector<double> &others,
                                           const Eigen::MatrixXcd &mixed,
                                           const std::vector<double> &places) const;
    [[nodiscard]] std::vector<double> places_between() const;
};

} // namespace whirl::linalg
