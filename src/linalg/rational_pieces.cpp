#include "linalg/rational_pieces.h"

#include <algorithm>

namespace whirl::linalg {

namespace {

/// Places of one piece: the work of a fit is their cube.
constexpr std::size_t most_of_a_piece = 120;

} // namespace

RationalPieces::RationalPieces(const std::vector<double> &cuts, const RationalCurve::Solve &solve,
                               double enough, std::size_t most)
    : _enough(enough) {
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
        add(cuts[i], cuts[i + 1], solve, most);
}

void RationalPieces::add(double from, double to, const RationalCurve::Solve &solve,
                         std::size_t most) {
    const bool last = most <= 2 * most_of_a_piece;
    RationalCurve whole(from, to, solve, _enough, last ? most : most_of_a_piece);
    if (whole.settled() || last) {
        _pieces.push_back(std::move(whole));
        return;
    }
    const double middle = (from + to) / 2;
    add(from, middle, solve, (most - most_of_a_piece) / 2);
    add(middle, to, solve, (most - most_of_a_piece) / 2);
}

std::size_t RationalPieces::number_of(double place) const {
    const auto after = std::ranges::upper_bound(_pieces, place, {}, &RationalCurve::from);
    return after == _pieces.begin() ? 0 : static_cast<std::size_t>(after - _pieces.begin() - 1);
}

std::vector<std::pair<double, double>> RationalPieces::unsettled() const {
    std::vector<std::pair<double, double>> out;
    for (const RationalCurve &piece : _pieces)
        if (!piece.settled()) {
            if (!out.empty() && out.back().second == piece.from())
                out.back().second = piece.to();
            else
                out.emplace_back(piece.from(), piece.to());
        }
    return out;
}

double RationalPieces::take_in(const std::vector<double> &places) {
    std::vector<std::vector<double>> of(_pieces.size());
    for (const double place : places)
        of[number_of(place)].push_back(place);
    double worst = 0;
    for (std::size_t i = 0; i < _pieces.size(); ++i) {
        if (_pieces[i].settled() && !of[i].empty())
            worst = std::max(worst, _pieces[i].take_in(of[i]));
    }
    return worst;
}

} // namespace whirl::linalg
