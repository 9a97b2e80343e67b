#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

namespace whirl::closed_form {

/// Monodromy matrix of z' = S(t) z over one period: Gauss-Legendre collocation with four stages
/// (order 8, A-stable; Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.7),
/// equal steps.
[[nodiscard]] Eigen::MatrixXd
monodromy_matrix(const std::function<Eigen::MatrixXd(double)> &state_matrix, double period,
                 int steps);

/// Floquet multipliers, eigenvalues of the monodromy matrix; stable where all moduli are below one.
[[nodiscard]] std::vector<std::complex<double>>
floquet_multipliers(const std::function<Eigen::MatrixXd(double)> &state_matrix, double period,
                    int steps);

} // namespace whirl::closed_form
