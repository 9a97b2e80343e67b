#include "input/table_texts.h"

#include "input/node.h"
#include "input/toml_text.h"

#include <fstream>
#include <sstream>
#include <system_error>

namespace whirl::input {

namespace {

namespace fs = std::filesystem;

void add_tables(const Node &node, const fs::path &folder, std::string &texts) {
    std::error_code ignored;
    if (node.key == "table" && node.kind == Node::Kind::text &&
        fs::is_regular_file(folder / node.text, ignored)) {
        std::ostringstream table;
        table << std::ifstream(folder / node.text, std::ios::binary).rdbuf();
        texts += table.str() + '\n';
    }
    for (const Node &item : node.items)
        add_tables(item, folder, texts);
}

} // namespace

std::string table_texts(const std::string &text, const fs::path &file) {
    std::string texts;
    add_tables(parse_toml(text, file.generic_string()), file.parent_path(), texts);
    return texts;
}

} // namespace whirl::input
