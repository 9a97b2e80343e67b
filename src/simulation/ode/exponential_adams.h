#pragma once

#include "linalg/lanes/small_products.h"
#include "simulation/ode/adams_weights.h"
#include "simulation/ode/ode_solver.h"

#include <Eigen/Core>

#include <list>
#include <vector>

namespace whirl::simulation {

/// Adams predictor and corrector (Shampine and Gordon: order k in the estimate of the error, k + 1
/// in what goes on, k up to 12) for x' = A x + N(x, y), y' = g(x, y): what A does alone is exact,
/// however fast, and the steps follow what is left. Two evaluations a step.
///
/// Of an OdeProblem whose rates do not depend on time in the turning axes, with its `linear` part.
/// Steps are equal parts of the way to the next stop, so that the differences last over it; they
/// change by halves and doubles on the way and freely at a stop.
class ExponentialAdams : public OdeSolver {
  public:
    explicit ExponentialAdams(OdeProblem problem);

    [[nodiscard]] double next_step() const override { return _h; }
    [[nodiscard]] OdeCounts counts() const override { return _counts; }

  protected:
    void start_in_axes(double t, const double *y, double step) override;
    double step_in_axes(double end) override;
    [[nodiscard]] const double *state_in_axes() const override { return _now.y.data(); }
    [[nodiscard]] const double *within_in_axes(double share) override;

  private:
    static constexpr int most = 12;             ///< order of the estimate
    static constexpr int kept = most + 2;       ///< differences
    static constexpr int remembered = 2 * kept; ///< values, for steps twice as long

    /// A state and what of its rates is not linear.
    struct Point {
        Eigen::VectorXd y;     ///< all entries
        Eigen::VectorXd modal; ///< coordinates of the linear part, `_modes` real parts first
        Eigen::VectorXd n;     ///< N in them, then the rates of the other entries
    };

    /// Weights, real parts above imaginary ones as in Point::modal.
    struct Weights {
        double h;
        Eigen::VectorXd growth;
        Eigen::MatrixXd modal;
        std::vector<double> own;
    };

    Eigen::Index _half;    ///< complex entries of a vector of the axes
    Eigen::Index _modes;   ///< modal coordinates, filled up to whole vectors of the machine
    std::vector<int> _own; ///< entries of y outside the vectors
    linalg::ComplexProduct _vectors, _inverse;
    Eigen::VectorXd _eigenvalues; ///< as Point::modal
    double _reach;                ///< s, longest step that the weights allow
    Point _now, _next;            ///< after a step the one before it is in _next
    Eigen::MatrixXd _differences; ///< backward, of n, a column each
    Eigen::MatrixXd _past;        ///< the last n, in turn
    Eigen::VectorXd _last;        ///< k-th difference with the predicted N
    Eigen::VectorXd _rates, _allowed, _error, _sum;
    Eigen::MatrixXd _stack; ///< all vectors of y, real and imaginary parts
    Eigen::VectorXd _modal_sum;
    Point _between;
    std::list<Weights> _weights; ///< of the steps so far, the present ones first
    std::list<Weights> _within;  ///< of shares of the present step
    double _t = 0;
    double _end = 0;
    double _h = 0;
    double _last_step = 0;
    long _left = 0; ///< steps to _end
    int _order = 1;
    int _valid = 1;      ///< differences that are of equal steps
    int _known = 1;      ///< values that are
    int _newest = 0;     ///< column of the last
    int _good = 0;       ///< steps since one was repeated
    bool _twice = false; ///< the next step is twice as long
    double _factor = 1;  ///< by which the next step might be longer
    OdeCounts _counts;

    [[nodiscard]] bool evaluate(Point &at);
    /// The vectors that these modal coordinates make, into `_stack` and from there to y.
    void compose(const Eigen::VectorXd &modal, Eigen::VectorXd &y);
    void decompose(const Eigen::VectorXd &y, double *modal);
    /// Those of a share of a step h, from the list or new in it, which are the first there then.
    const Weights &weights_of(double h, double share, std::list<Weights> &known) const;
    void aim(double end);
    void change_step(double h);
    void double_step();
    void rescale(double ratio);
    /// growth x + sum of `count` weighted differences, from one point to another.
    void advance(const Weights &w, int count, const Point &from, Point &to);
    void correct();
    [[nodiscard]] double norm(const Weights &w, int order, const Eigen::VectorXd &difference);
    [[nodiscard]] double error(int order);
    void repeat(double error);
    void accept(double error);
    void take_difference();
    void choose_step(double error);
    void choose_order(double error, double lower);
    /// Column of the value so many steps ago.
    [[nodiscard]] int place(int ago) const { return (_newest - ago + remembered) % remembered; }
    [[nodiscard]] const Weights &weights() const { return _weights.front(); }
};

} // namespace whirl::simulation
