// Cases that something went wrong with on their way: bytes lost, doubled, changed, lines mixed up.
// A damaged case is read as another one, or refused as a bad case; nothing else comes of it.

#include "scratch_case.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

namespace whirl::tests::damage_test {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path &file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// A case of the repository with its tables beside it.
BrokenCase case_of(const fs::path &folder) {
    BrokenCase out{folder.filename().string(), 0, "", "", content(folder / "case.toml")};
    for (const fs::path &tables : {folder, fs::path(WHIRL_ROOT) / "meshes"})
        for (const auto &entry : fs::directory_iterator(tables))
            if (entry.path().extension() == ".csv")
                out.files.emplace_back(entry.path().filename().string(), content(entry.path()));
    const std::string elsewhere = "../../meshes/";
    for (std::size_t at = 0; (at = out.text.find(elsewhere)) != std::string::npos;)
        out.text.erase(at, elsewhere.size());
    return out;
}

std::vector<BrokenCase> all_cases() {
    std::vector<BrokenCase> out;
    for (const auto &entry : fs::directory_iterator(fs::path(WHIRL_ROOT) / "cases"))
        if (fs::exists(entry.path() / "case.toml"))
            out.push_back(case_of(entry.path()));
    std::ranges::sort(out, {}, &BrokenCase::name);
    return out;
}

class Damage {
  public:
    explicit Damage(unsigned seed) : _random(seed) {}

    /// One to three accidents.
    void befall(std::string &text) {
        for (std::size_t times = 1 + below(3); times > 0; --times)
            once(text);
    }
    [[nodiscard]] std::size_t below(std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(_random);
    }

  private:
    std::mt19937 _random;

    void once(std::string &text) {
        if (text.empty())
            return;
        static const std::vector<std::string> strange{"[",
                                                      "]",
                                                      "{",
                                                      "}",
                                                      "\"",
                                                      "'",
                                                      "\"\"\"",
                                                      "=",
                                                      ".",
                                                      "#",
                                                      ",",
                                                      ";",
                                                      "\t",
                                                      "\r",
                                                      "\n",
                                                      "nan",
                                                      "inf",
                                                      "-",
                                                      "e",
                                                      "1e999",
                                                      "-1",
                                                      "0",
                                                      "1e-320",
                                                      "\\",
                                                      "\x80",
                                                      "\xff\xfe",
                                                      "*",
                                                      "°",
                                                      "gr",
                                                      "1/2",
                                                      "true",
                                                      "[[[[[",
                                                      "a.b.c.",
                                                      "=\"=",
                                                      "\x1b",
                                                      "#DIV/0!",
                                                      "[*]",
                                                      "9"
                                                      "99999999999999999999",
                                                      std::string(1, '\0'),
                                                      std::string(300, 'x')};
        const std::size_t at = below(text.size());
        const std::size_t length = std::min(1 + below(40), text.size() - at);
        const std::size_t other = below(text.size());
        switch (below(7)) {
        case 0:
            text.erase(at, length);
            break;
        case 1:
            text.insert(other, text.substr(at, length));
            break;
        case 2:
            text[at] = static_cast<char>(below(256));
            break;
        case 3:
            text.resize(at);
            break;
        case 4:
            text.replace(at, length, strange[below(strange.size())]);
            break;
        case 5:
            std::swap(text[at], text[other]);
            break;
        default:
            text.insert(at, strange[below(strange.size())]);
        }
    }
};

/// @returns whether it was refused
bool read(const BrokenCase &damaged, const std::vector<std::string> &overrides) {
    write_case(scratch_folder(), damaged);
    try {
        const input::CaseFile file(scratch_folder());
        const model::Case scene = file.load(overrides);
        // What was used can be written down, and is the same case again.
        const std::string text = file.text(overrides);
        BrokenCase again = damaged;
        again.text = text;
        write_case(scratch_folder(), again);
        EXPECT_EQ(input::load_case(scratch_folder()).rotor.shaft.segments.size(),
                  scene.rotor.shaft.segments.size());
        return false;
    } catch (const model::BadInput &error) {
        EXPECT_FALSE(std::string(error.what()).empty());
        return true;
    }
}

TEST(DamagedCases, AreReadOrRefused) {
    const std::vector<BrokenCase> cases = all_cases();
    ASSERT_GE(cases.size(), 20U);
    constexpr unsigned count = 400;
    unsigned refused = 0;
    for (unsigned seed = 0; seed < count; ++seed) {
        Damage damage(seed);
        BrokenCase damaged = cases[damage.below(cases.size())];
        std::vector<std::string> overrides;
        const std::size_t kind = damage.below(4);
        if (kind == 0 && !damaged.files.empty()) {
            damage.befall(damaged.files[damage.below(damaged.files.size())].second);
        } else if (kind == 1) {
            overrides = {"bearing[0].k=1e6", "speeds.to=\"500 rpm\"", "disc[*].mass=1",
                         "shaft.segments[0].outer=50 mm"};
            damage.befall(overrides[damage.below(overrides.size())]);
            for (std::string &text : overrides) // as of a command line, where 0 ends a text
                std::erase(text, '\0');
        } else {
            damage.befall(damaged.text);
        }
        SCOPED_TRACE(damaged.name + ", seed " + std::to_string(seed));
        ASSERT_NO_THROW(refused += read(damaged, overrides) ? 1 : 0);
    }
    // Both happen: comments, names and digits may change unnoticed, most else may not.
    EXPECT_GT(refused, count / 4);
    EXPECT_LT(refused, 9 * count / 10);
}

} // namespace
} // namespace whirl::tests::damage_test
