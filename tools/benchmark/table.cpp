#include "table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>

#include "base/error.h"

namespace lw {
namespace {

std::string rounded(double value) {
    char text[40];
    const bool whole = value == std::round(value) && std::fabs(value) < 1e15;
    std::snprintf(text, sizeof text, whole ? "%.0f" : std::fabs(value) >= 1000 ? "%.0f" : "%.4g", value);
    return text;
}

std::string to_text(const Row& cell) {
    if (cell.is_null()) return "";
    if (cell.is_string()) return cell.get<std::string>();
    if (cell.is_boolean()) return cell.get<bool>() ? "yes" : "no";
    return rounded(cell.get<double>());
}

std::string to_csv_field(const Row& cell) {
    if (cell.is_null()) return "";
    if (!cell.is_string()) return cell.dump();
    std::string quoted = "\"";
    for (char c : cell.get<std::string>()) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

Row cell_of(const Row& row, const std::string& column) { return row.contains(column) ? row[column] : Row(); }

void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write) {
    std::ofstream stream(path);
    write(stream);
    stream.close();
    if (!stream) throw Error(path.string() + ": cannot be written");
}

void write_csv(std::ostream& stream, const Table& table) {
    const std::vector<std::string> columns = columns_of(table);
    for (size_t c = 0; c < columns.size(); ++c) stream << (c ? "," : "") << columns[c];
    stream << "\n";
    for (const Row& row : table.rows) {
        for (size_t c = 0; c < columns.size(); ++c) stream << (c ? "," : "") << to_csv_field(cell_of(row, columns[c]));
        stream << "\n";
    }
}

void write_long_csv(std::ostream& stream, const std::vector<Table>& tables) {
    stream << "section,table,row,column,value\n";
    for (const Table& table : tables)
        for (size_t i = 0; i < table.rows.size(); ++i)
            for (const auto& [column, cell] : table.rows[i].items())
                stream << table.section << "," << table.name << "," << i << "," << column << "," << to_csv_field(cell)
                       << "\n";
}

}  // namespace

std::vector<std::string> columns_of(const Table& table) {
    std::vector<std::string> columns;
    for (const Row& row : table.rows)
        for (const auto& [column, cell] : row.items())
            if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
    return columns;
}

std::string to_markdown(const Table& table) {
    const std::vector<std::string> columns = columns_of(table);
    std::string head = "|", rule = "|", body;
    for (const std::string& column : columns) {
        head.append(" ").append(column).append(" |");
        rule += "---|";
    }
    for (const Row& row : table.rows) {
        body += "|";
        for (const std::string& column : columns) body.append(" ").append(to_text(cell_of(row, column))).append(" |");
        body += "\n";
    }
    return table.caption + "\n\n" + head + "\n" + rule + "\n" + body;
}

void write_tables(const std::filesystem::path& folder, const std::vector<Table>& tables, const Row& conditions) {
    Row json{{"conditions", conditions}, {"tables", Row::array()}};
    for (const Table& table : tables) {
        write_file(folder / (table.section + "-" + table.name + ".csv"), [&](auto& s) { write_csv(s, table); });
        json["tables"].push_back(
            {{"section", table.section}, {"name", table.name}, {"caption", table.caption}, {"rows", Row(table.rows)}});
    }
    write_file(folder / "benchmark.csv", [&](auto& s) { write_long_csv(s, tables); });
    write_file(folder / "benchmark.json", [&](auto& s) { s << json.dump(1) << "\n"; });
}

}  // namespace lw
