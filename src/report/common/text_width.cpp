#include "report/common/text_width.h"

#include <array>

namespace whirl::report {

namespace {

// Of ' ' to '~', thousandths of the font's size.
constexpr std::array<int, 95> ascii{
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361,  318, 337, 636, 636, 636,
    636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
    575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635,  611, 732, 684, 989, 685,
    611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352,  635, 634, 278, 278, 579,
    278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592,  525, 636, 337, 636, 838};
// Of U+00A0 to U+00FF.
constexpr std::array<int, 96> latin{
    318, 401, 636, 636, 636, 636, 337, 500, 500, 1000, 471, 612, 838, 361, 1000, 500,
    500, 838, 401, 401, 500, 636, 636, 318, 500, 401,  471, 612, 969, 969, 969,  531,
    684, 684, 684, 684, 684, 684, 974, 698, 632, 632,  632, 632, 295, 295, 295,  295,
    775, 748, 787, 787, 787, 787, 787, 838, 787, 732,  732, 732, 732, 611, 605,  630,
    613, 613, 613, 613, 613, 613, 982, 550, 615, 615,  615, 615, 278, 278, 278,  278,
    612, 634, 612, 612, 612, 612, 612, 838, 612, 634,  634, 634, 634, 592, 635,  592};

int width_of(unsigned letter) {
    if (letter >= 0x20 && letter < 0x7f)
        return ascii[letter - 0x20];
    if (letter >= 0xa0 && letter <= 0xff)
        return latin[letter - 0xa0];
    if (letter >= 0x300 && letter < 0x370)
        return 0; // marks that stand on another letter
    if (letter >= 0x400 && letter < 0x530)
        return letter < 0x430 ? 880 : 780; // Cyrillic: most are narrower
    if (letter >= 0x2070 && letter <= 0x2079)
        return 401; // raised digits
    if (letter >= 0x2e80)
        return 1000;                     // a square
    return letter >= 0x2100 ? 840 : 790; // arrows and signs; Greek, but for psi and omega
}

} // namespace

double text_width(std::string_view text, double size) {
    int sum = 0;
    unsigned letter = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if (byte < 0x80)
            letter = byte;
        else if (byte < 0xc0) // one of the bytes that follow
            letter = letter << 6U | (byte & 0x3fU);
        else
            letter = byte & (byte < 0xe0 ? 0x1fU : byte < 0xf0 ? 0x0fU : 0x07U);
        const bool last =
            i + 1 == text.size() || (static_cast<unsigned char>(text[i + 1]) & 0xc0U) != 0x80U;
        sum += last ? width_of(letter) : 0;
    }
    return size * sum / 1000;
}

std::string fitting(std::string text, double size, double width) {
    if (text_width(text, size) <= width)
        return text;
    while (!text.empty() && text_width(text + "…", size) > width) {
        while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U)
            text.pop_back();
        text.pop_back();
    }
    return text + "…";
}

} // namespace whirl::report
