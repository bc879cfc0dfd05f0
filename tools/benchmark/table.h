// The tables a benchmark leaves: as Markdown for docs/accuracy.md, as CSV and as JSON for tools/plot.
// A row is an ordered JSON object, its keys are the columns; units are in the column names.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lw {

using Row = nlohmann::ordered_json;

struct Table {
    std::string section;  // "knn"
    std::string name;     // "times"; the file is SECTION-NAME.csv
    std::string caption;  // what was measured, with the settings that reproduce it
    std::vector<Row> rows;
};

/// Columns in order of first appearance; a row without a column leaves it empty.
std::vector<std::string> columns_of(const Table& table);

/// Caption and a Markdown table, numbers to four digits.
std::string to_markdown(const Table& table);

/// Writes SECTION-NAME.csv of each table, benchmark.csv (section, table, row, column, value) and benchmark.json with
/// `conditions` (machine, settings). Throws Error naming the file that cannot be written.
void write_tables(const std::filesystem::path& folder, const std::vector<Table>& tables, const Row& conditions);

}  // namespace lw
