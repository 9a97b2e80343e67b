#include "report/common/fitted_text.h"

#include "report/common/words.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace whirl::report {

namespace {

/// Lines of a table, its head first.
std::string table_of(const std::string &name, int rows) {
    std::string text = "  " + name + "\n";
    for (int i = 1; i <= rows; ++i)
        text += "  " + name + " " + std::to_string(i) + "\n";
    return text;
}

int height_of(const std::string &text) { return static_cast<int>(std::ranges::count(text, '\n')); }

} // namespace

TEST(FittedText, WhatFitsStaysAsItIs) {
    const std::string body = "title\n\n" + table_of("a", 5) + "\nmodel\n";
    EXPECT_EQ(fitted_text(body, {"note: x"}, "report", 25), body + "note: x\nreport\n");
    EXPECT_EQ(fitted_text(body, {}, "", 0), body);
    EXPECT_EQ(fitted_text("", {}, "", 25), "");
}

/// Later tables lose their rows first, and each says how many.
TEST(FittedText, TheAnswerKeepsItsRows) {
    const std::string body = "title\n" + table_of("a", 10) + "\n" + table_of("b", 30);
    const std::string text = fitted_text(body, {}, "report", 25);
    EXPECT_EQ(height_of(text), 25);
    EXPECT_NE(text.find("  a 10\n"), std::string::npos);
    // Of 25 the report, the title and a with its head are 13, one is empty; b has its head, nine
    // rows and the line that says it.
    EXPECT_NE(text.find("  b 9\n  … 21 more rows\n"), std::string::npos) << text;
}

TEST(FittedText, TablesForWhichThereIsNoPlaceGo) {
    std::string body = "title\n" + table_of("first", 40);
    for (int i = 0; i < 10; ++i)
        body += "\nheading\n" + table_of("later", 40);
    const std::string text = fitted_text(body, {}, "report", 25);
    EXPECT_LE(height_of(text), 25);
    EXPECT_EQ(height_of(text), 25);
    // The title, the first table with its head, a line for each that lost rows; of the later ones,
    // six lines each with the empty one and the heading, two have a place.
    EXPECT_NE(text.find("  first 8\n  … 32 more rows\n"), std::string::npos) << text;
    EXPECT_NE(text.find("  … 38 more rows\n… 8 more tables\nreport\n"), std::string::npos) << text;
}

TEST(FittedText, TheWorstNotesStayAndTheOthersAreCounted) {
    std::vector<std::string> notes;
    for (int i = 0; i < 40; ++i)
        notes.push_back("note: " + std::to_string(i));
    const std::string text = fitted_text("title\n" + table_of("a", 40), notes, "report", 25);
    EXPECT_LE(height_of(text), 25);
    EXPECT_NE(text.find("note: 0\n"), std::string::npos);
    EXPECT_NE(text.find("more\nreport\n"), std::string::npos) << text;
}

TEST(Notes, TheWorstIsFirstAndEachIsSaidOnce) {
    const std::vector<model::Sentence> notes{{model::Weight::information, "how it is counted"},
                                             {"usual"},
                                             {model::Weight::warning, "it grows"},
                                             {"usual"}};
    EXPECT_EQ(note_lines(notes, {}), (std::vector<std::string>{"warning: it grows", "note: usual",
                                                               "note: how it is counted"}));
}

} // namespace whirl::report
