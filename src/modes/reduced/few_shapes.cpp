#include "modes/reduced/few_shapes.h"

#include "assembly/planes.h"
#include "linalg/check.h"
#include "modes/free_motions.h"
#include "reduction/projection.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::modes {

std::unique_ptr<FewShapes> FewShapes::of(const assembly::Discretization &d, int modes) try {
    // A planar mode at rest is two whirl modes; more for what speed brings down.
    const int at_rest = modes / 2 + 3;
    if (d.rigid() || d.planar_size() < 3 * at_rest ||
        free_motions(d, results::Form::general, 0, 0).motions.cols() > 0)
        return nullptr;
    reduction::PlanarShapes shapes(d, 0, at_rest);
    if (2 * shapes.matrix().cols() > d.planar_size())
        return nullptr;
    return std::unique_ptr<FewShapes>(new FewShapes(d, std::move(shapes)));
} catch (const linalg::SolverError &) { // bearings push away
    return nullptr;
}

FewShapes::FewShapes(const assembly::Discretization &d, reduction::PlanarShapes shapes)
    : _shapes(std::move(shapes)), _onto(_shapes.matrix().transpose() * _shapes.metric()),
      _whole(assembly::assemble_fixed(d, 0)),
      _spectrum(d, reduction::Projection(_shapes.matrix()).of(_whole)),
      _matrices(d, _spectrum.system()), _stiffness(_shapes.metric()) {}

Spectrum FewShapes::modes(double speed, int wanted) const {
    Spectrum out = _spectrum.modes(speed, wanted, Errors::of_right_vectors);
    out.keep_lowest(wanted);
    const Eigen::MatrixXd &V = _shapes.matrix();
    for (WhirlMode &mode : out.modes) {
        const assembly::Planes planes(mode.shape);
        mode.shape = assembly::in_pairs(V * planes.x, V * planes.y);
    }
    return out;
}

Eigen::VectorXcd FewShapes::amplitudes(const Eigen::VectorXcd &shape) const {
    const assembly::Planes planes(shape);
    return assembly::in_pairs(_onto * planes.x, _onto * planes.y);
}

double FewShapes::left_out(double speed, const WhirlMode &mode) const {
    const auto times = [](const linalg::Matrix &A, const Eigen::VectorXcd &x) {
        return Eigen::VectorXcd(A.view() * x);
    };
    const std::complex<double> l = mode.eigenvalue;
    const Eigen::VectorXcd &x = mode.shape;
    const Eigen::VectorXcd Mx = times(_whole.M, x);
    const Eigen::VectorXcd r = l * l * Mx + l * (times(_whole.C, x) + speed * times(_whole.G, x)) +
                               times(_whole.K, x) + speed * times(_whole.Kc, x);
    const assembly::Planes planes(r);
    double energy = 0;
    for (const Eigen::VectorXcd *part : {&planes.x, &planes.y})
        for (const Eigen::VectorXd &real :
             {Eigen::VectorXd(part->real()), Eigen::VectorXd(part->imag())})
            energy += real.dot(_stiffness.solve(real));
    return energy / (2 * std::norm(l) * std::abs(x.dot(Mx)));
}

} // namespace whirl::modes
