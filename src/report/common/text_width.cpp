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

struct Letter {
    unsigned code = 0;
    std::size_t bytes = 1;
};
constexpr unsigned no_letter = 0xfffd;

/// Of UTF-8; a byte that begins none is `no_letter`.
Letter first_letter(std::string_view text) {
    const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    if (first < 0x80)
        return {first, 1};
    const std::size_t bytes = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    unsigned code = first & (0x7fU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if (i == text.size() || (byte(i) & 0xc0U) != 0x80U)
            return {no_letter, 1};
        code = code << 6U | (byte(i) & 0x3fU);
    }
    constexpr unsigned least[] = {0x80, 0x800, 0x10000}; // of two, three and four bytes
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    const bool valid =
        first >= 0xc0 && first < 0xf5 && code >= least[bytes - 2] && code < 0x110000 && !surrogate;
    return valid ? Letter{code, bytes} : Letter{no_letter, 1};
}

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
    for (Letter letter; !text.empty(); text.remove_prefix(letter.bytes)) {
        letter = first_letter(text);
        sum += width_of(letter.code);
    }
    return size * sum / 1000;
}

std::string printable(std::string_view text, bool line_ends) {
    std::string out;
    for (Letter letter; !text.empty(); text.remove_prefix(letter.bytes)) {
        letter = first_letter(text);
        const bool control = letter.code < 0x20 || (letter.code >= 0x7f && letter.code < 0xa0);
        if (control && !(line_ends && letter.code == '\n'))
            out += ' ';
        else if (letter.code == no_letter || letter.code == 0xfffe || letter.code == 0xffff)
            out += "\xEF\xBF\xBD";
        else
            out += text.substr(0, letter.bytes);
    }
    return out;
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
