#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace whirl::studio {

/// An analysis that the page offers.
struct Offer {
    std::string command; ///< "campbell"
    std::string heading; ///< "Campbell diagram"
    std::string why_not; ///< why the case does not call for it; empty: it does
};

struct Setup {
    std::filesystem::path scene; ///< as the user named it
    std::vector<std::string> overrides;
    std::vector<Offer> offers;
    std::filesystem::path reports; ///< folder of the report
    int port = 0;                  ///< 0: any that is free
};

/// A page on which the numbers of a case are fields and sliders and its pictures follow them, until
/// a signal ends the program.
/// @param ready  told the address of the page
/// @throws model::BadInput
void run(const Setup &setup, const std::function<void(const std::string &address)> &ready);

} // namespace whirl::studio
