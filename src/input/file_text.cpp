#include "input/file_text.h"

#include <fmt/core.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <system_error>

namespace whirl::input {
namespace {

namespace fs = std::filesystem;

/// A file that begins like this is no text.
struct Signature {
    std::string_view begin;
    std::string_view name;
};
using namespace std::string_view_literals;
constexpr std::array signatures{
    Signature{"\xD0\xCF\x11\xE0"sv, "an Excel workbook (.xls)"},
    Signature{"%PDF"sv, "a PDF"},
    Signature{"\x1F\x8B"sv, "a compressed file (gzip)"},
    Signature{"\x89PNG"sv, "a picture (PNG)"},
    Signature{"<?xml"sv, "XML"},
    Signature{"<html"sv, "a web page"},
    Signature{"<table"sv, "a web page"},
};

/// A workbook is a ZIP archive; the names of its parts stand in it as they are.
std::string kind_of_archive(std::string_view bytes, const fs::path &file) {
    const std::string ending = file.extension().string();
    const auto has = [&](std::string_view part) { return bytes.find(part) != bytes.npos; };
    if (has("opendocument.spreadsheet") || ending == ".ods")
        return "an OpenDocument spreadsheet (.ods)";
    if (has("xl/") || ending == ".xlsx" || ending == ".xlsm")
        return "an Excel workbook (.xlsx)";
    return "a ZIP archive";
}

/// What the bytes are, where they are no text; else empty.
std::string other_kind(std::string_view bytes, const fs::path &file) {
    if (bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06"))
        return kind_of_archive(bytes, file);
    for (const Signature &known : signatures)
        if (bytes.starts_with(known.begin))
            return std::string(known.name);
    return "";
}

constexpr const char *export_it = "; export its sheet as text (File, Save As, \"CSV UTF-8\" in "
                                  "Excel, \"Text CSV\" in LibreOffice)";

void append_utf8(std::string &out, std::uint32_t code) {
    if (code < 0x80) {
        out += static_cast<char>(code);
        return;
    }
    const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3; // further bytes
    constexpr std::array<unsigned, 4> first{0, 0xC0, 0xE0, 0xF0};
    out += static_cast<char>(first.at(static_cast<std::size_t>(more)) | code >> (6 * more));
    for (int k = more - 1; k >= 0; --k)
        out += static_cast<char>(0x80 | (code >> (6 * k) & 0x3F));
}

/// UTF-16 behind its byte order mark. A half of a pair alone becomes the replacement character.
std::string from_utf16(std::string_view bytes, bool big_endian) {
    std::string out;
    const auto unit = [&](std::size_t i) {
        const auto a = static_cast<unsigned char>(bytes[i]);
        const auto b = static_cast<unsigned char>(bytes[i + 1]);
        return static_cast<std::uint32_t>(big_endian ? a << 8 | b : b << 8 | a);
    };
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        std::uint32_t code = unit(i);
        const bool high = code >= 0xD800 && code < 0xDC00;
        if (high && i + 3 < bytes.size() && (unit(i + 2) & 0xFC00) == 0xDC00) {
            i += 2;
            code = 0x10000 + ((code - 0xD800) << 10) + (unit(i) - 0xDC00);
        } else if (code >= 0xD800 && code < 0xE000) {
            code = 0xFFFD;
        }
        append_utf8(out, code);
    }
    return out;
}

/// As text in UTF-8, or why it is none.
FileText as_text(std::string bytes, const fs::path &file) {
    constexpr std::string_view mark8 = "\xEF\xBB\xBF";
    if (bytes.starts_with(mark8))
        bytes.erase(0, mark8.size());
    else if (bytes.starts_with("\xFF\xFE") && !bytes.starts_with("\xFF\xFE\0\0"sv))
        bytes = from_utf16(std::string_view(bytes).substr(2), false);
    else if (bytes.starts_with("\xFE\xFF"))
        bytes = from_utf16(std::string_view(bytes).substr(2), true);
    if (const std::string kind = other_kind(bytes, file); !kind.empty())
        return {"", "it is " + kind + (kind.find("(.") != kind.npos ? export_it : "")};
    if (bytes.find('\0') != std::string::npos)
        return {"",
                "it holds zero bytes: no text, or one in UTF-16 without a byte order mark; save "
                "it as UTF-8"};
    return {std::move(bytes), ""};
}

FileText read_file(const fs::path &file, std::size_t largest) {
    const auto refused = [](const std::string &why) { return FileText{"", why}; };
    std::error_code ignored;
    if (fs::is_directory(file, ignored))
        return refused("it is a folder");
    const std::unique_ptr<std::FILE, int (*)(std::FILE *)> stream(
        std::fopen(file.c_str(), "rb"), [](std::FILE *open) { return std::fclose(open); });
    if (!stream)
        return refused(errno == ENOENT
                           ? "there is no such file"
                           : "the file cannot be read: " + std::generic_category().message(errno));
    std::string bytes;
    constexpr std::size_t piece = 1 << 16;
    while (bytes.size() <= largest) {
        const std::size_t before = bytes.size();
        bytes.resize(before + piece);
        const std::size_t count = std::fread(bytes.data() + before, 1, piece, stream.get());
        bytes.resize(before + count);
        if (count < piece)
            break;
    }
    if (std::ferror(stream.get()) != 0)
        return refused("the file cannot be read: " + std::generic_category().message(errno));
    if (bytes.size() > largest)
        return refused(fmt::format("it is larger than {} MB", largest / 1'000'000));
    return as_text(std::move(bytes), file);
}

} // namespace

const FileText &FileTexts::of(const fs::path &file, std::size_t largest) {
    const auto found = _texts.find(file.string());
    return found != _texts.end()
               ? found->second
               : _texts.emplace(file.string(), read_file(file, largest)).first->second;
}

bool is_utf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const std::size_t more = byte < 0x80                   ? 0
                                 : byte >= 0xC2 && byte < 0xE0 ? 1
                                 : byte >= 0xE0 && byte < 0xF0 ? 2
                                 : byte >= 0xF0 && byte < 0xF5 ? 3
                                                               : text.size();
        if (more >= text.size() - i)
            return false;
        for (std::size_t k = 0; k < more; ++k)
            if ((static_cast<unsigned char>(text[++i]) & 0xC0) != 0x80)
                return false;
    }
    return true;
}

std::string from_latin1(std::string_view text) {
    std::string out;
    for (const char c : text)
        append_utf8(out, static_cast<unsigned char>(c));
    return out;
}

} // namespace whirl::input
