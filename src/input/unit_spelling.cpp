#include "input/unit_spelling.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace whirl::input {
namespace {

/// In place of ASCII. Superscripts become exponents one by one: a unit has none of two digits.
constexpr std::array plain_signs{
    Replacement{"\u00a0", " "},    Replacement{"\u2007", " "},    Replacement{"\u2009", " "},
    Replacement{"\u202f", " "},    Replacement{"\u3000", " "},    Replacement{"\ufeff", ""},
    Replacement{"\u00b7", "*"},    Replacement{"\u22c5", "*"},    Replacement{"\u2219", "*"},
    Replacement{"\u2022", "*"},    Replacement{"\u30fb", "*"},    Replacement{"\u00d7", "*"},
    Replacement{"\u2215", "/"},    Replacement{"\u2044", "/"},    Replacement{"\u00f7", "/"},
    Replacement{"\uff0f", "/"},    Replacement{"\u2212", "-"},    Replacement{"\u2010", "-"},
    Replacement{"\u2011", "-"},    Replacement{"\u2013", "-"},    Replacement{"\u207b", "-"},
    Replacement{"\u2070", "^0"},   Replacement{"\u00b9", "^1"},   Replacement{"\u00b2", "^2"},
    Replacement{"\u00b3", "^3"},   Replacement{"\u2074", "^4"},   Replacement{"\u2075", "^5"},
    Replacement{"\u2076", "^6"},   Replacement{"\u2077", "^7"},   Replacement{"\u2078", "^8"},
    Replacement{"\u2079", "^9"},   Replacement{"\u00b5", "u"},    Replacement{"\u03bc", "u"},
    Replacement{"\u2032", "'"},    Replacement{"\u2019", "'"},    Replacement{"\u2033", "\""},
    Replacement{"\u201d", "\""},   Replacement{"\u00ba", "deg"},  Replacement{"\u02da", "deg"},
    Replacement{"\u00b0", "deg"},  Replacement{"\u339c", "mm"},   Replacement{"\u339d", "cm"},
    Replacement{"\u339b", "um"},   Replacement{"\u339e", "km"},   Replacement{"\u338f", "kg"},
    Replacement{"\u338e", "mg"},   Replacement{"\u3390", "Hz"},   Replacement{"\u3391", "kHz"},
    Replacement{"\u33a9", "Pa"},   Replacement{"\u33aa", "kPa"},  Replacement{"\u33ab", "MPa"},
    Replacement{"\u33ac", "GPa"},  Replacement{"\u33ad", "rad"},  Replacement{"\u33ae", "rad/s"},
    Replacement{"\u33a1", "m2"},   Replacement{"\u33a5", "m3"},   Replacement{"\u33a0", "cm2"},
    Replacement{"\u33a4", "cm3"},  Replacement{"\u339f", "mm2"},  Replacement{"\u33a3", "mm3"},
    Replacement{"\u00bd", " 1/2"}, Replacement{"\u00bc", " 1/4"}, Replacement{"\u00be", " 3/4"},
    Replacement{"\u215b", " 1/8"}, Replacement{"\u215c", " 3/8"}, Replacement{"\u215d", " 5/8"},
    Replacement{"\u215e", " 7/8"}, Replacement{"\u33b3", "ms"},   Replacement{"\u33a8", "m/s2"},
    Replacement{"\u33cc", "in"},
};

/// A unit of UDUNITS-2, and words for it that it does not know, with blanks between them. Forces in
/// kilograms and turns a minute go by many names.
struct Spellings {
    std::string_view unit, words;
};
constexpr std::array spellings{
    Spellings{"lb", "lbm lbs lbms Lbs Lb pound pounds"},
    Spellings{"lbf", "lbsf lbfs"},
    Spellings{"oz", "ounce ounces"},
    Spellings{"g", "gm gms г"},
    Spellings{"kg", "Kg kgs кг"},
    Spellings{"kgf", "Kgf kgp Kp kp кгс"},
    Spellings{"(lbf.s2/in)", "slinch"},
    Spellings{"(1000 kgf)", "tf тс"},
    Spellings{"force_ton", "tonf"},
    Spellings{"dyne", "dyn дин"},
    Spellings{"(lb.ft/s2)", "pdl poundal"},
    Spellings{"(lbf/16)", "ozf"},
    Spellings{"(lbf.s2/ft)", "slug slugs"},
    Spellings{"N", "Nt Н"},
    Spellings{"kN", "KN кН"},
    Spellings{"mil", "thou thous"},
    Spellings{"in", "Zoll zoll pouce pouces"},
    Spellings{"degree", "deg degs град"},
    Spellings{"grade", "gon"},
    Spellings{"arcminute", "'"},
    Spellings{"arcsecond", "\""},
    Spellings{"percent", "%"},
    Spellings{"(1e6 psi)", "Msi msi"},
    Spellings{"(lbf/ft2)", "psf"},
    Spellings{"(kip/ft2)", "ksf"},
    Spellings{"min", "mn mins Min мин хв 分"},
    Spellings{"hr", "hrs"},
    Spellings{"s", "Sec с сек 秒"},
    Spellings{"turn", "rev revs Rev cyc tr trs tour tours U Umdr "
                      "Umdrehung Umdrehungen giri omw obr varv об 回転"},
    Spellings{"rpm", "RPM Rpm Upm UpM cpm CPM"},
    Spellings{"rps", "RPS"},
    Spellings{"cps", "CPS"},
    Spellings{"Hz", "hz HZ Гц"},
    Spellings{"m", "м"},
    Spellings{"cm", "см"},
    Spellings{"mm", "мм"},
    Spellings{"um", "мкм"},
    Spellings{"km", "км"},
    Spellings{"mg", "мг"},
    Spellings{"t", "т"},
    Spellings{"MN", "МН"},
    Spellings{"gf", "гс"},
    Spellings{"Pa", "Па"},
    Spellings{"kPa", "кПа"},
    Spellings{"MPa", "МПа"},
    Spellings{"GPa", "ГПа"},
    Spellings{"ms", "мс"},
    Spellings{"h", "ч"},
    Spellings{"rad", "рад"},
    Spellings{"kHz", "кГц"},
};

/// The unit of UDUNITS-2 that a word is; the word where it is none of these.
std::string_view spelled(std::string_view word) {
    const std::string whole = fmt::format(" {} ", word);
    for (const auto &[unit, words] : spellings)
        if (fmt::format(" {} ", words).find(whole) != std::string::npos)
            return unit;
    return word;
}

/// Of a word alone, or in a product.
struct Ambiguous {
    std::string_view word;
    std::string_view says;
};
constexpr std::array ambiguous{
    Ambiguous{"gr", "\"gr\" may be a gram or a grain (64.8 mg): write \"g\" or \"grain\""},
    Ambiguous{"Gr", "\"Gr\" may be a gram or a grain (64.8 mg): write \"g\" or \"grain\""},
    Ambiguous{"grs", "\"grs\" may be grams or grains (64.8 mg): write \"g\" or \"grain\""},
    Ambiguous{"ton", "\"ton\" may be 1000 kg, 2000 lb or 2240 lb: write \"t\", \"short_ton\" or "
                     "\"long_ton\""},
    Ambiguous{"tons", "\"tons\" may be of 1000 kg, 2000 lb or 2240 lb: write \"t\", \"short_ton\" "
                      "or \"long_ton\""},
    Ambiguous{"grad", "\"grad\" may be a degree or a hundredth of a right angle: write \"deg\" or "
                      "\"gon\""},
    Ambiguous{"Grad", "\"Grad\" may be a degree or a hundredth of a right angle: write \"deg\" or "
                      "\"gon\""},
    Ambiguous{"r", "\"r\" may be a radian or a revolution: write \"rad\" or \"rev\""},
    Ambiguous{"R", "\"R\" may be a radian or a revolution: write \"rad\" or \"rev\""},
    Ambiguous{"u", "\"u\" is an atomic mass: write \"um\" for a micrometre, \"rev\" for a turn"},
    Ambiguous{"Mm", "\"Mm\" is a million metres: write \"mm\" for millimetres"},
    Ambiguous{"Ms", "\"Ms\" is a million seconds: write \"ms\" for milliseconds"},
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
/// Of a word of more than one character; every byte of a letter beyond ASCII is one.
bool is_letter(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return std::isalpha(byte) != 0 || c == '_' || byte >= 0x80;
}

/// Reads a unit from left to right.
class PartReader {
  public:
    explicit PartReader(std::string_view text) : _rest(text) {}

    std::optional<std::vector<UnitPart>> read() {
        while (true) {
            const bool blank = skip_blanks();
            if (_rest.empty())
                break;
            if (!read_part(blank))
                return std::nullopt;
        }
        const bool complete = after_factor() && _depth == 0 && _wanted_power == 1;
        return complete ? std::optional(std::move(_parts)) : std::nullopt;
    }

  private:
    std::string_view _rest;
    std::vector<UnitPart> _parts;
    int _depth = 0;
    int _wanted_power = 1; ///< of the next word: "sq in", "cubic in"

    bool skip_blanks() {
        const bool any = !_rest.empty() && is_blank(_rest[0]);
        while (!_rest.empty() && is_blank(_rest[0]))
            _rest.remove_prefix(1);
        return any;
    }
    [[nodiscard]] bool after_factor() const {
        return !_parts.empty() && (_parts.back().kind == UnitPart::Kind::word ||
                                   _parts.back().kind == UnitPart::Kind::close ||
                                   _parts.back().kind == UnitPart::Kind::one);
    }
    void add(UnitPart::Kind kind, std::string text = {}) {
        _parts.push_back({kind, std::move(text), 1});
    }
    /// A factor after another one multiplies it.
    void begin_factor() {
        if (after_factor())
            add(UnitPart::Kind::times);
    }

    bool read_part(bool blank) {
        const char c = _rest[0];
        if (is_digit(c))
            return blank ? read_one() : read_power(false) || read_one();
        if (c == '^' || _rest.starts_with("**")) {
            _rest.remove_prefix(c == '^' ? 1 : 2);
            skip_blanks();
            return read_power(true);
        }
        if (c == '-' && !blank && _rest.size() > 1 && is_digit(_rest[1]))
            return read_power(false);
        if (c == '.' || c == '*' || c == '-')
            return read_product();
        if (c == '/')
            return read_quotient(1);
        if (c == '(' || c == ')')
            return read_parenthesis();
        return read_word();
    }

    /// The exponent of the part before, with its sign: one digit. Superscripts come as "^2" after
    /// the "-" of their own.
    bool read_power(bool raised) {
        const bool word = after_factor() && _parts.back().kind != UnitPart::Kind::one;
        std::string_view rest = _rest;
        const bool minus = rest.starts_with('-');
        if (minus || rest.starts_with('+'))
            rest.remove_prefix(1);
        if (!raised && rest.starts_with('^'))
            rest.remove_prefix(1);
        if (!word || _parts.back().power != 1 || rest.empty() || !is_digit(rest[0]) ||
            rest[0] == '0' || (rest.size() > 1 && is_digit(rest[1])))
            return false;
        _parts.back().power = (minus ? -1 : 1) * (rest[0] - '0');
        _rest = rest.substr(1);
        return true;
    }
    /// The one of "1/s", which alone may begin a unit.
    bool read_one() {
        if (!_parts.empty() || !_rest.starts_with('1'))
            return false;
        _rest.remove_prefix(1);
        add(UnitPart::Kind::one);
        skip_blanks();
        return _rest.starts_with('/') || _rest.starts_with("per");
    }
    bool read_product() {
        const char c = _rest[0];
        _rest.remove_prefix(1);
        if (!after_factor())
            return false;
        if (c == '-' && _rest.starts_with('^')) { // superscript minus
            _rest.remove_prefix(1);
            if (_rest.empty() || !read_power(true))
                return false;
            _parts.back().power *= -1;
            return true;
        }
        // The point of an abbreviation, "in.", is no product.
        if (c == '.' && (_rest.empty() || !is_letter(_rest[0])))
            return _rest.empty() || !is_digit(_rest[0]);
        add(UnitPart::Kind::times);
        return true;
    }
    bool read_quotient(std::size_t length) {
        _rest.remove_prefix(length);
        if (!after_factor()) {
            if (!_parts.empty())
                return false;
            add(UnitPart::Kind::one); // "/min"
        }
        add(UnitPart::Kind::over);
        return true;
    }
    bool read_parenthesis() {
        const bool open = _rest[0] == '(';
        _rest.remove_prefix(1);
        _depth += open ? 1 : -1;
        if (open)
            begin_factor();
        else if (_depth < 0 || !after_factor())
            return false;
        add(open ? UnitPart::Kind::open : UnitPart::Kind::close);
        return true;
    }
    bool read_word() {
        const char c = _rest[0];
        std::size_t length = 1;
        if (is_letter(c))
            while (length < _rest.size() && is_letter(_rest[length]))
                ++length;
        else if (c != '%' && c != '\'' && c != '"')
            return false;
        const std::string_view word = _rest.substr(0, length);
        if (word == "per")
            return read_quotient(length);
        _rest.remove_prefix(length);
        if (word == "sq" || word == "square" || word == "cu" || word == "cubic") {
            _wanted_power = word.starts_with('s') ? 2 : 3;
            if (_rest.starts_with('.'))
                _rest.remove_prefix(1);
            return true;
        }
        begin_factor();
        add(UnitPart::Kind::word, std::string(word));
        _parts.back().power = _wanted_power;
        _wanted_power = 1;
        return true;
    }
};

/// Whether the parts are turns a minute under the name of a sheet of data: r/min, R/min.
bool turns_a_minute(const std::vector<UnitPart> &parts) {
    return parts.size() == 3 && (parts[0].text == "r" || parts[0].text == "R") &&
           parts[1].kind == UnitPart::Kind::over && parts[2].text.starts_with("min") &&
           parts[0].power == 1 && parts[2].power == 1;
}

std::string joined(const std::vector<UnitPart> &parts,
                   const auto &word_of) { // "lb.in^2/(s.m)"
    std::string out;
    for (const UnitPart &part : parts) {
        switch (part.kind) {
        case UnitPart::Kind::word:
            out += word_of(part);
            break;
        case UnitPart::Kind::times:
            out += ".";
            break;
        case UnitPart::Kind::over:
            out += "/";
            break;
        case UnitPart::Kind::open:
            out += "(";
            break;
        case UnitPart::Kind::close:
            out += ")";
            break;
        case UnitPart::Kind::one:
            out += "1";
            break;
        }
        if (part.power != 1)
            out += fmt::format("^{}", part.power);
    }
    return out;
}

} // namespace

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

std::optional<std::vector<UnitPart>> parts_of_unit(std::string_view unit) {
    if (unit.size() > longest_unit)
        return std::nullopt;
    return PartReader(with_plain_signs(unit)).read();
}

std::string text_of(const std::vector<UnitPart> &parts) {
    std::string text = joined(parts, [](const UnitPart &part) { return part.text; });
    std::ranges::replace(text, '.', ' ');
    std::erase(text, '^');
    return text;
}

std::string for_udunits(const std::vector<UnitPart> &parts, bool pounds_force) {
    const bool rpm = turns_a_minute(parts);
    return joined(parts, [&](const UnitPart &part) {
        if (rpm && (part.text == "r" || part.text == "R"))
            return std::string("turn");
        std::string word(spelled(part.text));
        const bool mass_only = part.text == "lbm" || part.text == "lbms";
        if (pounds_force && !mass_only && word.ends_with("lb")) // "klb" too
            word += "f";
        if (pounds_force && word == "oz")
            word = "(lbf/16)";
        return word;
    });
}

std::string two_meanings(const std::vector<UnitPart> &parts, Quantity quantity) {
    if (turns(quantity) && turns_a_minute(parts))
        return "";
    for (const UnitPart &part : parts)
        if (const auto found = std::ranges::find(ambiguous, part.text, &Ambiguous::word);
            part.kind == UnitPart::Kind::word && found != ambiguous.end())
            return std::string(found->says);
    return "";
}

std::string replaced_signs(std::string_view text, std::span<const Replacement> table) {
    const auto in_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
    std::string out;
    out.reserve(text.size());
    while (true) {
        const auto other = std::find_if_not(text.begin(), text.end(), in_ascii);
        out.append(text.begin(), other);
        text.remove_prefix(static_cast<std::size_t>(other - text.begin()));
        if (text.empty())
            return out;
        const auto sign = std::ranges::find_if(
            table, [&](const Replacement &at) { return text.starts_with(at.from); });
        out += sign == table.end() ? text.substr(0, 1) : sign->to;
        text.remove_prefix(sign == table.end() ? 1 : sign->from.size());
    }
}

std::string with_plain_signs(std::string_view text) { return replaced_signs(text, plain_signs); }

} // namespace whirl::input
