#include "assembly/hill_system.h"

#include "assembly/planes.h"

#include <algorithm>
#include <cstdlib>

namespace whirl::assembly {

namespace {

/// A component of the series: the constant one (harmonic 0), a cosine or a sine.
struct Component {
    int harmonic = 0;
    bool sine = false;

    [[nodiscard]] int block() const { return harmonic == 0 ? 0 : 2 * harmonic - (sine ? 0 : 1); }
};

class HillEntries {
  public:
    /// @param weight  of the rows of cosines and sines
    HillEntries(int size, int harmonics, double weight = 1)
        : _size(size), _harmonics(harmonics), _weight(weight) {}

    void add(Component row, Component column, double factor, const linalg::Matrix &block) {
        const bool vanishes = row.harmonic == 0 && row.sine;
        if (factor == 0 || vanishes || row.harmonic > _harmonics)
            return;
        const double weighted = row.harmonic == 0 ? factor : _weight * factor;
        const linalg::SparseView view = block.view();
        for (int i = 0; i < _size; ++i)
            for (linalg::SparseView::InnerIterator it(view, i); it; ++it)
                if (it.value() != 0)
                    _entries.emplace_back(row.block() * _size + static_cast<int>(it.row()),
                                          column.block() * _size + static_cast<int>(it.col()),
                                          weighted * it.value());
    }

    /// The pair (cosine, sine) of matrices times the component `source` of a series whose
    /// amplitude is `factor` times the unknown `column`.
    void add_product(const PeriodicSupports::Pair &pair, Component source, Component column,
                     double factor) {
        const int k = source.harmonic;
        if (k == 0) {
            add({1, false}, column, factor, pair.cosine);
            add({1, true}, column, factor, pair.sine);
            return;
        }
        // cos a cos b, cos a sin b, sin a cos b, sin a sin b as sums of angles.
        add({k - 1, source.sine}, column, factor / 2, pair.cosine);
        add({k + 1, source.sine}, column, factor / 2, pair.cosine);
        add({k - 1, !source.sine}, column, source.sine ? factor / 2 : -factor / 2, pair.sine);
        add({k + 1, !source.sine}, column, source.sine ? -factor / 2 : factor / 2, pair.sine);
    }

    [[nodiscard]] linalg::Matrix matrix() const {
        return linalg::Matrix::from_entries(_size * (2 * _harmonics + 1), _entries);
    }

  private:
    int _size;
    int _harmonics;
    double _weight;
    std::vector<Eigen::Triplet<double>> _entries;
};

} // namespace

SystemAtSpeed hill_system(const RotatingSystem &system, const PeriodicSupports &supports,
                          double speed, int harmonics) {
    const linalg::Matrix D = system.damping(speed);
    const linalg::Matrix K = system.stiffness(speed);
    const PeriodicSupports::Pair turning_K{
        linalg::Matrix::sum(1, supports.K.cosine, speed, supports.Ks.cosine),
        linalg::Matrix::sum(1, supports.K.sine, speed, supports.Ks.sine)};
    const int n = K.size();
    HillEntries into_M(n, harmonics);
    HillEntries into_D(n, harmonics);
    HillEntries into_K(n, harmonics);
    for (int k = 0; k <= harmonics; ++k) {
        const double w = 2 * k * speed;
        for (const bool sine : {false, true}) {
            if (k == 0 && sine)
                continue;
            const Component self{k, sine};
            const Component other{k, !sine};
            // The rate of a cosine l a + w b, of a sine l b - w a: seen from the unknown `self`,
            // its own rate gets l and the other one -+ w.
            const double across = sine ? w : -w;
            into_M.add(self, self, 1, system.M);
            into_D.add(self, self, 1, D);
            into_K.add(self, self, 1, K);
            into_K.add(self, self, -w * w, system.M);
            into_D.add(other, self, 2 * across, system.M);
            into_K.add(other, self, across, D);
            into_K.add_product(turning_K, self, self, 1);
            into_D.add_product(supports.C, self, self, 1);
            if (k > 0)
                into_K.add_product(supports.C, other, self, across);
        }
    }
    return {into_M.matrix(), into_D.matrix(), into_K.matrix()};
}

PeriodicStiffness periodic_stiffness(const RotatingSystem &system, const PeriodicSupports &supports,
                                     int harmonics) {
    const int n = system.K.size();
    HillEntries into_K(n, harmonics, 0.5);
    HillEntries into_Ks(n, harmonics, 0.5);
    HillEntries into_Kss(n, harmonics, 0.5);
    for (int k = 0; k <= harmonics; ++k)
        for (const bool sine : {false, true}) {
            if (k == 0 && sine)
                continue;
            const Component self{k, sine};
            const Component other{k, !sine};
            const double across = sine ? 2 * k : -2 * k; // rates over the speed, as above
            into_K.add(self, self, 1, system.K);
            into_K.add_product(supports.K, self, self, 1);
            into_Ks.add(self, self, 1, system.Ks);
            into_Ks.add(other, self, across, system.C);
            into_Ks.add_product(supports.Ks, self, self, 1);
            if (k > 0)
                into_Ks.add_product(supports.C, other, self, across);
            into_Kss.add(self, self, 1, system.Kss);
            into_Kss.add(self, self, -4.0 * k * k, system.M);
            into_Kss.add(other, self, across, system.Cs);
        }
    return {into_K.matrix(), into_Ks.matrix(), into_Kss.matrix()};
}

Eigen::MatrixXcd hill_terms(const Eigen::VectorXcd &vector, Eigen::Index size) {
    const Eigen::Index harmonics = (vector.size() / size - 1) / 2;
    Eigen::MatrixXcd out(size, 2 * harmonics + 1);
    out.col(harmonics) = vector.head(size);
    for (Eigen::Index k = 1; k <= harmonics; ++k) {
        const auto a = vector.segment((2 * k - 1) * size, size);
        const auto b = vector.segment(2 * k * size, size);
        out.col(harmonics + k) = (a - i_unit * b) / 2;
        out.col(harmonics - k) = (a + i_unit * b) / 2;
    }
    return out;
}

Eigen::MatrixXcd middle_terms(const Eigen::MatrixXcd &terms, Eigen::Index columns) {
    Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(terms.rows(), columns);
    const Eigen::Index few = std::min(columns, terms.cols());
    out.middleCols((columns - few) / 2, few) = terms.middleCols((terms.cols() - few) / 2, few);
    return out;
}

Eigen::MatrixXcd moved_terms(const Eigen::MatrixXcd &terms, Eigen::Index places) {
    Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(terms.rows(), terms.cols());
    const Eigen::Index kept = std::max<Eigen::Index>(0, terms.cols() - std::abs(places));
    out.middleCols(kept > 0 ? std::max<Eigen::Index>(0, -places) : 0, kept) =
        terms.middleCols(kept > 0 ? std::max<Eigen::Index>(0, places) : 0, kept);
    return out;
}

} // namespace whirl::assembly
