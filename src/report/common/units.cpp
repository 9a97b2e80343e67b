#include "report/common/units.h"

#include "report/common/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

namespace whirl::report {

std::array<Unit, Units::quantities> Units::si_units() {
    std::array<Unit, quantities> units;
    for (std::size_t i = 0; i < quantities; ++i)
        units[i].name = names_of(static_cast<Quantity>(i)).si;
    return units;
}

void Units::ask(const model::OutputUnits &asked) {
    for (std::size_t i = 0; i < quantities; ++i) {
        const auto found = asked.of.find(names_of(static_cast<Quantity>(i)).key);
        if (found == asked.of.end())
            continue;
        _units[i] = {found->second.name, 1 / found->second.size, false};
        _asked[i] = true;
    }
    if (!asked.peak_to_peak)
        return;
    const auto amplitude = static_cast<std::size_t>(Quantity::amplitude);
    if (!_asked[amplitude] && !_for_readers) // where none is given that of readers, in files too
        _units[amplitude] = {"um", 1e6, false};
    _units[amplitude].factor *= 2;
    _units[amplitude].peak_to_peak = true;
    _asked[amplitude] = true;
}

Units Units::of_files(const model::OutputUnits &asked) {
    Units units;
    units.ask(asked);
    return units;
}

Units Units::of_readers(const model::OutputUnits &asked) {
    Units units;
    units._for_readers = true;
    const auto set = [&units](Quantity quantity, const char *name, double factor) {
        units._units.at(static_cast<std::size_t>(quantity)) = {name, factor, false};
    };
    set(Quantity::speed, "rpm", model::rpm);
    set(Quantity::frequency, "Hz", 0.5 / pi);
    set(Quantity::amplitude, "µm", 1e6);
    set(Quantity::deflection, "µm", 1e6);
    set(Quantity::inertia, "kg m²", 1);
    set(Quantity::angular_momentum, "kg m²/s", 1);
    set(Quantity::angle, "°", 180 / pi);
    units.ask(asked);
    return units;
}

Units Units::of_json(const model::OutputUnits &asked) {
    return asked.json ? of_files(asked) : Units();
}

std::string Units::name(Quantity quantity) const {
    const Unit &used = unit(quantity);
    return used.peak_to_peak ? used.name + " pk-pk" : used.name;
}

std::string Units::label(const std::string &what, Quantity quantity) const {
    const Unit &used = unit(quantity);
    return what + (used.peak_to_peak ? " pk-pk" : "") +
           (used.name.empty() ? "" : " (" + used.name + ")");
}

std::string Units::heading(const std::string &what, Quantity quantity) const {
    const Unit &used = unit(quantity);
    return what + (used.peak_to_peak ? " pk-pk" : "") +
           (used.name.empty() ? "" : " [" + used.name + "]");
}

std::string Units::text(Quantity quantity, double si, int digits) const {
    return text(model::Sentence("{}", model::ValueOf{quantity}(si, digits)));
}

std::string Units::text(const model::Sentence &sentence) const {
    if (sentence.plain() && _for_readers)
        return note_in_written_units(sentence.text());
    return sentence.text([this](Quantity quantity) { return unit(quantity); });
}

namespace {

model::OutputUnits &current() {
    static model::OutputUnits units;
    return units;
}
/// By quantity, amplitudes and what does not vibrate told apart.
std::map<std::string, model::OutputUnit> &conversions() {
    static std::map<std::string, model::OutputUnit> of;
    return of;
}

const model::OutputUnit *unit_of(const std::string &quantity) {
    const auto found = conversions().find(quantity);
    return found == conversions().end() ? nullptr : &found->second;
}

/// A unit as it stands in texts.
struct UnitWord {
    std::string_view text;
    std::string_view quantity; ///< empty: stays as it is
    double size = 1;           ///< one of it in SI
    bool reading = false;      ///< numbers beside it in reports come from a Reading
};

constexpr double turn = 2 * pi;
/// Longer ones before those that they begin with.
constexpr std::array unit_words{
    UnitWord{"N m/rad", "", 1, false},         UnitWord{"N s/m", "damping", 1, false},
    UnitWord{"kg m2/s", "", 1, false},         UnitWord{"kg m²/s", "", 1, false},
    UnitWord{"kg m2", "inertia", 1, false},    UnitWord{"kg m²", "inertia", 1, false},
    UnitWord{"kg m", "imbalance", 1, false},   UnitWord{"kg", "mass", 1, false},
    UnitWord{"N/m", "stiffness", 1, false},    UnitWord{"N m", "", 1, false},
    UnitWord{"N", "force", 1, false},          UnitWord{"rad/s", "speed", 1, false},
    UnitWord{"rpm", "speed", turn / 60, true}, UnitWord{"Hz", "frequency", turn, true},
    UnitWord{"µm", "amplitude", 1e-6, true},   UnitWord{"mm", "length", 1e-3, false},
    UnitWord{"m", "length", 1, false}};

/// Letters, digits and what joins units: a unit ends before others.
bool part_of_word(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '/' ||
           letter == '_' || letter == '^' || (static_cast<unsigned char>(letter) & 0x80) != 0;
}

const UnitWord *word_at(std::string_view text, std::size_t at) {
    if (at > 0 && part_of_word(text[at - 1]))
        return nullptr;
    for (const UnitWord &word : unit_words)
        if (text.substr(at, word.text.size()) == word.text &&
            (at + word.text.size() == text.size() || !part_of_word(text[at + word.text.size()])))
            return &word;
    return nullptr;
}

bool says(std::string_view text, std::initializer_list<const char *> words) {
    for (const char *word : words)
        if (text.find(word) != std::string_view::npos)
            return true;
    return false;
}

/// What the numbers are under a heading: metres may be places or vibration, rad/s spin or whirl.
std::string quantity_of(const UnitWord &word, const std::string &heading,
                        const std::string &context) {
    const std::string quantity(word.quantity);
    if (word.text == "rad/s")
        return says(heading + context, {"requenc"}) ? "frequency" : quantity;
    if (quantity != "length" && quantity != "amplitude")
        return quantity;
    if (says(heading, {"tatic", "sag", "learance", "x_", "y_"}))
        return "deflection";
    if (says(heading, {"mplitude", "peak", "major", "minor", "reading", "twice", "ircle"}) ||
        heading.starts_with("x [") || heading.starts_with("y ["))
        return "amplitude";
    return quantity;
}

struct Found {
    std::size_t at = 0;
    const UnitWord *word = nullptr;
};

/// The last unit of a heading.
std::optional<Found> last_unit(std::string_view heading) {
    std::optional<Found> last;
    for (std::size_t i = 0; i < heading.size(); ++i)
        if (const UnitWord *word = word_at(heading, i)) {
            last = Found{i, word};
            i += word->text.size() - 1;
        }
    return last;
}

/// "amplitude [m]" to "amplitude pk-pk [um]".
std::string renamed(const std::string &heading, const Found &found, const std::string &quantity) {
    std::string out = heading;
    out.replace(found.at, found.word->text.size(), unit_of(quantity)->name);
    if (quantity == "amplitude" && current().peak_to_peak) {
        const std::size_t before = out.find_last_of("[(", found.at);
        out.insert(before == std::string::npos ? found.at : before, "pk-pk ");
    }
    return out;
}

/// Digits of a number as it was written, at least four: short ones are rather exact.
std::string converted_number(std::string_view number, double factor) {
    double value = 0;
    std::from_chars(number.data(), number.data() + number.size(), value);
    int digits = 0;
    for (const char letter : number.substr(0, number.find_first_of("eE")))
        digits += std::isdigit(static_cast<unsigned char>(letter)) != 0 ? 1 : 0;
    return readable(value * factor, std::max(4, digits));
}

/// Length of a plain number at a place of a text; 0: none.
std::size_t number_at(std::string_view text, std::size_t at) {
    if (at > 0 && (part_of_word(text[at - 1]) || text[at - 1] == '.' || text[at - 1] == '-' ||
                   text[at - 1] == '+'))
        return 0;
    double value = 0;
    const char *start = text.data() + at;
    if (*start != '-' && std::isdigit(static_cast<unsigned char>(*start)) == 0)
        return 0;
    const auto [end, error] = std::from_chars(start, text.data() + text.size(), value);
    return error == std::errc() ? static_cast<std::size_t>(end - start) : 0;
}

/// Numbers that share the unit behind the last of them: "3 to 4 rad/s", "1, 2 and 3 m".
struct Chain {
    std::vector<std::pair<std::size_t, std::size_t>> numbers; ///< place and length
    Found unit;
};
std::optional<Chain> chain_at(std::string_view text, std::size_t at) {
    Chain chain;
    while (const std::size_t length = number_at(text, at)) {
        chain.numbers.emplace_back(at, length);
        at += length;
        if (at < text.size() && text[at] == ' ')
            if (const UnitWord *word = word_at(text, at + 1)) {
                chain.unit = {at + 1, word};
                return chain;
            }
        std::size_t next = at;
        for (const char *joint :
             {" ", " to ", " and ", ", ", " … ", " ... ", " | "}) // the longest counts
            if (text.substr(at, std::strlen(joint)) == joint)
                next = at + std::strlen(joint);
        if (next == at)
            break;
        at = next;
    }
    return std::nullopt;
}

/// The two words before a number, which tell what it is: "(frequencies near 3 rad/s)".
std::string words_before(std::string_view text, std::size_t number) {
    std::size_t start = number;
    for (int words = 0; words < 3 && start != std::string_view::npos && start > 0; ++words)
        start = text.find_last_of(' ', start - 1);
    const std::size_t from = start == std::string_view::npos ? 0 : start;
    return std::string(text.substr(from, number - from));
}

/// Notes are in SI; where no unit was asked for, they speak of speeds as the rest of the text.
const model::OutputUnit *usual_unit_of_notes(const std::string &quantity) {
    static const std::map<std::string, model::OutputUnit> usual{{"speed", {"rpm", turn / 60}},
                                                                {"frequency", {"Hz", turn}}};
    const auto found = usual.find(quantity);
    return found == usual.end() ? nullptr : &found->second;
}

/// Numbers with their units.
/// @param note  of an analysis: also those beside units of readers are converted
std::string prose(std::string_view text, bool note) {
    std::string out;
    std::size_t done = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto chain = chain_at(text, i);
        if (!chain)
            continue;
        const UnitWord &word = *chain->unit.word;
        const bool turns = word.text == "rad/s"; // of spin or whirl
        const std::string quantity = quantity_of(word, turns ? words_before(text, i) : "", "");
        const model::OutputUnit *unit = unit_of(quantity);
        if (!unit && note)
            unit = usual_unit_of_notes(quantity);
        const std::size_t end = chain->unit.at + word.text.size();
        if (unit) {
            const double factor = word.reading && !note ? 1 : word.size / unit->size;
            for (const auto &[at, length] : chain->numbers) {
                const auto number = text.substr(at, length);
                out += text.substr(done, at - done);
                out += factor == 1 ? std::string(number) : converted_number(number, factor);
                done = at + length;
            }
            out += text.substr(done, chain->unit.at - done);
            out += unit_name(quantity, unit->name);
            done = end;
        }
        i = end - 1;
    }
    return out.append(text.substr(done));
}

/// Marks around text that stays as it is.
constexpr char kept_begin = '\x01';
constexpr char kept_end = '\x02';

/// A function of the parts of a text between those that are kept.
template <class Of> std::string between(const std::string &text, const Of &of) {
    std::string out;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t begin = std::min(text.find(kept_begin, from), text.size());
        const std::size_t end = std::min(text.find(kept_end, begin), text.size());
        out += of(std::string_view(text).substr(from, begin - from));
        if (begin < end)
            out += text.substr(begin + 1, end - begin - 1);
        from = end + 1;
    }
    return out;
}

} // namespace

void write_in(const model::OutputUnits &units) {
    current() = units;
    conversions() = units.of;
    if (units.peak_to_peak) // the usual unit of pictures where none is given
        conversions().try_emplace("amplitude", model::OutputUnit{"um", 1e-6});
    const auto amplitude = conversions().find("amplitude");
    if (amplitude == conversions().end())
        return;
    conversions()["deflection"] = amplitude->second;
    if (units.peak_to_peak)
        amplitude->second.size /= 2;
}

const model::OutputUnits &written_units() { return current(); }

Reading::operator double() const {
    const model::OutputUnit *unit = unit_of(_quantity);
    return unit ? 1 / unit->size : _usual;
}

UnitHeading heading_in_written_units(const std::string &heading, const std::string &context) {
    const auto found = current().given() ? last_unit(heading) : std::nullopt;
    if (!found)
        return {heading, 1, false};
    const std::string quantity = quantity_of(*found->word, heading, context);
    const model::OutputUnit *unit = unit_of(quantity);
    if (!unit)
        return {heading, 1, false};
    return {renamed(heading, *found, quantity), found->word->reading ? 1 : 1 / unit->size, true};
}

std::string quantity_in(const std::string &unit) {
    const auto *const word = std::ranges::find(unit_words, unit, &UnitWord::text);
    return std::string(word == unit_words.end() ? "" : word->quantity);
}

std::optional<double> written_factor(const std::string &quantity) {
    const model::OutputUnit *unit = unit_of(quantity);
    return unit ? std::optional(1 / unit->size) : std::nullopt;
}

std::string unit_name(const std::string &quantity, const std::string &usual) {
    const model::OutputUnit *unit = unit_of(quantity);
    if (!unit)
        return usual;
    return quantity == "amplitude" && current().peak_to_peak ? unit->name + " pk-pk" : unit->name;
}

std::string in_written_units(const std::string &text) {
    if (!current().given())
        return text;
    return between(text, [](std::string_view part) { return prose(part, false); });
}

std::string note_in_written_units(const std::string &note) { return prose(note, true); }

std::string kept_as_written(const std::string &text) {
    return current().given() ? kept_begin + text + kept_end : text;
}

std::string cell_in_written_units(const std::string &cell) {
    if (!current().given())
        return cell;
    const std::string converted = prose(cell, false);
    return converted == cell ? cell : kept_begin + converted + kept_end;
}

std::size_t shown_size(const std::string &cell) {
    const auto letters = std::count_if(cell.begin(), cell.end(), [](char byte) {
        return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; // the first of its bytes
    });
    return static_cast<std::size_t>(letters) -
           (!cell.empty() && cell.front() == kept_begin ? 2 : 0);
}

namespace {

/// Words of labels whose numbers come from factors: "(N)", and those of readers anywhere but behind
/// a number, where they have been renamed.
std::string labels(std::string text) {
    for (std::size_t i = 1; i < text.size(); ++i) {
        const UnitWord *word = word_at(text, i);
        if (!word)
            continue;
        const std::size_t end = i + word->text.size();
        const bool in_brackets =
            text[i - 1] == '(' && end < text.size() && text[end] == ')' && word->text != "rad/s";
        const bool behind_number =
            i > 1 && text[i - 1] == ' ' && std::isdigit(static_cast<unsigned char>(text[i - 2]));
        if (!in_brackets && !(word->reading && !behind_number))
            continue;
        const std::size_t start = text.find_last_of("\n'", i);
        const std::string label = text.substr(start + 1, i - start - 1);
        const std::string quantity = quantity_of(*word, label, "");
        const std::string name = unit_name(quantity, std::string(word->text));
        text.replace(i, word->text.size(), name);
        i += name.size();
    }
    return text;
}

} // namespace

std::string script_in_written_units(const std::string &script) {
    if (!current().given())
        return script;
    return between(script, [](std::string_view part) { return labels(prose(part, false)); });
}

std::string script_units() {
    return fmt::format("const rpm = {}, hertz = {}, metres = {}, micrometres = {}, newtons = {};\n",
                       double(rpm), double(hertz), double(metres), double(micrometres),
                       double(newtons));
}

std::string page_script_in_written_units(const std::string &script) {
    if (!current().given())
        return script;
    std::string text = script;
    for (const auto &[usual, quantity] : {std::pair("rpm", "speed"),
                                          {"Hz", "frequency"},
                                          {"µm", "amplitude"},
                                          {"m", "length"},
                                          {"N", "force"}})
        for (const char *form : {"({})", "}} {}"}) {
            const std::string from = fmt::format(fmt::runtime(form), usual);
            const std::string to = fmt::format(fmt::runtime(form), unit_name(quantity, usual));
            for (std::size_t at = text.find(from); at != std::string::npos;
                 at = text.find(from, at + to.size())) {
                const std::size_t end = at + from.size();
                if (end == text.size() || !part_of_word(text[end]))
                    text.replace(at, from.size(), to);
            }
        }
    return text;
}

} // namespace whirl::report
